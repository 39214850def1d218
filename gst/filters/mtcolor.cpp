// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/mtcolor.hpp"

#include <gst/video/video.h>

#include <optional>
#include <variant>
#include <vector>

#include "filters/color_table.hpp"
#include "filters/disparity_filter.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/depth_range.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/frame_views.hpp"
#include "shared/geometry_properties.hpp"
#include "shared/map_unit.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtcolor_debug);
#define GST_CAT_DEFAULT mtcolor_debug

namespace {

constexpr int kFallbackMaxDisparity = 64;
constexpr int kFallbackScale = 256;
constexpr DepthRange kDefaultRange = {0.5, 50};
constexpr double kSmallestDepthLimit = 0.001;  // [m]

/// The input range of a color table of disparities.
struct Range {
  int max_disparity = 0;  ///< [px]
  int scale = 0;          ///< [steps per px]
  int offset = 0;         ///< disparity of the first color, at most 0 [px]
  bool operator==(const Range&) const = default;
};

/// The values of the properties.
struct ColorSettings {
  int max_disparity = 0;       ///< 0: from the caps [px]
  int scale = kFallbackScale;  ///< used if the caps have no scale [steps per px]
  DepthRange depths = kDefaultRange;
  ColorScale color_scale = ColorScale::kLog;
};

/// All data of one mtcolor element. Created in its init, deleted in its finalize.
struct ColorState {
  // Guarded by the element's object lock.
  ColorSettings settings;

  // Used by the streaming thread only.
  int caps_max_disparity = 0;              ///< 0: not in the caps [px]
  int caps_scale = 0;                      ///< 0: not in the caps [steps per px]
  int caps_offset = 0;                     ///< smallest disparity, if it is negative [px]
  std::optional<double> depth_unit;        ///< of the caps [m]; none: disparities
  DepthRange last_depths = kDefaultRange;  ///< the last valid ones
  std::variant<Range, DepthColors> range;  ///< of `table`
  std::vector<Rgb> table;
};

using GstMtColor = Instance<GstVideoFilter, ColorState>;
using GstMtColorClass = GstVideoFilterClass;

const PropertyTable<ColorSettings>& properties() {
  using Values = ColorSettings;
  using Row = Property<Values>;
  static const GType scales = enum_type<ColorScale>(
      "GstMtStereoColorScale",
      {{ColorScale::kInverse, "Evenly over 1 / depth, as over disparities", "inverse"},
       {ColorScale::kLinear, "Evenly over the depth", "linear"},
       {ColorScale::kLog, "Evenly over the logarithm of the depth", "log"}});
  static const PropertyTable<Values> table({
      {"max-disparity", &Values::max_disparity, 0, kLargestMaxDisparity,
       "Disparity of the last color, in px, the same in every frame (0: from the caps or the "
       "meta of mtstereo, else 64)"},
      {"disparity-scale", &Values::scale, 1, 65535, kScaleBlurb},
      Row("near", {&Values::depths, &DepthRange::near}, kSmallestDepthLimit, kLargestDepthLimit,
          "For depth maps: depth of the last color (red), in meters, the same in every frame"),
      Row("far", {&Values::depths, &DepthRange::far}, kSmallestDepthLimit, kLargestDepthLimit,
          "For depth maps: depth of the first color (blue), in meters"),
      {"color-scale", &Values::color_scale, scales,
       "For depth maps: distribution of the colors from near to far"},
  });
  return table;
}

constexpr const char* kImages =
    MTSTEREO_IMAGE_CAPS("{ RGB, BGR, RGBx, BGRx, xRGB, xBGR, RGBA, BGRA, ARGB, ABGR }");

}  // namespace

G_DEFINE_TYPE(GstMtColor, gst_mtstereo_color, GST_TYPE_VIDEO_FILTER)

namespace {

ColorState& state_of(gpointer element) { return *reinterpret_cast<GstMtColor*>(element)->state; }

GstCaps* transform_caps(GstBaseTransform*, GstPadDirection direction, GstCaps* caps,
                        GstCaps* filter) {
  const char* other = direction == GST_PAD_SINK ? kImages : kDisparityCaps;
  return filtered_caps(image_caps(caps, other), filter).release();
}

/// Reads the unit of depths; false after an error.
bool take_depth_unit(GstVideoFilter* filter, const GstCaps* caps) {
  ColorState& state = state_of(filter);
  const GstStructure* structure = gst_caps_get_structure(caps, 0);
  state.depth_unit = depth_unit_in(structure);
  if (state.depth_unit || !gst_structure_has_field(structure, kDepthUnitField)) return true;
  GST_ELEMENT_ERROR(filter, STREAM, FORMAT,
                    ("The caps of the depth map have a depth-unit that is not a positive number of "
                     "meters: correct it in the element that sets the caps."),
                    ("caps: %s", caps_text(caps).c_str()));
  return false;
}

gboolean set_info(GstVideoFilter* filter, GstCaps* in_caps, GstVideoInfo*, GstCaps*,
                  GstVideoInfo*) {
  ColorState& state = state_of(filter);
  const GstStructure* structure = gst_caps_get_structure(in_caps, 0);
  if (!take_depth_unit(filter, in_caps)) return FALSE;
  state.caps_scale = 0;
  state.caps_max_disparity = 0;
  state.caps_offset = 0;
  const bool has_scale = gst_structure_get_int(structure, "disparity-scale", &state.caps_scale);
  const bool has_range =
      gst_structure_get_int(structure, "max-disparity", &state.caps_max_disparity);
  gst_structure_get_int(structure, kOffsetField, &state.caps_offset);
  if ((has_scale && (state.caps_scale < 1 || state.caps_scale > 65535)) ||
      (has_range && state.caps_max_disparity < 1) || state.caps_offset > 0 ||
      state.caps_offset < -65535) {
    GST_ELEMENT_ERROR(filter, STREAM, FORMAT,
                      ("The caps of the disparity map have disparity-scale=%d, "
                       "max-disparity=%d and disparity-offset=%d. The scale must be 1 to 65535 "
                       "steps per px, the range at least 1 px and the offset -65535 to 0 px: "
                       "correct them in the element that sets the caps.",
                       state.caps_scale, state.caps_max_disparity, state.caps_offset),
                      ("caps: %s", caps_text(in_caps).c_str()));
    return FALSE;
  }
  return TRUE;
}

/// What the properties, the caps and the meta of a map say, whichever applies.
Range effective_range(GstVideoFilter* filter, const std::optional<DisparityUnit>& meta) {
  const ColorState& state = state_of(filter);
  const ObjectLock lock(filter);
  Range range;
  range.scale = state.caps_scale != 0 ? state.caps_scale
                : meta                ? meta->scale
                                      : state.settings.scale;
  range.max_disparity = state.settings.max_disparity != 0 ? state.settings.max_disparity
                        : state.caps_max_disparity != 0   ? state.caps_max_disparity
                        : meta                            ? meta->max_disparity
                                                          : kFallbackMaxDisparity;
  range.offset = state.caps_scale != 0 ? state.caps_offset : meta ? meta->offset : 0;
  return range;
}

/// The offsets of the components within a pixel [bytes].
struct PixelLayout {
  int step = 0;  ///< size of a pixel
  int red = 0;
  int green = 0;
  int blue = 0;
  int rest = -1;  ///< the fourth byte, alpha or padding; -1: none
};

PixelLayout layout_of(const GstVideoFrame* frame) {
  PixelLayout layout;
  layout.step = GST_VIDEO_FRAME_COMP_PSTRIDE(frame, GST_VIDEO_COMP_R);
  layout.red = GST_VIDEO_FRAME_COMP_POFFSET(frame, GST_VIDEO_COMP_R);
  layout.green = GST_VIDEO_FRAME_COMP_POFFSET(frame, GST_VIDEO_COMP_G);
  layout.blue = GST_VIDEO_FRAME_COMP_POFFSET(frame, GST_VIDEO_COMP_B);
  if (layout.step == 4) layout.rest = 0 + 1 + 2 + 3 - layout.red - layout.green - layout.blue;
  return layout;
}

void paint(const GstVideoFrame* in, const GstVideoFrame* out, const std::vector<Rgb>& table) {
  const PixelLayout layout = layout_of(out);
  for (int y = 0; y < GST_VIDEO_FRAME_HEIGHT(in); ++y) {
    const std::uint8_t* from = plane_row(*in, y);
    std::uint8_t* to = plane_row(*out, y);
    for (int x = 0; x < GST_VIDEO_FRAME_WIDTH(in); ++x, from += 2, to += layout.step) {
      const Rgb& color = table[read16(from)];
      to[layout.red] = color.red;
      to[layout.green] = color.green;
      to[layout.blue] = color.blue;
      if (layout.rest >= 0) to[layout.rest] = 255;
    }
  }
}

void use_range(ColorState& state, const Range& range) {
  const Range* current = std::get_if<Range>(&state.range);
  if (current != nullptr && *current == range && !state.table.empty()) return;
  state.table = color_table(range.max_disparity - range.offset, range.scale);
  state.range = range;
}

void use_range(ColorState& state, const DepthColors& colors) {
  const DepthColors* current = std::get_if<DepthColors>(&state.range);
  if (current != nullptr && *current == colors) return;
  state.table = depth_color_table(colors);
  state.range = colors;
}

/// The range of depths by the properties.
DepthColors depth_colors(GstVideoFilter* filter, double unit) {
  ColorState& state = state_of(filter);
  const DepthRange range = settle_range(filter, state.settings.depths, state.last_depths);
  const ObjectLock lock(filter);
  return {unit, range.near, range.far, state.settings.color_scale};
}

GstFlowReturn transform_frame(GstVideoFilter* filter, GstVideoFrame* in, GstVideoFrame* out) {
  ColorState& state = state_of(filter);
  if (state.depth_unit) {
    use_range(state, depth_colors(filter, *state.depth_unit));
  } else {
    use_range(state, effective_range(filter, disparity_unit_of(in->buffer)));
  }
  paint(in, out, state.table);
  return GST_FLOW_OK;
}

gboolean start(GstBaseTransform* transform) {
  ColorState& state = state_of(transform);
  DepthRange range;
  {
    const ObjectLock lock(transform);
    range = state.settings.depths;
  }
  if (!check_range_at_start(transform, range)) return FALSE;
  state.last_depths = range;
  return TRUE;
}

}  // namespace

static void gst_mtstereo_color_class_init(GstMtColorClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtcolor_debug, "mtcolor", 0, "color images of disparity and depth maps");
  ElementObject<GstMtColor, properties, &ColorState::settings>::install(G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  add_pad_template(element_class, "sink", GST_PAD_SINK, kDisparityCaps);
  add_pad_template(element_class, "src", GST_PAD_SRC, kImages);
  gst_element_class_set_static_metadata(
      element_class, "Disparity and depth colorizer", "Filter/Converter/Video",
      "Color image of a disparity or depth map with a fixed range: blue is far, red is near, black "
      "is unknown",
      kAuthors);

  auto* transform_class = GST_BASE_TRANSFORM_CLASS(klass);
  check_sink_caps<FrameKind::kMap>(transform_class);
  transform_class->start = guarded<start, FALSE>;
  transform_class->transform_caps = guarded<transform_caps>;
  transform_class->transform = guarded<transform_checked, GST_FLOW_ERROR>;
  auto* filter_class = GST_VIDEO_FILTER_CLASS(klass);
  filter_class->set_info = guarded<set_info, FALSE>;
  filter_class->transform_frame = guarded<transform_frame, GST_FLOW_ERROR>;
}

static void gst_mtstereo_color_init(GstMtColor* self) { self->state = new_state<ColorState>(); }

}  // namespace mtstereo::plugin

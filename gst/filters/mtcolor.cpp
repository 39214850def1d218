// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/mtcolor.hpp"

#include <gst/video/video.h>

#include <optional>
#include <vector>

#include "filters/color_table.hpp"
#include "filters/disparity_filter.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/caps.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/exception_guard.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtcolor_debug);
#define GST_CAT_DEFAULT mtcolor_debug

namespace {

constexpr int kFallbackMaxDisparity = 64;
constexpr int kFallbackScale = 256;

/// The input range of a color table.
struct Range {
  int max_disparity = 0;  ///< [px]
  int scale = 0;          ///< [steps per px]
  int offset = 0;         ///< disparity of the first color, at most 0 [px]
  bool operator==(const Range&) const = default;
};

/// All data of one mtcolor element. Created in its init, deleted in its finalize.
struct ColorState {
  // Guarded by the element's object lock.
  int max_disparity = 0;       ///< property; 0: from the caps [px]
  int scale = kFallbackScale;  ///< property; used if the caps have no scale [steps per px]

  // Used by the streaming thread only.
  int caps_max_disparity = 0;  ///< 0: not in the caps [px]
  int caps_scale = 0;          ///< 0: not in the caps [steps per px]
  int caps_offset = 0;         ///< smallest disparity, if it is negative [px]
  Range range;                 ///< of `table`
  std::vector<Rgb> table;
};

struct GstMtStereoColor {
  GstVideoFilter parent;
  ColorState* state;
};

struct GstMtStereoColorClass {
  GstVideoFilterClass parent_class;
};

enum Property : guint { kMaxDisparity = 1, kDisparityScale };

constexpr const char* kPictures =
    MTSTEREO_PICTURE_CAPS("{ RGB, BGR, RGBx, BGRx, xRGB, xBGR, RGBA, BGRA, ARGB, ABGR }");

}  // namespace

G_DEFINE_TYPE(GstMtStereoColor, gst_mtstereo_color, GST_TYPE_VIDEO_FILTER)

namespace {

ColorState& state_of(gpointer element) {
  return *reinterpret_cast<GstMtStereoColor*>(element)->state;
}

void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  const ObjectLock lock(object);
  switch (id) {
    case kMaxDisparity:
      state_of(object).max_disparity = g_value_get_int(value);
      break;
    case kDisparityScale:
      state_of(object).scale = g_value_get_int(value);
      break;
    default:
      G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
  }
}

void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  const ObjectLock lock(object);
  switch (id) {
    case kMaxDisparity:
      g_value_set_int(value, state_of(object).max_disparity);
      break;
    case kDisparityScale:
      g_value_set_int(value, state_of(object).scale);
      break;
    default:
      G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
  }
}

GstCaps* transform_caps(GstBaseTransform*, GstPadDirection direction, GstCaps* caps,
                        GstCaps* filter) {
  const char* other = direction == GST_PAD_SINK ? kPictures : kDisparityCaps;
  return filtered_caps(picture_caps(caps, other), filter).release();
}

gboolean set_info(GstVideoFilter* filter, GstCaps* in_caps, GstVideoInfo*, GstCaps*,
                  GstVideoInfo*) {
  ColorState& state = state_of(filter);
  const GstStructure* structure = gst_caps_get_structure(in_caps, 0);
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
  range.scale = state.caps_scale != 0 ? state.caps_scale : meta ? meta->scale : state.scale;
  range.max_disparity = state.max_disparity != 0        ? state.max_disparity
                        : state.caps_max_disparity != 0 ? state.caps_max_disparity
                        : meta                          ? meta->max_disparity
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
      const Rgb& color = table[GST_READ_UINT16_LE(from)];
      to[layout.red] = color.red;
      to[layout.green] = color.green;
      to[layout.blue] = color.blue;
      if (layout.rest >= 0) to[layout.rest] = 255;
    }
  }
}

GstFlowReturn transform_frame(GstVideoFilter* filter, GstVideoFrame* in, GstVideoFrame* out) {
  ColorState& state = state_of(filter);
  const Range range = effective_range(filter, disparity_unit_of(in->buffer));
  if (range != state.range) {
    state.table = color_table(range.max_disparity - range.offset, range.scale);
    state.range = range;
  }
  paint(in, out, state.table);
  return GST_FLOW_OK;
}

void finalize(GObject* object) noexcept {
  delete &state_of(object);
  G_OBJECT_CLASS(gst_mtstereo_color_parent_class)->finalize(object);
}

void install_properties(GObjectClass* object_class) {
  constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                   GST_PARAM_MUTABLE_PLAYING);
  g_object_class_install_property(
      object_class, kMaxDisparity,
      g_param_spec_int("max-disparity", "max-disparity",
                       "Disparity of the last color, in px; the range is the same in every frame "
                       "(0: that of the caps or of the meta, which mtstereo sets, or 64 without "
                       "them)",
                       0, kLargestMaxDisparity, 0, kFlags));
  g_object_class_install_property(
      object_class, kDisparityScale,
      g_param_spec_int("disparity-scale", "disparity-scale",
                       "Steps per px of the input if neither its caps nor its meta have a "
                       "disparity-scale, for example downstream of a decoder; these take "
                       "precedence",
                       1, 65535, kFallbackScale, kFlags));
}

}  // namespace

static void gst_mtstereo_color_class_init(GstMtStereoColorClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtcolor_debug, "mtcolor", 0, "color images of disparity maps");
  auto* object_class = G_OBJECT_CLASS(klass);
  object_class->set_property = guarded<set_property>;
  object_class->get_property = guarded<get_property>;
  object_class->finalize = finalize;
  install_properties(object_class);

  auto* element_class = GST_ELEMENT_CLASS(klass);
  add_pad_template(element_class, "sink", GST_PAD_SINK, kDisparityCaps);
  add_pad_template(element_class, "src", GST_PAD_SRC, kPictures);
  gst_element_class_set_static_metadata(
      element_class, "Disparity colorizer", "Filter/Converter/Video",
      "Color image of a disparity map with a fixed range: blue is far, red is near, black is "
      "unknown",
      "the mtstereo authors");

  auto* transform_class = GST_BASE_TRANSFORM_CLASS(klass);
  transform_class->transform_caps = guarded<transform_caps>;
  transform_class->transform = guarded<transform_checked, GST_FLOW_ERROR>;
  auto* filter_class = GST_VIDEO_FILTER_CLASS(klass);
  filter_class->set_info = guarded<set_info, FALSE>;
  filter_class->transform_frame = guarded<transform_frame, GST_FLOW_ERROR>;
}

static void gst_mtstereo_color_init(GstMtStereoColor* self) {
  self->state = new_state<ColorState>();
}

}  // namespace mtstereo::plugin

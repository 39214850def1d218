// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/mtrectify.hpp"

#include <gst/video/gstvideofilter.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cameras/rectification_plan.hpp"
#include "cameras/rectification_report.hpp"
#include "cameras/rectify_caps.hpp"
#include "cameras/rectify_properties.hpp"
#include "filters/disparity_filter.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/frame_metas.hpp"
#include "shared/frame_views.hpp"
#include "shared/luma.hpp"
#include "shared/valid_columns_meta.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtrectify_debug);
#define GST_CAT_DEFAULT mtrectify_debug

namespace {

struct BytesDeleter {
  void operator()(GBytes* bytes) const { g_bytes_unref(bytes); }
};
using BytesPointer = std::unique_ptr<GBytes, BytesDeleter>;

/// All data of one mtrectify element. Created in its init, deleted in its finalize.
struct RectifyState {
  // Guarded by the element's object lock.
  RectifySettings settings;                 ///< the properties
  std::optional<FrameSize> calibrated_for;  ///< preferred on the sink pad

  // Used by the streaming thread, and by start() and stop() while that thread does not run.
  CalibrationFile file;
  std::optional<RectificationPlan> plan;  ///< of the negotiated caps
  std::optional<Rectifier> rectifier;     ///< of `plan`
  BytesPointer columns;                   ///< of `rectifier`
  std::vector<std::string> posted;        ///< warnings about `plan`
  LumaReader luma;
};

using GstMtRectify = Instance<GstVideoFilter, RectifyState>;
using GstMtRectifyClass = GstVideoFilterClass;

}  // namespace

G_DEFINE_TYPE(GstMtRectify, gst_mtstereo_rectify, GST_TYPE_VIDEO_FILTER)

namespace {

RectifyState& state_of(gpointer element) {
  return *reinterpret_cast<GstMtRectify*>(element)->state;
}

RectifySettings settings_of(gpointer element) {
  const ObjectLock lock(element);
  return state_of(element).settings;
}

/// All of them change the frames, and most the caps: negotiated before the next frame.
bool changes_caps(const RectifySettings&, const RectifySettings&) { return true; }

// --- caps ---

GstCaps* transform_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps,
                        GstCaps* filter) {
  RectifySettings settings;
  std::optional<FrameSize> preferred;
  {
    const ObjectLock lock(transform);
    settings = state_of(transform).settings;
    preferred = state_of(transform).calibrated_for;
  }
  CapsPointer other = direction == GST_PAD_SINK ? rectified_caps(caps, settings)
                                                : unrectified_caps(caps, settings, preferred);
  return filtered_caps(std::move(other), filter).release();
}

/// Makes the plan, and the maps if they change, for caps that both sides accept.
Result<CapsPointer> negotiate(RectifyState& state, const RectifySettings& settings, FrameSize input,
                              CapsPointer caps) {
  Result<RectificationPlan> plan = plan_rectification(state.file, settings, input);
  if (!plan) return plan.error();
  CapsPointer fixed = fixed_caps(std::move(caps), plan->output());
  if (gst_caps_get_size(fixed.get()) == 0) return fixed;
  if (const FrameSize size = size_in(fixed.get()); size != plan->output()) {
    plan = plan_rectification(state.file, settings, input, size);
    if (!plan) return plan.error();
  }
  if (!state.rectifier || !state.plan || !state.plan->has_maps_of(*plan)) {
    Result<Rectifier> rectifier =
        Rectifier::create(plan->calibration, plan->rectification, settings.side);
    if (!rectifier) return rectifier.error();
    state.rectifier = std::move(*rectifier);
    state.columns.reset(pack_valid_columns(state.rectifier->valid_columns()));
  }
  state.plan = std::move(*plan);
  write_plan(fixed.get(), *state.plan, state.rectifier->valid_rectangle());
  return fixed;
}

void post_failure(GstBaseTransform* transform, const RectifySettings& settings, FrameSize input,
                  const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) {
    GST_ELEMENT_ERROR(
        transform, RESOURCE, NO_SPACE_LEFT,
        ("There is not enough memory to rectify frames of %dx%d px.", input.width, input.height),
        ("%s", error.message.c_str()));
    return;
  }
  GST_ELEMENT_ERROR(transform, LIBRARY, SETTINGS,
                    ("The video of %dx%d px cannot be rectified: %s", input.width, input.height,
                     error.message.c_str()),
                    ("calibration=%s camera=%s", settings.calibration.c_str(),
                     settings.side == Rectifier::Side::kLeft ? "left" : "right"));
}

/// Returns to the settings of the last frame, if these apply to the same video.
bool take_back(GstBaseTransform* transform, const RectifySettings& refused, FrameSize input,
               const Error& error) {
  RectifyState& state = state_of(transform);
  if (!state.plan || state.plan->input != input) return false;
  {
    const ObjectLock lock(transform);
    state.settings = state.plan->settings;
  }
  GST_ELEMENT_WARNING(
      transform, LIBRARY, SETTINGS,
      ("A property change was rejected; previous values kept: %s", error.message.c_str()),
      ("calibration=%s", refused.calibration.c_str()));
  return true;
}

Error refuse_format() {
  return {
      ErrorCode::kInvalidParameter,
      "color=true keeps RGB formats of 8 bits and GRAY8. Put videoconvert upstream of mtrectify "
      "and set color=true before the start, or set color=false."};
}

/// Called by the streaming thread for the caps of a new stream, and after a change of a property.
GstCaps* fixate_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps,
                     GstCaps* other) {
  CapsPointer possible(other);
  if (direction != GST_PAD_SINK || !gst_caps_is_fixed(caps)) {
    return gst_caps_fixate(possible.release());
  }
  RectifyState& state = state_of(transform);
  RectifySettings settings = settings_of(transform);
  const FrameSize input = size_in(caps);
  Result<CapsPointer> fixed = refuse_format();
  if (!settings.color || has_color_format(caps)) {
    fixed = negotiate(state, settings, input, CapsPointer(gst_caps_ref(possible.get())));
  }
  if (!fixed && take_back(transform, settings, input, fixed.error())) {
    const CapsPointer last = rectified_caps(caps, state.plan->settings);
    CapsPointer peer(gst_pad_peer_query_caps(GST_BASE_TRANSFORM_SRC_PAD(transform), last.get()));
    fixed = negotiate(state, RectifySettings(state.plan->settings), input, std::move(peer));
  }
  if (fixed) {
    if (state.plan && state.rectifier) {
      report_rectification(GST_ELEMENT(transform), GST_CAT_DEFAULT, *state.plan, state.posted);
    }
    return fixed->release();
  }
  post_failure(transform, settings, input, fixed.error());
  return gst_caps_new_empty();
}

// --- frames ---

/// The pixels of a packed frame.
template <typename T>
ImageView<T> pixels_of(const GstVideoFrame& frame) {
  return {static_cast<T*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)), GST_VIDEO_FRAME_WIDTH(&frame),
          GST_VIDEO_FRAME_HEIGHT(&frame), GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0)};
}

GstFlowReturn transform_frame(GstVideoFilter* filter, GstVideoFrame* in, GstVideoFrame* out) {
  RectifyState& state = state_of(filter);
  if (!state.rectifier) return GST_FLOW_NOT_NEGOTIATED;
  const int channels = GST_VIDEO_FRAME_COMP_PSTRIDE(out, 0);
  const GrayView source = channels == 1 ? state.luma.read(*in) : pixels_of<const std::uint8_t>(*in);
  const Status status =
      state.rectifier->apply(source, pixels_of<std::uint8_t>(*out), channels,
                             static_cast<std::uint8_t>(state.plan->settings.border));
  if (!status) {
    GST_ELEMENT_ERROR(filter, LIBRARY, FAILED,
                      ("A frame cannot be rectified: %s", status.error().message.c_str()),
                      ("%s", gst_video_format_to_string(GST_VIDEO_FRAME_FORMAT(in))));
    return GST_FLOW_ERROR;
  }
  set_valid_columns(out->buffer, state.columns.get());
  return GST_FLOW_OK;
}

/// Every pixel moves: a meta stays valid if it describes the frame as a whole.
gboolean transform_meta(GstBaseTransform* transform, GstBuffer* out, GstMeta* meta,
                        GstBuffer* in) noexcept {
  if (belongs_to_pixels(*meta->info)) return FALSE;
  return GST_BASE_TRANSFORM_CLASS(gst_mtstereo_rectify_parent_class)
      ->transform_meta(transform, out, meta, in);
}

// --- life ---

gboolean start(GstBaseTransform* transform) {
  RectifyState& state = state_of(transform);
  const RectifySettings settings = settings_of(transform);
  if (settings.calibration.empty()) {
    GST_ELEMENT_ERROR(transform, RESOURCE, SETTINGS,
                      ("No calibration is set. Set the property calibration to the file of both "
                       "cameras, such as calibration=stereo.yaml."),
                      (nullptr));
    return FALSE;
  }
  // A file that cannot be read is reported when the size of the video is known: some formats need
  // it.
  const std::optional<FrameSize> size = state.file.size_of(settings);
  const ObjectLock lock(transform);
  state.calibrated_for = size;
  return TRUE;
}

gboolean stop(GstBaseTransform* transform) {
  RectifyState& state = state_of(transform);
  state.file = CalibrationFile();
  state.plan.reset();
  state.rectifier.reset();
  state.columns.reset();
  state.posted.clear();
  state.luma.clear();
  const ObjectLock lock(transform);
  state.calibrated_for.reset();
  return TRUE;
}

void add_pads(GstElementClass* element_class) noexcept {
  const std::string common = ", " MTSTEREO_SIZE_CAPS ", interlace-mode = (string) progressive";
  const std::string sink = "video/x-raw, format = (string) " + luma_formats() + common;
  const std::string source =
      std::string("video/x-raw, format = (string) ") + kColorFormats + common;
  add_pad_template(element_class, "sink", GST_PAD_SINK, sink.c_str());
  add_pad_template(element_class, "src", GST_PAD_SRC, source.c_str());
}

}  // namespace

static void gst_mtstereo_rectify_class_init(GstMtRectifyClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtrectify_debug, "mtrectify", 0, "rectification of a camera");
  ElementObject<GstMtRectify, rectify_properties, &RectifyState::settings, changes_caps>::install(
      G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  add_pads(element_class);
  gst_element_class_set_static_metadata(
      element_class, "Camera rectification", "Filter/Effect/Video",
      "Rectifies the video of one of two calibrated cameras for mtstereo: removes lens distortion "
      "and aligns the rows of both views",
      kAuthors);

  auto* transform_class = GST_BASE_TRANSFORM_CLASS(klass);
  check_sink_caps<FrameKind::kView>(transform_class);
  transform_class->start = guarded<start, FALSE>;
  transform_class->stop = guarded<stop, FALSE>;
  transform_class->transform_caps = guarded<transform_caps>;
  transform_class->fixate_caps = guarded<fixate_caps>;
  transform_class->transform_meta = transform_meta;
  transform_class->transform = guarded<transform_checked, GST_FLOW_ERROR>;
  GST_VIDEO_FILTER_CLASS(klass)->transform_frame = guarded<transform_frame, GST_FLOW_ERROR>;
}

static void gst_mtstereo_rectify_init(GstMtRectify* self) {
  self->state = new_state<RectifyState>();
  // mtstereo skips pairs that are late. Frames that were dropped on one side only would cost more.
  gst_base_transform_set_qos_enabled(reinterpret_cast<GstBaseTransform*>(self), FALSE);
}

}  // namespace mtstereo::plugin

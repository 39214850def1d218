// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <initializer_list>

#include "matcher/element_state.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

CapsPointer template_caps(GstPad* pad) { return CapsPointer(gst_pad_get_pad_template_caps(pad)); }

/// Every structure of `base` with the fields of every structure of `wish` that are named.
CapsPointer with_fields(const GstCaps* base, const GstCaps* wish,
                        std::initializer_list<const char*> fields) {
  CapsPointer result(gst_caps_new_empty());
  for (guint i = 0; i < gst_caps_get_size(wish); ++i) {
    const GstStructure* from = gst_caps_get_structure(wish, i);
    CapsPointer part(gst_caps_copy(base));
    for (const char* field : fields) {
      const GValue* value = gst_structure_get_value(from, field);
      if (value != nullptr) gst_caps_set_value(part.get(), field, value);
    }
    result.reset(gst_caps_merge(result.release(), part.release()));
  }
  return result;
}

CapsPointer intersection(GstCaps* first, GstCaps* second) {
  return CapsPointer(gst_caps_intersect_full(first, second, GST_CAPS_INTERSECT_FIRST));
}

/// Why a stream cannot be taken, and what to do; "" where it can.
std::string refusal(const GstCaps* caps) {
  const GstStructure* structure = gst_caps_get_structure(caps, 0);
  if (!gst_structure_has_name(structure, "video/x-raw")) {
    return std::string("it is ") + gst_structure_get_name(structure) +
           ", raw video is needed: put a decoder (such as decodebin) ahead of it";
  }
  const gchar* interlacing = gst_structure_get_string(structure, "interlace-mode");
  if (interlacing != nullptr && std::string(interlacing) != "progressive") {
    return std::string("it is interlaced (interlace-mode=") + interlacing +
           "), and rows of two moments cannot be matched: put deinterlace ahead of it";
  }
  const GstCapsFeatures* features = gst_caps_get_features(caps, 0);
  if (features != nullptr &&
      !gst_caps_features_is_equal(features, GST_CAPS_FEATURES_MEMORY_SYSTEM_MEMORY)) {
    const TextPointer text(gst_caps_features_to_string(features));
    return std::string("its frames are in ") + text.get() +
           ", system memory is needed: put a download element (such as gldownload) ahead of it";
  }
  GstVideoInfo info;
  if (!gst_video_info_from_caps(&info, caps)) {
    return "its caps do not describe a picture: a known format, width and height are needed";
  }
  if (!has_luma_plane(GST_VIDEO_INFO_FORMAT(&info))) {
    return std::string("its format ") + gst_video_format_to_string(GST_VIDEO_INFO_FORMAT(&info)) +
           " has no plane of 8-bit luma: put videoconvert ahead of it";
  }
  return {};
}

std::optional<Nanoseconds> frame_duration(const GstVideoInfo& info) {
  if (info.fps_n <= 0 || info.fps_d <= 0) return std::nullopt;
  return static_cast<Nanoseconds>(gst_util_uint64_scale_int(GST_SECOND, info.fps_d, info.fps_n));
}

void refuse_settings(ElementState& state, const std::string& message) {
  std::string details = state.streams_text() + "; settings:";
  for (const ParameterInfo& info : parameter_table()) {
    details += std::string(" ") + info.name + "=" + state.active.parameters.text(info.id);
  }
  details += " disparity-scale=" + std::to_string(state.active.disparity_scale);
  post_error(state, GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS, message, details);
}

/// Makes the matcher, or gives it other parameters.
Status fit_matcher(ElementState& state) {
  if (state.matcher_revision == state.active.revision && state.matcher) return {};
  if (state.matcher) {
    Status status = state.matcher->set_parameters(state.active.parameters);
    if (!status) return status;
  } else {
    Result<Matcher> made = Matcher::create(state.active.parameters);
    if (!made) return made.error();
    state.matcher.emplace(std::move(made.value()));
  }
  state.matcher_revision = state.active.revision;
  return {};
}

}  // namespace

CapsPointer sink_caps(const ElementState& state, Side side, GstCaps* filter) {
  const CapsPointer base = template_caps(GST_PAD_CAST(state.input(side).pad));
  // An interlaced stream is to come as far as its caps event: there it gets an error that says what
  // to do, where a source that finds no common caps would only say "not negotiated".
  GstCaps* open = gst_caps_copy(base.get());
  for (guint i = 0; i < gst_caps_get_size(open); ++i) {
    gst_structure_remove_field(gst_caps_get_structure(open, i), "interlace-mode");
  }
  const CapsPointer keep_open(open);  // used below, when result is another one
  CapsPointer result(gst_caps_ref(open));

  // What downstream asks of the disparity map's frame, it asks of the left stream's.
  const CapsPointer source_template = template_caps(state.source_pad());
  const CapsPointer downstream(gst_pad_peer_query_caps(state.source_pad(), source_template.get()));
  if (!gst_caps_is_any(downstream.get()) && !gst_caps_is_empty(downstream.get())) {
    result = side == Side::kLeft
                 ? with_fields(result.get(), downstream.get(),
                               {"width", "height", "framerate", "pixel-aspect-ratio"})
                 : with_fields(result.get(), downstream.get(), {"width", "height"});
  }

  // The other stream's size comes first, so that a source that is free to choose takes it; other
  // sizes stay possible, as both streams may be about to change theirs.
  const Side other = side == Side::kLeft ? Side::kRight : Side::kLeft;
  const CapsPointer current(gst_pad_get_current_caps(GST_PAD_CAST(state.input(other).pad)));
  if (current && gst_caps_get_size(current.get()) > 0) {
    const CapsPointer wish = with_fields(open, current.get(), {"width", "height"});
    CapsPointer preferred = intersection(wish.get(), result.get());
    result.reset(gst_caps_merge(preferred.release(), result.release()));
  }
  // In the order of this element: gray and the other stream's size first.
  return filter != nullptr ? intersection(result.get(), filter) : std::move(result);
}

bool take_sink_caps(ElementState& state, Side side, const GstCaps* caps) {
  Input& input = state.input(side);
  const std::string reason = refusal(caps);
  if (!reason.empty()) {
    input.has_caps = false;
    const CapsPointer takes = template_caps(GST_PAD_CAST(input.pad));
    post_error(
        state, GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT,
        std::string("The stream of ") + pad_name(side) + " cannot be matched: " + reason + ".",
        std::string(pad_name(side)) + " got " + caps_text(caps) + "; it takes " +
            caps_text(takes.get()) + "; " + state.streams_text());
    return false;
  }
  gst_video_info_from_caps(&input.info, caps);
  input.has_caps = true;
  {
    const ObjectLock lock(state.element);
    (side == Side::kLeft ? state.caps_durations.left : state.caps_durations.right) =
        frame_duration(input.info);
  }
  if (side == Side::kLeft) gst_pad_mark_reconfigure(state.source_pad());
  update_pairing_latency(state);
  return true;
}

CapsPointer output_caps(const ElementState& state) {
  const GstVideoInfo& left = state.input(Side::kLeft).info;
  return CapsPointer(gst_caps_new_simple(
      "video/x-raw", "format", G_TYPE_STRING, "GRAY16_LE", "width", G_TYPE_INT, left.width,
      "height", G_TYPE_INT, left.height, "framerate", GST_TYPE_FRACTION, left.fps_n, left.fps_d,
      "pixel-aspect-ratio", GST_TYPE_FRACTION, left.par_n, left.par_d, "interlace-mode",
      G_TYPE_STRING, "progressive", "disparity-scale", G_TYPE_INT, state.active.disparity_scale,
      "max-disparity", G_TYPE_INT, state.active.parameters.integer(Parameter::kMaxDisparity),
      nullptr));
}

bool apply_settings(ElementState& state) {
  state.active = state.snapshot();
  if (!state.active.problem.empty()) {
    refuse_settings(state, state.active.problem);
    return false;
  }
  Status status = state.active.parameters.check_scale16(state.active.disparity_scale);
  const Input& left = state.input(Side::kLeft);
  if (status && left.has_caps) {
    status = state.active.parameters.check_frame(left.info.width, left.info.height);
    state.checked_width = left.info.width;
    state.checked_height = left.info.height;
  }
  if (status) status = fit_matcher(state);
  if (status) return true;
  refuse_settings(state, status.error().message);
  return false;
}

void update_pairing_latency(ElementState& state) {
  Nanoseconds wait = 0;
  Nanoseconds frame = 0;
  {
    const ObjectLock lock(state.element);
    frame = state.caps_durations.shorter().value_or(0);
    // A frame's partner may be as old as the tolerance says, and cameras do not deliver to the
    // moment: waiting for a whole frame costs nothing where the partner is there.
    wait = std::max(frame, tolerance_in_force(state.settings.sync_tolerance, state.caps_durations,
                                              FrameDurations{}));
  }
  // A pad of a live stream holds two frames: that much can be waited for.
  const Nanoseconds room = std::max(wait, 2 * frame);
  gst_aggregator_set_latency(state.element, static_cast<GstClockTime>(wait),
                             static_cast<GstClockTime>(room));
}

}  // namespace mtstereo::plugin

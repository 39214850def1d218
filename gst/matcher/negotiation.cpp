// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/negotiation.hpp"

#include <initializer_list>
#include <memory>
#include <utility>

#include "matcher/output/output_caps.hpp"
#include "matcher/settings_in_use.hpp"
#include "matcher/stream_changes.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/stereo_geometry.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

CapsPointer template_caps(GstPad* pad) { return CapsPointer(gst_pad_get_pad_template_caps(pad)); }

/// Every structure of `base`, with the named fields of every structure of `wish`.
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

/// Why a stream belongs on the other pad; "" if its caps do not say so.
std::string camera_problem(const GstCaps* caps, Side side) {
  const gchar* camera = gst_structure_get_string(gst_caps_get_structure(caps, 0), kCameraField);
  const std::string other = side == Side::kLeft ? "right" : "left";
  if (camera == nullptr || other != camera) return {};
  const std::string here = pad_name(side);
  return "The view on " + here + " is from the " + other +
         " camera, as its caps state. If both cameras are linked to the wrong pads, exchange the "
         "links. If both mtrectify have camera=" +
         other + ", set camera=" + (side == Side::kLeft ? "left" : "right") +
         " of the one upstream of " + here + ".";
}

/// The fields of the geometry in the caps of a stream.
std::shared_ptr<const GstStructure> geometry_fields(const GstCaps* caps) {
  GstStructure* fields = gst_structure_new_empty("geometry");
  copy_geometry_fields(gst_caps_get_structure(caps, 0), fields);
  return {fields,
          [](const GstStructure* owned) { gst_structure_free(const_cast<GstStructure*>(owned)); }};
}

}  // namespace

CapsPointer sink_caps(const ElementState& state, Side side, GstCaps* filter) {
  const CapsPointer base = template_caps(GST_PAD_CAST(state.pairing.pad(side)));
  // Interlaced caps are offered, so that their event gets an error: see caps_check.hpp.
  GstCaps* open = gst_caps_copy(base.get());
  for (guint i = 0; i < gst_caps_get_size(open); ++i) {
    gst_structure_remove_field(gst_caps_get_structure(open, i), "interlace-mode");
  }
  const CapsPointer keep_open(open);  // used below, when result has changed
  CapsPointer result(gst_caps_ref(open));

  // Downstream's restrictions of the disparity map apply to the left stream, its size to both.
  const CapsPointer source_template = template_caps(state.output.pad());
  const CapsPointer downstream(gst_pad_peer_query_caps(state.output.pad(), source_template.get()));
  if (!gst_caps_is_any(downstream.get()) && !gst_caps_is_empty(downstream.get())) {
    result = side == Side::kLeft
                 ? with_fields(result.get(), downstream.get(),
                               {"width", "height", "framerate", "pixel-aspect-ratio"})
                 : with_fields(result.get(), downstream.get(), {"width", "height"});
  }

  // The size of the other stream is preferred, so that a source that supports several sizes selects
  // it. Other sizes remain possible, since both streams may be about to change theirs.
  const Side other = other_side(side);
  const CapsPointer current(gst_pad_get_current_caps(GST_PAD_CAST(state.pairing.pad(other))));
  if (current && gst_caps_get_size(current.get()) > 0) {
    const CapsPointer wish = with_fields(open, current.get(), {"width", "height"});
    CapsPointer preferred = intersection(wish.get(), result.get());
    result.reset(gst_caps_merge(preferred.release(), result.release()));
  }
  // In this element's order of preference: GRAY8 and the size of the other stream first.
  return filter != nullptr ? intersection(result.get(), filter) : std::move(result);
}

bool take_sink_caps(ElementState& state, Side side, const GstCaps* caps) {
  GstPad* const pad = GST_PAD_CAST(state.pairing.pad(side));
  const CapsPointer takes = template_caps(pad);
  const std::string reason = caps_problem(caps, takes.get(), FrameKind::kView);
  const std::string problem = reason.empty() ? camera_problem(caps, side)
                                             : std::string("The stream on ") + pad_name(side) +
                                                   " cannot be matched: " + reason + ".";
  if (!problem.empty()) {
    state.formats.set_known(side, false);
    state.messages.error(GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT, problem,
                         std::string(pad_name(side)) + " received " + caps_text(caps) +
                             "; it accepts " + caps_text(takes.get()));
    return false;
  }
  GST_DEBUG_OBJECT(pad, "caps %" GST_PTR_FORMAT, static_cast<const void*>(caps));
  StreamInfo info;
  gst_video_info_from_caps(&info.video, caps);
  info.geometry = geometry_fields(caps);
  take_stream_info(state, side, std::move(info));
  return true;
}

bool negotiate_output(ElementState& state) {
  if (!state.formats[Side::kLeft].has_caps) return true;  // called again when they arrive
  if (!apply_settings(state)) return false;
  if (state.base_class->negotiate(state.element)) return true;
  if (GST_PAD_IS_FLUSHING(state.output.pad())) return false;
  const CapsPointer downstream(gst_pad_peer_query_caps(state.output.pad(), nullptr));
  const CapsPointer offered =
      output_caps(state.formats[Side::kLeft], state.engine.settings().unit());
  state.messages.error(
      GST_CORE_ERROR, GST_CORE_ERROR_NEGOTIATION,
      "Downstream does not accept the disparity map. It has the size and framerate of "
      "the left stream, the scale of the property disparity-scale, and the format GRAY16_LE: "
      "change these, or put a converter (mtcolor, videoconvert) downstream.",
      "offered: " + caps_text(offered.get()) + "; accepted: " + caps_text(downstream.get()));
  return false;
}

}  // namespace mtstereo::plugin

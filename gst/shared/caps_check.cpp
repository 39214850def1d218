// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/caps_check.hpp"

#include <gst/video/video.h>

#include "shared/caps.hpp"

namespace mtstereo::plugin {
namespace {

/// True if frames with these features are in system memory. Metas of frames do not matter.
bool in_system_memory(const GstCapsFeatures* features) {
  if (features == nullptr) return true;
  if (gst_caps_features_is_any(features)) return false;
  for (guint i = 0; i < gst_caps_features_get_size(features); ++i) {
    const gchar* feature = gst_caps_features_get_nth(features, i);
    if (!g_str_has_prefix(feature, "meta:") &&
        std::string(feature) != GST_CAPS_FEATURE_MEMORY_SYSTEM_MEMORY) {
      return false;
    }
  }
  return true;
}

/// True if `fields` and `accepted` have a value of this field in common, or one has no such field.
bool agree(const GstStructure* fields, const GstStructure* accepted, const char* field) {
  const GValue* value = gst_structure_get_value(fields, field);
  const GValue* allowed = gst_structure_get_value(accepted, field);
  return value == nullptr || allowed == nullptr || gst_value_intersect(nullptr, value, allowed);
}

std::string text_of(const GstStructure* fields, const char* field) {
  const TextPointer text(gst_value_serialize(gst_structure_get_value(fields, field)));
  return text ? text.get() : "of an unknown type";
}

std::string size_problem(const GstStructure* fields, const GstStructure* accepted) {
  if (agree(fields, accepted, "width") && agree(fields, accepted, "height")) return {};
  const int most = gst_value_get_int_range_max(gst_structure_get_value(accepted, "width"));
  return "its frames have " + text_of(fields, "width") + "x" + text_of(fields, "height") +
         " px, but 1 to " + std::to_string(most) +
         " px per side are required: correct the size in its source, or put videoscale upstream of "
         "it";
}

std::string format_problem(const GstStructure* fields, const GstStructure* accepted,
                           FrameKind kind) {
  if (agree(fields, accepted, "format")) return {};
  const std::string problem = "its format " + text_of(fields, "format");
  if (kind == FrameKind::kView) {
    return problem + " is not supported: put videoconvert upstream of it";
  }
  return problem +
         " is not GRAY16_LE, the format of disparity maps: link an mtstereo to it, or a decoder "
         "that outputs its maps unchanged";
}

}  // namespace

std::string caps_problem(const GstCaps* caps, const GstCaps* accepted, FrameKind kind) {
  const GstStructure* fields = gst_caps_get_structure(caps, 0);
  const GstStructure* allowed = gst_caps_get_structure(accepted, 0);
  if (gst_structure_has_name(fields, "video/x-bayer")) {
    return "it is video/x-bayer, but raw video is required: put bayer2rgb upstream of it";
  }
  if (!gst_structure_has_name(fields, "video/x-raw")) {
    return std::string("it is ") + gst_structure_get_name(fields) +
           ", but raw video is required: put a decoder (such as decodebin) upstream of it";
  }
  if (!agree(fields, allowed, "interlace-mode")) {
    return "it is interlaced (interlace-mode=" + text_of(fields, "interlace-mode") +
           "), and its two fields are from different times: put deinterlace upstream of it";
  }
  const GstCapsFeatures* features = gst_caps_get_features(caps, 0);
  if (!in_system_memory(features)) {
    const TextPointer text(gst_caps_features_to_string(features));
    return std::string("its frames are in ") + text.get() +
           ", but system memory is required: put a download element (such as gldownload) upstream "
           "of it";
  }
  GstVideoInfo info;
  if (!gst_video_info_from_caps(&info, caps)) {
    return "its caps are incomplete: a known format, width and height are required";
  }
  if (std::string problem = size_problem(fields, allowed); !problem.empty()) return problem;
  return format_problem(fields, allowed, kind);
}

bool allows_caps(gpointer element, GstPad* pad, GstEvent* event, FrameKind kind) {
  // A source sends caps that were refused again, with each frame.
  static const GQuark refused = g_quark_from_static_string("mtstereo-refused-caps");
  if (GST_EVENT_TYPE(event) == GST_EVENT_STREAM_START) {
    g_object_set_qdata(G_OBJECT(pad), refused, nullptr);
  }
  if (GST_EVENT_TYPE(event) != GST_EVENT_CAPS) return true;
  GstCaps* caps = nullptr;
  gst_event_parse_caps(event, &caps);
  const CapsPointer accepted(gst_pad_get_pad_template_caps(pad));
  std::string problem = caps_problem(caps, accepted.get(), kind);
  if (problem.empty() && !gst_caps_can_intersect(caps, accepted.get())) {
    problem =
        "its caps are not among those that the pad accepts: change the element upstream of it";
  }
  const bool first = g_object_get_qdata(G_OBJECT(pad), refused) == nullptr;
  g_object_set_qdata(G_OBJECT(pad), refused, problem.empty() ? nullptr : pad);
  if (problem.empty()) return true;
  if (!first) return false;
  GST_ELEMENT_ERROR(
      element, STREAM, FORMAT,
      ("The stream on %s cannot be used: %s.", GST_PAD_NAME(pad), problem.c_str()),
      ("received %s; accepted: %s", caps_text(caps).c_str(), caps_text(accepted.get()).c_str()));
  return false;
}

bool accepts_all_caps(GstQuery* query) {
  if (GST_QUERY_TYPE(query) != GST_QUERY_ACCEPT_CAPS) return false;
  gst_query_set_accept_caps_result(query, TRUE);
  return true;
}

gboolean accept_all_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps) {
  if (direction == GST_PAD_SINK) return TRUE;
  const gpointer parent = g_type_class_peek_parent(GST_BASE_TRANSFORM_GET_CLASS(transform));
  return GST_BASE_TRANSFORM_CLASS(parent)->accept_caps(transform, direction, caps);
}

}  // namespace mtstereo::plugin

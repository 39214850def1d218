// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/disparity_filter.hpp"

#include <exception>

#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

GstFlowReturn refuse_frame(GstVideoFilter* filter, const char* whose, const MappedFrame& frame) {
  GST_ELEMENT_ERROR(filter, STREAM, FAILED,
                    ("A frame of %s is not what its caps say: %s.", whose, frame.problem().c_str()),
                    ("the element on that side is at fault"));
  return GST_FLOW_ERROR;
}

GstFlowReturn transform_mapped(GstVideoFilter* filter, GstBuffer* in, GstBuffer* out) {
  MappedFrame from(filter->in_info, in, GST_MAP_READ);
  if (!from.mapped()) return refuse_frame(filter, "the pad sink", from);
  MappedFrame to(filter->out_info, out, GST_MAP_WRITE);
  if (!to.mapped()) return refuse_frame(filter, "downstream's buffer pool", to);
  return GST_VIDEO_FILTER_GET_CLASS(filter)->transform_frame(filter, from.frame(), to.frame());
}

}  // namespace

void add_pad_template(GstElementClass* element_class, const char* name, GstPadDirection direction,
                      const char* caps) {
  const CapsPointer parsed(gst_caps_from_string(caps));
  gst_element_class_add_pad_template(
      element_class, gst_pad_template_new(name, direction, GST_PAD_ALWAYS, parsed.get()));
}

CapsPointer picture_caps(const GstCaps* caps, const char* other) {
  const CapsPointer common(gst_caps_copy(caps));
  for (guint i = 0; i < gst_caps_get_size(common.get()); ++i) {
    gst_structure_remove_fields(gst_caps_get_structure(common.get(), i), "format", "colorimetry",
                                "chroma-site", "disparity-scale", "max-disparity", nullptr);
  }
  const CapsPointer formats(gst_caps_from_string(other));
  return CapsPointer(
      gst_caps_intersect_full(common.get(), formats.get(), GST_CAPS_INTERSECT_FIRST));
}

CapsPointer filtered_caps(CapsPointer caps, GstCaps* filter) {
  if (filter == nullptr) return caps;
  return CapsPointer(gst_caps_intersect_full(filter, caps.get(), GST_CAPS_INTERSECT_FIRST));
}

GstFlowReturn transform_checked(GstBaseTransform* transform, GstBuffer* in, GstBuffer* out) {
  auto* filter = reinterpret_cast<GstVideoFilter*>(transform);
  try {
    return transform_mapped(filter, in, out);
  } catch (const std::exception& error) {
    GST_ELEMENT_ERROR(filter, LIBRARY, FAILED, ("A frame could not be handled: %s.", error.what()),
                      ("an exception reached the element"));
  } catch (...) {
    GST_ELEMENT_ERROR(filter, LIBRARY, FAILED, ("A frame could not be handled."),
                      ("an unknown exception reached the element"));
  }
  return GST_FLOW_ERROR;
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/disparity_filter.hpp"

#include "shared/map_unit.hpp"

namespace mtstereo::plugin {

CapsPointer image_caps(const GstCaps* caps, const char* other) {
  const CapsPointer common(gst_caps_copy(caps));
  for (guint i = 0; i < gst_caps_get_size(common.get()); ++i) {
    GstStructure* fields = gst_caps_get_structure(common.get(), i);
    remove_map_unit(fields);
    gst_structure_remove_fields(fields, "format", "colorimetry", "chroma-site", nullptr);
  }
  const CapsPointer formats(gst_caps_from_string(other));
  return CapsPointer(
      gst_caps_intersect_full(common.get(), formats.get(), GST_CAPS_INTERSECT_FIRST));
}

GstFlowReturn refuse_frame(GstVideoFilter* filter, const char* source, const MappedFrame& frame) {
  GST_ELEMENT_ERROR(
      filter, STREAM, FAILED,
      ("A frame from %s does not match its caps: %s.", source, frame.problem().c_str()),
      ("the fault is in the element that allocated the frame"));
  return GST_FLOW_ERROR;
}

GstFlowReturn transform_checked(GstBaseTransform* transform, GstBuffer* in, GstBuffer* out) {
  auto* filter = reinterpret_cast<GstVideoFilter*>(transform);
  MappedFrame from(filter->in_info, in, GST_MAP_READ);
  if (!from.mapped()) return refuse_frame(filter, "the sink pad", from);
  MappedFrame to(filter->out_info, out, GST_MAP_WRITE);
  if (!to.mapped()) return refuse_frame(filter, "the buffer pool of downstream", to);
  return GST_VIDEO_FILTER_GET_CLASS(filter)->transform_frame(filter, from.frame(), to.frame());
}

}  // namespace mtstereo::plugin

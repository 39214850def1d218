// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/output.hpp"

#include "matcher/base/messages.hpp"
#include "matcher/output/allocation.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {

bool Output::adopt_segment(const std::shared_ptr<const StreamSegment>& segment) {
  if (!events.adopt_segment(segment)) return false;
  punctuality.restart();
  return true;
}

OutputTimes Output::times(GstBuffer* left) const {
  OutputTimes times;
  if (!GST_BUFFER_PTS_IS_VALID(left)) return times;
  const ObjectLock lock(element_);
  const GstSegment& segment = GST_AGGREGATOR_PAD(pad())->segment;
  if (segment.format != GST_FORMAT_TIME) return times;
  times.running = gst_segment_to_running_time(&segment, GST_FORMAT_TIME, GST_BUFFER_PTS(left));
  times.stream = gst_segment_to_stream_time(&segment, GST_FORMAT_TIME, GST_BUFFER_PTS(left));
  return times;
}

GstFlowReturn Output::make_map(GstBuffer* left, GstBuffer* right, BufferPointer& map) const {
  const GstFlowReturn flow = acquire_output(element_, info_.size, map);
  if (flow == GST_FLOW_OK) copy_frame_properties(left, right, map.get());
  return flow;
}

GstFlowReturn Output::send(BufferPointer map, const OutputTimes& times, double milliseconds) {
  events.before_buffer();
  punctuality.sent(times, milliseconds);
  GST_LOG_OBJECT(element_, "matched %" GST_PTR_FORMAT, static_cast<void*>(map.get()));
  return gst_aggregator_finish_buffer(element_, map.release());
}

void Output::start() {
  events.start();
  punctuality.start();
}

}  // namespace mtstereo::plugin

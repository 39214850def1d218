// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// The times of a left frame in the segment of the source pad.
struct OutputTimes {
  GstClockTime running = GST_CLOCK_TIME_NONE;
  GstClockTime stream = GST_CLOCK_TIME_NONE;
};

/// True if the disparity map of a left frame would be too late at the sink. The pair is then
/// counted as skipped, and a QoS message is posted. Runs in the task of the source pad.
bool skip_late_pair(ElementState& state, GstBuffer* left, const OutputTimes& times);

/// Notes that a map is sent downstream, `milliseconds` after the decision to match its pair. Posts
/// the message that the latency has changed if it has. Runs in the task of the source pad.
void note_sent_map(ElementState& state, const OutputTimes& times, double milliseconds);

/// Notes the lateness that a sink reports. Any thread.
void note_qos_event(ElementState& state, GstEvent* event);

/// Notes the latency of the pipeline. Any thread.
void note_latency_event(ElementState& state, GstEvent* event);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/skipping.hpp"

#include "matcher/clock.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

/// The lateness of the map, if it is to be skipped, and the counts after that.
struct Skip {
  Nanoseconds lateness = 0;
  double proportion = 1;
  Statistics counted;
};

std::optional<Skip> decide(ElementState& state, GstClockTime time) {
  const auto now = running_time_now(state);
  if (!now) return std::nullopt;
  const ObjectLock lock(state.element);
  if (!state.settings.qos) return std::nullopt;
  const auto matching_time = static_cast<Nanoseconds>(state.processing.expected_ms() * GST_MSECOND);
  const auto lateness = state.lateness.predict(bounded(time), *now, matching_time);
  if (!lateness || *lateness <= 0) return std::nullopt;
  ++state.statistics.skipped;
  return Skip{*lateness, state.qos_proportion, state.statistics};
}

}  // namespace

bool skip_late_pair(ElementState& state, GstBuffer* left, const OutputTimes& times) {
  if (!GST_CLOCK_TIME_IS_VALID(times.running)) return false;
  const auto skip = decide(state, times.running);
  if (!skip) return false;
  GstMessage* message =
      gst_message_new_qos(GST_OBJECT_CAST(state.element), is_live(state), times.running,
                          times.stream, GST_BUFFER_PTS(left), GST_BUFFER_DURATION(left));
  gst_message_set_qos_values(message, skip->lateness, skip->proportion, 1000000);
  gst_message_set_qos_stats(message, GST_FORMAT_BUFFERS, skip->counted.pairs,
                            skip->counted.skipped);
  gst_element_post_message(GST_ELEMENT_CAST(state.element), message);
  return true;
}

void note_sent_map(ElementState& state, const OutputTimes& times, double milliseconds) {
  const auto now = running_time_now(state);
  bool changed = false;
  double reported = 0;
  {
    const ObjectLock lock(state.element);
    changed = state.processing.measured(milliseconds);
    reported = state.processing.reported_ms();
    if (now && GST_CLOCK_TIME_IS_VALID(times.running)) {
      state.lateness.sent(bounded(times.running), *now);
    }
  }
  if (changed && is_live(state)) {
    GST_DEBUG_OBJECT(state.element, "the latency has a matching time of %.2f ms", reported);
    gst_element_post_message(GST_ELEMENT_CAST(state.element),
                             gst_message_new_latency(GST_OBJECT_CAST(state.element)));
  }
}

void note_qos_event(ElementState& state, GstEvent* event) {
  GstQOSType type = GST_QOS_TYPE_OVERFLOW;
  gdouble proportion = 1;
  GstClockTimeDiff jitter = 0;
  GstClockTime time = GST_CLOCK_TIME_NONE;
  gst_event_parse_qos(event, &type, &proportion, &jitter, &time);
  const ObjectLock lock(state.element);
  state.qos_proportion = proportion;
  // The time of a throttle event is a setting of the sink, no measurement.
  if (type == GST_QOS_TYPE_THROTTLE || !GST_CLOCK_TIME_IS_VALID(time)) return;
  state.lateness.sink_reported(bounded(time), bounded(jitter));
}

void note_latency_event(ElementState& state, GstEvent* event) {
  GstClockTime latency = GST_CLOCK_TIME_NONE;
  gst_event_parse_latency(event, &latency);
  if (!GST_CLOCK_TIME_IS_VALID(latency)) return;
  const ObjectLock lock(state.element);
  state.lateness.set_latency(bounded(latency));
}

}  // namespace mtstereo::plugin

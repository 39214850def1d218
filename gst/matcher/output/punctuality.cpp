// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/punctuality.hpp"

#include "matcher/base/messages.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

using Lock = std::lock_guard<std::mutex>;

}  // namespace

/// The lateness of a map that is skipped, and the counts after that.
struct Punctuality::Skip {
  Nanoseconds lateness = 0;
  double proportion = 1;
  guint64 skipped = 0;
};

std::optional<Punctuality::Skip> Punctuality::decide(GstClockTime time) {
  const auto now = clock_.now();
  if (!now) return std::nullopt;
  const Lock lock(mutex_);
  const auto matching_time = static_cast<Nanoseconds>(processing_.expected_ms() * GST_MSECOND);
  const auto lateness = lateness_.predict(bounded(time), *now, matching_time);
  if (!lateness || *lateness <= 0) return std::nullopt;
  return Skip{*lateness, proportion_, ++skipped_};
}

bool Punctuality::skip_if_late(GstBuffer* left, const OutputTimes& times, guint64 pairs) {
  if (!GST_CLOCK_TIME_IS_VALID(times.running)) return false;
  const auto skip = decide(times.running);
  if (!skip) return false;
  GstMessage* message =
      gst_message_new_qos(GST_OBJECT_CAST(element_), clock_.is_live(), times.running, times.stream,
                          GST_BUFFER_PTS(left), GST_BUFFER_DURATION(left));
  gst_message_set_qos_values(message, skip->lateness, skip->proportion, 1000000);
  gst_message_set_qos_stats(message, GST_FORMAT_BUFFERS, pairs, skip->skipped);
  gst_element_post_message(element_, message);
  return true;
}

void Punctuality::skip() {
  const Lock lock(mutex_);
  ++skipped_;
}

void Punctuality::sent(const OutputTimes& times, double milliseconds) {
  const auto now = clock_.now();
  bool changed = false;
  double reported = 0;
  {
    const Lock lock(mutex_);
    changed = processing_.measured(milliseconds);
    reported = processing_.reported_ms();
    if (now && GST_CLOCK_TIME_IS_VALID(times.running)) {
      lateness_.sent(bounded(times.running), *now);
    }
  }
  if (changed && clock_.is_live()) {
    GST_DEBUG_OBJECT(element_, "the latency has a matching time of %.2f ms", reported);
    gst_element_post_message(element_, gst_message_new_latency(GST_OBJECT_CAST(element_)));
  }
}

void Punctuality::note_qos_event(GstEvent* event) {
  GstQOSType type = GST_QOS_TYPE_OVERFLOW;
  gdouble proportion = 1;
  GstClockTimeDiff jitter = 0;
  GstClockTime time = GST_CLOCK_TIME_NONE;
  gst_event_parse_qos(event, &type, &proportion, &jitter, &time);
  const Lock lock(mutex_);
  proportion_ = proportion;
  // The time of a throttle event is a setting of the sink, no measurement.
  if (type == GST_QOS_TYPE_THROTTLE || !GST_CLOCK_TIME_IS_VALID(time)) return;
  lateness_.sink_reported(bounded(time), bounded(jitter));
}

void Punctuality::note_latency_event(GstEvent* event) {
  GstClockTime latency = GST_CLOCK_TIME_NONE;
  gst_event_parse_latency(event, &latency);
  if (!GST_CLOCK_TIME_IS_VALID(latency)) return;
  const Lock lock(mutex_);
  lateness_.set_latency(bounded(latency));
}

guint64 Punctuality::skipped() const {
  const Lock lock(mutex_);
  return skipped_;
}

GstClockTime Punctuality::processing_time() const {
  const Lock lock(mutex_);
  return static_cast<GstClockTime>(processing_.reported_ms() * GST_MSECOND);
}

void Punctuality::restart() {
  const Lock lock(mutex_);
  lateness_.restart();
}

void Punctuality::start() {
  const Lock lock(mutex_);
  lateness_ = {};
  processing_.reset();
  skipped_ = 0;
}

}  // namespace mtstereo::plugin

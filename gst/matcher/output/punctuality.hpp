// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <mutex>
#include <optional>

#include "matcher/base/clock.hpp"
#include "matcher/output/latency.hpp"
#include "matcher/output/lateness.hpp"

namespace mtstereo::plugin {

/// The times of a map in the segment of the source pad.
struct OutputTimes {
  GstClockTime running = GST_CLOCK_TIME_NONE;
  GstClockTime stream = GST_CLOCK_TIME_NONE;
};

/// Whether maps are in time for the sink (quality of service), and how long matching takes
/// (latency). Any thread. Call it without locks.
class Punctuality {
 public:
  Punctuality(GstElement* element, const PipelineClock& clock) : element_(element), clock_(clock) {}

  /// True if the map of a left frame would be too late at the sink. The pair is then counted as
  /// skipped, and a QoS message is posted. `pairs` is the number of matched pairs.
  bool skip_if_late(GstBuffer* left, const OutputTimes& times, guint64 pairs);
  /// A pair is skipped because a newer one has arrived.
  void skip();
  /// A map is sent downstream, `milliseconds` after the decision to match its pair. Posts the
  /// message that the latency has changed if it has.
  void sent(const OutputTimes& times, double milliseconds);

  /// The lateness that a sink reports.
  void note_qos_event(GstEvent* event);
  /// The latency of the pipeline.
  void note_latency_event(GstEvent* event);

  /// The number of skipped pairs.
  guint64 skipped() const;
  /// The matching time to report as latency [ns].
  GstClockTime processing_time() const;

  /// A flush or a new segment.
  void restart();
  void start();

 private:
  struct Skip;
  std::optional<Skip> decide(GstClockTime time);

  GstElement* const element_;
  const PipelineClock& clock_;

  mutable std::mutex mutex_;  // guards the members below
  Lateness lateness_;
  double proportion_ = 1;  // of the last QoS event
  ProcessingLatency processing_;
  guint64 skipped_ = 0;
};

}  // namespace mtstereo::plugin

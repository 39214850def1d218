// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::plugin {

/// The matching time that is expected of the next pair, and the one that the element reports as
/// latency. Both follow from the measured times. The reported value changes only if it is too short
/// or clearly too long, because the pipeline recomputes its latency after every change.
class ProcessingLatency {
 public:
  /// Adds the matching time of a pair [ms]. True if reported_ms() has changed.
  bool measured(double milliseconds);
  /// The time that few pairs exceed: the average plus twice the mean deviation [ms]; 0 before the
  /// first measurement.
  double expected_ms() const { return average_ + 2 * deviation_; }
  /// The time to report [ms]; 0 before the first measurement.
  double reported_ms() const { return reported_; }
  void reset() { *this = ProcessingLatency(); }

 private:
  bool first_ = true;     // the first pair also allocates buffers and is not counted
  double average_ = 0;    // [ms], exponential moving average
  double deviation_ = 0;  // [ms], exponential moving average of the distance from the average
  double reported_ = 0;   // [ms]
};

}  // namespace mtstereo::plugin

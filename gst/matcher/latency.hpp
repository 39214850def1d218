// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::plugin {

/// The matching time that the element reports as latency. It is an average of the measured times.
/// The reported value changes only if it is clearly wrong, because the pipeline recomputes its
/// latency after every change.
class ProcessingLatency {
 public:
  /// Adds the matching time of a pair [ms]. True if reported_ms() has changed.
  bool measured(double milliseconds);
  /// The time to report [ms]; 0 before the first measurement.
  double reported_ms() const { return reported_; }
  void reset() { *this = ProcessingLatency(); }

 private:
  bool first_ = true;    // the first pair also allocates buffers and is not counted
  double average_ = 0;   // [ms], exponential moving average
  double reported_ = 0;  // [ms]
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::plugin {

/// The time that matching takes, as told to the pipeline. It follows the measured times slowly and
/// the told value changes only when it is clearly wrong, as every change makes the whole pipeline
/// compute its latency anew.
class ProcessingLatency {
 public:
  /// One pair took this long [ms]. True: reported_ms() has changed.
  bool measured(double milliseconds);
  /// What to tell [ms]; 0 until there is a measurement.
  double reported_ms() const { return reported_; }
  void reset() { *this = ProcessingLatency(); }

 private:
  bool first_ = true;    // the first pair also sizes the buffers: it does not count
  double average_ = 0;   // [ms], exponential
  double reported_ = 0;  // [ms]
};

}  // namespace mtstereo::plugin

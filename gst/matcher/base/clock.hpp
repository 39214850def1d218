// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>

#include <atomic>
#include <optional>

#include "shared/times.hpp"

namespace mtstereo::plugin {

/// The time of the pipeline, as the element sees it. Any thread.
class PipelineClock {
 public:
  explicit PipelineClock(GstAggregator* element) : element_(element) {}

  /// The pipeline is in PLAYING, so that the base time of its clock is valid.
  void set_playing(bool playing) { playing_ = playing; }
  bool playing() const { return playing_; }
  /// The running time; std::nullopt before PLAYING or without a clock. Takes the object lock.
  std::optional<Nanoseconds> now() const;
  /// True if a source is live, so that frames have a deadline. Takes the lock of the aggregator:
  /// not with the object lock.
  bool is_live() const { return GST_CLOCK_TIME_IS_VALID(gst_aggregator_get_latency(element_)); }

 private:
  GstAggregator* const element_;
  std::atomic<bool> playing_ = false;
};

}  // namespace mtstereo::plugin

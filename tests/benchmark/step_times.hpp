// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "frames.hpp"
#include "matcher/frame_matcher.hpp"
#include "outcome.hpp"

namespace mtstereo::bench {

/// Times the steps of a matcher inside whole frames, on one thread: a step gets the time from the
/// end of the step before it to its own end, so that the steps of a frame add up to the frame.
class StepTimes {
 public:
  /// Both images must outlive the object.
  StepTimes(const Parameters& parameters, const Pair& pair);

  /// The steps that these parameters run, in the order of the method.
  const std::vector<std::string>& names() const { return names_; }

  /// Matches frames for about this time, at least one, after one that is not timed. Returns the
  /// mean time of each step [s], in the order of names(). Throws std::runtime_error where the
  /// result is not that of a Matcher with these parameters.
  std::vector<double> measure(double seconds);

 private:
  using Clock = std::chrono::steady_clock;

  /// Matches one frame and adds the time of each step to `sums` [s].
  FrameResult run(std::vector<double>& sums);

  Pair pair_;
  FrameMatcher matcher_;
  std::vector<std::string> names_;
  Outcome expected_;
};

/// Registers a benchmark for each step: those of the defaults, then those that only other modes and
/// presets run. Each repetition takes about this time per mode or preset, at least a frame.
void register_steps(const FramePointer& frame, double seconds);

}  // namespace mtstereo::bench

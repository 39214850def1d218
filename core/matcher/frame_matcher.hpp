// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>

#include "base/thread_pool.hpp"
#include "matcher/frame_memory.hpp"
#include "matcher/resolution_choice.hpp"
#include "matcher/settings.hpp"
#include "matcher/steps.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo {

/// Runs the steps on one pair after another. A Matcher owns one; tests, the benchmark and
/// the images of docs/ use it directly to observe the steps. Throws; a Matcher turns exceptions
/// into errors.
class FrameMatcher {
 public:
  /// Called after each step that ran, on the thread that called compute(). An observer changes
  /// neither which steps run nor their results.
  using Observer = std::function<void(const Step& step, const FrameMemory& memory)>;

  explicit FrameMatcher(const Settings& settings) : settings_(settings) {}

  /// Applies other settings from the next pair on. Settings that choose the resolution of each
  /// frame, as the ones before did, keep the choice.
  void set(const Settings& settings);
  const Settings& settings() const { return settings_; }

  /// Begins the choice of the resolution anew, and forgets the pairs so far, as for another stream.
  void restart();
  /// Forgets the pairs so far.
  void forget() {
    memory_.past.restart();
    memory_.last.restart();
  }

  /// Matches a pair of views of equal size, which must fit the settings. Allocates memory for the
  /// first pair and after a change of settings or size only. Throws std::bad_alloc, and
  /// std::system_error if a thread cannot start; the matcher can be used again after that.
  FrameResult compute(GrayView left, GrayView right, const Observer& observer = {});

 private:
  void resize(ImageSize input);
  void size_memory(const Settings& settings);
  FrameResult run_steps(const Observer& observer);
  double choose_resolution(const FrameResult& result);

  Settings settings_;
  ResolutionChoice choice_;
  std::optional<ThreadPool> pool_;
  FrameMemory memory_;
  FrameSize size_;
  bool sized_ = false;  ///< the memory has the size for settings_ and size_
};

}  // namespace mtstereo

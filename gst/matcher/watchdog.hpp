// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <array>
#include <mutex>

#include "matcher/silence.hpp"

namespace mtstereo::plugin {

struct ElementState;

/// What the watchdog knows of the task of the source pad. Guarded by the object lock.
struct WatchdogInput {
  /// Frames of each side that were taken from the pad and wait for a partner.
  std::array<bool, 2> held{};
  /// aggregate() is running: a pair is being matched, or downstream blocks.
  bool busy = false;
  /// Incremented by every flush.
  std::uint64_t flushes = 0;
  /// Statistics::pairs at the last flush.
  std::uint64_t pairs_before = 0;
};

/// Reports a pad that is not linked, or on which no frame arrives, while frames wait on the other
/// pad. In live pipelines frames have a deadline, so nothing is reported there. Also nothing is
/// reported in PAUSED after preroll. The system clock calls it at regular times, in a thread that
/// all elements of the process share.
class Watchdog {
 public:
  explicit Watchdog(ElementState& state) : state_(state) {}
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Starts the timer. The element must not be in finalization.
  void start();
  /// Stops the timer. The last call may still be running then; it keeps the element alive.
  void stop();
  /// Called by the timer, with its id.
  void check(GstClockID timer);

 private:
  void schedule();  // with mutex_ held
  void cancel();    // with mutex_ held

  ElementState& state_;
  std::mutex mutex_;            // guards the members below
  GstClockID timer_ = nullptr;  // nullptr: stopped
  SilenceDetector detector_;
};

/// Marks the task of the source pad as busy during its lifetime.
class BusyMark {
 public:
  explicit BusyMark(ElementState& state);
  ~BusyMark();
  BusyMark(const BusyMark&) = delete;
  BusyMark& operator=(const BusyMark&) = delete;

 private:
  ElementState& state_;
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/watchdog.hpp"

#include <algorithm>

#include "shared/exception_guard.hpp"

namespace mtstereo::plugin {
namespace {

constexpr Nanoseconds kShortestInterval = 5'000'000;   // of the timer [ns]
constexpr Nanoseconds kLongestInterval = 500'000'000;  // of the timer [ns]

/// What the timer calls. It has no reference to the element, so that the element can be finalized.
struct Target {
  GWeakRef element;
  Watchdog* watchdog;  // valid while there is a strong reference to the element
};

void free_target(gpointer data) noexcept {
  auto* target = static_cast<Target*>(data);
  g_weak_ref_clear(&target->element);
  delete target;
}

gboolean on_timer(GstClock*, GstClockTime, GstClockID timer, gpointer data) noexcept {
  auto* target = static_cast<Target*>(data);
  gpointer element = g_weak_ref_get(&target->element);
  if (element == nullptr) return FALSE;
  try {
    target->watchdog->check(timer);
  } catch (...) {
    post_exception(element);
  }
  g_object_unref(element);
  return TRUE;
}

}  // namespace

Watchdog::~Watchdog() { stop(); }

void Watchdog::start() {
  const std::lock_guard lock(mutex_);
  cancel();
  detector_ = {};
  start_ = {};
  empty_ = {};
  schedule();
}

void Watchdog::stop() {
  const std::lock_guard lock(mutex_);
  cancel();
}

void Watchdog::cancel() {
  if (timer_ == nullptr) return;
  gst_clock_id_unschedule(timer_);
  gst_clock_id_unref(timer_);
  timer_ = nullptr;
}

void Watchdog::schedule() {
  const Nanoseconds timeout = functions_.timeout();
  const Nanoseconds interval = timeout == 0
                                   ? kLongestInterval
                                   : std::clamp(timeout / 8, kShortestInterval, kLongestInterval);
  GstClock* clock = gst_system_clock_obtain();
  timer_ = gst_clock_new_single_shot_id(
      clock, gst_clock_get_time(clock) + static_cast<GstClockTime>(interval));
  gst_object_unref(clock);
  auto* target = new Target{{}, this};
  g_weak_ref_init(&target->element, element_);
  gst_clock_id_wait_async(timer_, on_timer, target, free_target);
}

void Watchdog::check(GstClockID timer) {
  const StreamsObservation streams = functions_.observe();
  const Nanoseconds timeout = functions_.timeout();
  const Nanoseconds now = g_get_monotonic_time() * 1000;
  std::optional<Side> silent;
  bool stuck = false;
  bool empty = false;
  {
    const std::lock_guard lock(mutex_);
    if (timer != timer_) return;  // stopped in the meantime
    if (timeout > 0) {
      silent = detector_.silent(streams, now, timeout);
      stuck = start_.due(streams.starting, now, timeout);
      empty = empty_.due(streams.empty, now, 2 * timeout);
    }
    gst_clock_id_unref(timer_);
    schedule();
  }
  if (silent) functions_.report(*silent, timeout);
  if (stuck) functions_.report_start(timeout);
  if (empty) functions_.report_empty(2 * timeout);
}

}  // namespace mtstereo::plugin

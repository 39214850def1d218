// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/watchdog.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "matcher/clock.hpp"
#include "matcher/element_state.hpp"
#include "shared/exception_guard.hpp"
#include "shared/ownership.hpp"

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

Nanoseconds timeout_of(const ElementState& state) {
  const ObjectLock lock(state.element);
  return static_cast<Nanoseconds>(
      std::min<guint64>(state.settings.timeout, static_cast<guint64>(G_MAXINT64)));
}

StreamsObservation observe(const ElementState& state) {
  StreamsObservation streams;
  for (const Side side : kSides) {
    const auto index = static_cast<std::size_t>(side);
    GstAggregatorPad* pad = state.input(side).pad;
    streams.waiting[index] = gst_aggregator_pad_has_buffer(pad) != FALSE;
    streams.ended[index] = gst_aggregator_pad_is_eos(pad) != FALSE;
  }
  const ObjectLock lock(state.element);
  const WatchdogInput& input = state.watchdog_input;
  const Statistics& counts = state.statistics;
  for (const std::size_t index : {0u, 1u}) {
    streams.waiting[index] = streams.waiting[index] || input.held[index];
  }
  // A paused pipeline that has its first map is paused by its user, who may pause the sources too.
  const bool paused = !state.playing && counts.pairs > input.pairs_before;
  streams.busy = input.busy || paused;
  streams.progress =
      counts.pairs + counts.skipped + counts.dropped[0] + counts.dropped[1] + input.flushes;
  return streams;
}

std::string seconds(Nanoseconds time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", static_cast<double>(time) / 1e9);
  return text;
}

/// Ends the stream of an unlinked pad. Otherwise the element would still wait for its frames,
/// and the other stream would neither get the error nor come to its end.
void end_stream(GstAggregatorPad* pad) {
  gst_pad_send_event(GST_PAD_CAST(pad), gst_event_new_stream_start("unlinked"));
  gst_pad_send_event(GST_PAD_CAST(pad), gst_event_new_eos());
}

/// Reports a silent pad. Frames of live streams have a deadline, and are reported there.
void report(ElementState& state, Side silent, Nanoseconds timeout) {
  if (is_live(state)) return;
  const std::string pad = pad_name(silent);
  const std::string other = pad_name(other_side(silent));
  const std::string details = "waited for " + seconds(timeout) + " (property timeout)";
  if (gst_pad_is_linked(GST_PAD_CAST(state.input(silent).pad))) {
    post_warning(state,
                 "Frames wait on " + other + ", but none has arrived on " + pad + " for " +
                     seconds(timeout) +
                     ". Check the source of that stream. If both streams come from one element, "
                     "put a queue upstream of each pad.",
                 details);
    return;
  }
  post_error(state, GST_CORE_ERROR, GST_CORE_ERROR_PAD,
             "Frames wait on " + other + ", but " + pad +
                 " is not linked. Link the other stream to it, by \"! NAME." + pad +
                 "\" on a command line.",
             details);
  end_stream(state.input(silent).pad);
}

}  // namespace

Watchdog::~Watchdog() { stop(); }

void Watchdog::start() {
  const std::lock_guard lock(mutex_);
  cancel();
  detector_ = {};
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
  const Nanoseconds timeout = timeout_of(state_);
  const Nanoseconds interval = timeout == 0
                                   ? kLongestInterval
                                   : std::clamp(timeout / 8, kShortestInterval, kLongestInterval);
  GstClock* clock = gst_system_clock_obtain();
  timer_ = gst_clock_new_single_shot_id(
      clock, gst_clock_get_time(clock) + static_cast<GstClockTime>(interval));
  gst_object_unref(clock);
  auto* target = new Target{{}, this};
  g_weak_ref_init(&target->element, state_.element);
  gst_clock_id_wait_async(timer_, on_timer, target, free_target);
}

void Watchdog::check(GstClockID timer) {
  const StreamsObservation streams = observe(state_);
  const Nanoseconds timeout = timeout_of(state_);
  std::optional<Side> silent;
  {
    const std::lock_guard lock(mutex_);
    if (timer != timer_) return;  // stopped in the meantime
    if (timeout > 0) silent = detector_.silent(streams, g_get_monotonic_time() * 1000, timeout);
    gst_clock_id_unref(timer_);
    schedule();
  }
  if (silent) report(state_, *silent, timeout);
}

BusyMark::BusyMark(ElementState& state) : state_(state) {
  const ObjectLock lock(state_.element);
  state_.watchdog_input.busy = true;
}

BusyMark::~BusyMark() {
  const ObjectLock lock(state_.element);
  state_.watchdog_input.busy = false;
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <functional>
#include <mutex>

#include "matcher/silence.hpp"

namespace mtstereo::plugin {

/// Reports a stream that is silent, or a start that takes, too long, and streams without any frame,
/// after twice that time: cameras and networks need some to begin. The system clock calls it at
/// regular times, in a thread that all elements of the process share.
class Watchdog {
 public:
  /// What it asks and calls, in its thread, while it holds a reference to the element.
  struct Functions {
    std::function<StreamsObservation()> observe;
    std::function<Nanoseconds()> timeout;  ///< 0: no report
    std::function<void(Side silent, Nanoseconds timeout)> report;
    std::function<void(Nanoseconds timeout)> report_start;  ///< the pipeline does not start
    std::function<void(Nanoseconds time)> report_empty;     ///< no frame at all in this time
  };

  Watchdog(gpointer element, Functions functions)
      : element_(element), functions_(std::move(functions)) {}
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

  const gpointer element_;
  const Functions functions_;
  std::mutex mutex_;            // guards the members below
  GstClockID timer_ = nullptr;  // nullptr: stopped
  SilenceDetector detector_;
  LongWait start_;
  LongWait empty_;
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "shared/ownership.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

/// A frame of the left view.
struct LeftFrame {
  BufferPointer buffer;
  GstVideoInfo info{};
  std::optional<Nanoseconds> time;  ///< running time
};

/// The frames of the left view that wait for their disparity map. The left pad's thread adds them,
/// that of the disparity maps takes them. A few frames wait; then the left pad blocks, which is
/// what keeps a file from being read faster than it is matched. Neither thread blocks for ever: a
/// wait ends after a timeout, when the other stream ends, and when a pad is flushed.
class LeftFrames {
 public:
  using Duration = std::chrono::nanoseconds;
  /// Frames that wait at most.
  static constexpr std::size_t kMost = 8;
  /// Frames whose times differ by less belong together [ns].
  static constexpr Nanoseconds kSameTime = 1'000'000;

  /// The longest time that either thread waits for the other one.
  void set_timeout(Duration timeout);

  // --- the left pad ---

  /// Adds a frame. Waits while kMost frames wait and maps arrive, or may still arrive; after the
  /// timeout the oldest frame is dropped.
  GstFlowReturn push(LeftFrame frame);
  /// There are no frames before this running time: the start of a gap that ended.
  void skip_to(Nanoseconds time);
  /// There are no more frames.
  void end();
  /// Discards all frames, and refuses new ones while it is true.
  void set_flushing(bool flushing);

  // --- the pad of the disparity maps ---

  enum class Outcome {
    kFound,        ///< the frame of this time
    kNone,         ///< there is none, or the timeout was over
    kInterrupted,  ///< interrupt() was called
  };
  /// Takes the frame of this running time, and drops all older ones. Without a time, the oldest
  /// frame.
  Outcome find(std::optional<Nanoseconds> time, LeftFrame& frame);
  /// While it is true, the sink is paused with a map: the left pad waits without a timeout.
  void hold(bool held);
  /// While it is true, find() does not wait.
  void interrupt(bool interrupted);
  /// There are no more maps: frames are accepted and discarded.
  void finish(bool finished);

 private:
  bool full() const { return frames_.size() >= kMost; }
  void drop_before(Nanoseconds time);
  bool none_will_come(std::optional<Nanoseconds> time) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  // All guarded by mutex_.
  std::deque<LeftFrame> frames_;
  Duration timeout_{};
  std::optional<Nanoseconds> reached_;  ///< end of the last gap
  unsigned maps_ = 0;                   ///< calls of find(): progress of the other thread
  bool ended_ = false;
  bool flushing_ = true;
  bool held_ = false;
  bool interrupted_ = false;
  bool finished_ = false;
  bool no_maps_ = false;    ///< the left pad waited in vain
  bool no_frames_ = false;  ///< find() waited in vain
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>

#include "matcher/pairing/frame_queue.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::plugin {

/// The time axis on which the frames of two segments are compared. It has the direction of the
/// running time and the unit of the stream time: a frame takes as long as its caps state, and the
/// skew of two cameras is as large as they have it, at every rate. Frames of the same stream time
/// have the same time if both segments follow the same seek: a seek to key frames starts each file
/// at another time, and in reverse each at its own end.
class PairAxis {
 public:
  /// nullptr: no segment has arrived.
  PairAxis(const std::shared_ptr<const StreamSegment>& left,
           const std::shared_ptr<const StreamSegment>& right);

  /// The time at a running time of the segment of this side.
  Nanoseconds time(Side side, Nanoseconds running_time) const;
  /// The stream time decreases.
  bool reverse() const { return reverse_; }

 private:
  double speed_ = 1;  // of the stream time, without its direction
  bool reverse_ = false;
  std::array<Nanoseconds, 2> running_shift_{};  // added to running times
  std::array<Nanoseconds, 2> shift_{};          // added to times on the axis
};

/// True if all frames that are at most `tolerance` from this frame would be in a gap of the other
/// stream.
bool is_in_gap(const QueuedFrame& frame, Side side, const FrameQueue& others,
               Nanoseconds tolerance);

}  // namespace mtstereo::plugin

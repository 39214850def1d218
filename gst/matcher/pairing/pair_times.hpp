// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "matcher/pairing/frame_queue.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::plugin {

/// The times by which the frames at the heads of the two queues are paired.
struct PairTimes {
  /// Of the frames of each side, up to the first gap or the first frame without a time.
  std::array<std::vector<Nanoseconds>, 2> times;
  /// Something else than such a frame follows: there is nothing more to wait for.
  std::array<bool, 2> complete{};
};

/// Computes the times of frames by the property `sync-mode`.
class PairClock {
 public:
  /// The times of two queues that begin with a frame. In the mode kArrival no frame has a time.
  PairTimes times(const FrameQueue& left, const FrameQueue& right, SyncMode mode);
  /// Forgets the streams.
  void reset() { *this = PairClock(); }

 private:
  std::array<std::optional<Nanoseconds>, 2> first_;  // times of the first frames on the axis
};

}  // namespace mtstereo::plugin

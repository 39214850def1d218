// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deque>
#include <optional>

#include "programs/calibrate/detection.hpp"

namespace mtstereo::calibrate {

/// Corners at one time.
struct Moment {
  double time = 0;  ///< of the pair [s]
  BoardView view;
};

/// The corners of a board in motion. Keeps the last ones only.
class Track {
 public:
  static constexpr std::size_t kMost = 2000;
  void add(double time, BoardView view);
  const std::deque<Moment>& moments() const { return moments_; }

 private:
  std::deque<Moment> moments_;
};

/// When the right camera exposes its frames, after the left one's frames that they are paired with.
struct TimeOffset {
  double seconds = 0;    ///< negative: earlier
  double deviation = 0;  ///< its standard deviation [s]
  int pairs = 0;         ///< that it comes from

  /// The cameras are surely not synchronized, by an amount that matters.
  bool significant() const;
};

/// Estimates the time offset of two calibrated cameras from a board in motion: at an offset, the
/// corners of the right view are ahead of or behind where the left view places the board, along
/// their paths. std::nullopt if the board has hardly moved. `swapped`: the left views of the track
/// are those of the right camera.
std::optional<TimeOffset> estimate_offset(const Rig& rig, const Track& track, bool swapped = false);

}  // namespace mtstereo::calibrate

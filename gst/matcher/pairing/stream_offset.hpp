// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include "shared/times.hpp"

namespace mtstereo::plugin {

/// How the time differences of the pairs develop.
struct DifferenceStatistics {
  int pairs = 0;      ///< counted so far; 0: the other fields mean nothing
  double mean = 0;    ///< right minus left, at the last pair [ns]
  double spread = 0;  ///< standard deviation about the drifting mean [ns]
  double drift = 0;   ///< change of the mean [ns per s]; 0 until kPairsOfDrift pairs
};

/// Mean, spread and drift of the differences of the last few hundred pairs: a line through them, in
/// which the weight of a pair falls with its age.
class DifferenceLine {
 public:
  static constexpr int kPairsOfDrift = 60;

  void add(Nanoseconds time, Nanoseconds difference);
  DifferenceStatistics statistics() const;

 private:
  int pairs_ = 0;
  Nanoseconds origin_ = 0;
  double weight_ = 0;
  double time_ = 0, difference_ = 0;                              // weighted means [s], [ns]
  double time_square_ = 0, product_ = 0, difference_square_ = 0;  // weighted covariances
  double last_time_ = 0;
};

/// How far the frames of the right stream are after their partners [ns], learned from the times of
/// both streams. Two cameras that are triggered together often have time stamps that differ by a
/// constant, which may slowly change. The partner of a frame is the one at this distance, not the
/// nearest one: that may be its neighbor if the partner is lost.
class StreamOffset {
 public:
  /// Frames of each side that learning needs.
  static constexpr int kFrames = 4;

  bool known() const { return known_; }
  /// The expected difference of a pair, right minus left; 0 if not known.
  Nanoseconds value() const { return known_ ? bounded(value_) : 0; }

  /// Learns from the times of frames that overlap: the difference that most frames have from the
  /// frames of the other side, of which one in each `period` is counted. Returns false, and learns
  /// nothing, if a side has fewer than `frames`.
  bool learn(std::span<const Nanoseconds> left, std::span<const Nanoseconds> right,
             Nanoseconds period, int frames = kFrames);
  /// A pair was found.
  void add(Nanoseconds left_time, Nanoseconds difference);
  /// From now on the partner is the frame that is `distance` later (negative: earlier).
  void slip(Nanoseconds distance);

  /// The offset is to be learned again. The statistics remain.
  void forget() { known_ = false; }

  const DifferenceLine& line() const { return line_; }

 private:
  bool known_ = false;
  int pairs_ = 0;
  double value_ = 0;
  DifferenceLine line_;
};

}  // namespace mtstereo::plugin

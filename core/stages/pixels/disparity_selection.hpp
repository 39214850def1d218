// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The last part of guided pixel matching: decides about each pixel's disparity of least cost,
/// which row_walk found.

struct SelectionOptions {
  int disparities;           ///< D
  double confidence;         ///< omega_Pi: the runner-up has to exceed the best by more, as a share
  bool runner_up_in_range;   ///< only disparities of the expected range can be runner-up
  int left_right_tolerance;  ///< largest difference to the right pixel's disparity [px], -1 = any
  bool subpixel;             ///< refine by the V of equal slopes through the best and its neighbors
  int ratio_offset;          ///< peak_ratio()'s offset [steps of the costs]
  /// A disparity at least this far from both ends of its expected range needs no check [px]; -1 =
  /// all need it. An end at 0 or D - 1 may be closer. A pixel that expects all disparities needs
  /// it.
  int guided_margin = -1;
};

/// The offset of the peak ratio for one path [bits of one pixel].
inline constexpr int kRatioOffset = 10;

/// In place of a sum of paths, and a sum that counts as none. A sum has half the range of the
/// costs.
inline constexpr int kNoSum = 255;

/// Pixels that are finished together, at most.
inline constexpr int kFinishedTogether = 8;

/// Maps the best sum to the least sum that is sufficient for its runner-up. Has three bytes more,
/// so that vectors can be looked up.
using RunnerUpTable = std::array<std::uint8_t, kNoSum + 1 + 3>;
RunnerUpTable runner_up_table(double confidence);

/// What is known of each pixel of a row before it is decided. Memory of one thread.
struct Candidates {
  int width = 0;              ///< of the row
  Buffer<std::int16_t> best;  ///< the disparity of least sum

  /// The sums of each pixel: those of the disparity before the best one, of the best one and of
  /// the one after it, and that of the runner-up; kNoSum for those that it has not.
  enum Sum { kBefore, kLeast, kAfter, kSecond, kSums };
  Buffer<std::uint8_t> sums;  ///< [column][sum]

  /// The right pixels' least costs so far and their disparities, mirrored: the right pixel of
  /// column x at disparity d is at width - 1 - x + d. Successive pixels use copies in turn: with
  /// one copy, each pixel's loads would wait for its neighbor's stores.
  static constexpr int kTurns = 2;
  enum Plane { kCosts, kHigh, kLow, kPlanes };  // a byte each
  Buffer<std::uint8_t> right;       ///< [plane][turn]: PathSums, disparities / 256 and % 256
  std::ptrdiff_t right_stride = 0;  ///< from turn to turn

  const std::uint8_t* decided(Plane plane) const {
    return right.data() + plane * kTurns * right_stride;
  }

  void resize(int columns, int disparities);
};

/// Writes the row of the disparity map [1 / kDisparityOne px] and of the peak ratios (0 for pixels
/// without a disparity). A pixel without a sufficient runner-up or with low > high gets no
/// disparity.
void finish_selection(int width, const SelectionOptions& options, const RunnerUpTable& runner_up,
                      const std::uint16_t* low, const std::uint16_t* high,
                      const Candidates& candidates, std::int32_t* disparity, std::uint8_t* ratio);

}  // namespace mtstereo

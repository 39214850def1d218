// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The last part of guided pixel matching: each pixel's disparity of least cost, and whether it can
/// be trusted.

struct SelectionOptions {
  int disparities;           ///< D
  double confidence;         ///< omega_Pi: the runner-up has to cost more than this share above
  bool runner_up_in_range;   ///< the runner-up is looked for in the expected range only
  int left_right_tolerance;  ///< largest difference to the right pixel's disparity [px], -1 = any
  bool subpixel;             ///< refine by the V of equal slopes through the best and its neighbors
};

/// Scratch memory of one thread: the best of each right pixel, in mirrored order.
struct SelectionScratch {
  Buffer<std::uint16_t> least;      ///< cost
  Buffer<std::uint16_t> disparity;  ///< whole disparity
  Buffer<std::uint16_t> best;       ///< the same of each left pixel, or kNothing
  static constexpr std::uint16_t kNothing = 0xFFFF;

  void resize(int width);
};

/// Writes a row of the disparity map [1 / kDisparityOne px] and of the peak ratios (0 where there
/// is no disparity), from the costs of optimize_scanline(). The best of equal
/// costs is the smallest disparity. The runner-up is the least cost of the disparities that are not
/// next to the best; a pixel without one has no disparity. Pixels with low > high have no expected
/// range.
void select_disparities(const std::uint16_t* sums, int width, const SelectionOptions& options,
                        const std::uint16_t* low, const std::uint16_t* high,
                        SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio);

}  // namespace mtstereo

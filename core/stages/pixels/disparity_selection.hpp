// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The last part of guided pixel matching: each pixel's disparity of least cost, and whether it can
/// be trusted. A row is begun, its pixels' costs are offered in any order, and then it is finished.

struct SelectionOptions {
  int disparities;           ///< D
  double confidence;         ///< omega_Pi: the runner-up has to cost more than this share above
  bool runner_up_in_range;   ///< the runner-up is looked for in the expected range only
  int left_right_tolerance;  ///< largest difference to the right pixel's disparity [px], -1 = any
  bool subpixel;             ///< refine by the V of equal slopes through the best and its neighbors
};

/// Costs that are compared are below this.
inline constexpr int kCostLimit = 511;

/// Of each cost of the best the least one that its runner-up has to have.
using RunnerUpTable = std::array<std::uint16_t, kCostLimit>;
RunnerUpTable runner_up_table(double confidence);

/// Scratch memory of one thread.
///
/// Costs compete together with their disparities, in one word: the cost in the upper nine bits, the
/// disparity in the lower seven, so that of equal costs the smallest disparity is less; all of it
/// less 2^15, since signed words are compared everywhere in one instruction. More disparities than
/// seven bits hold are cut into groups with competitions of their own.
struct SelectionScratch {
  static constexpr int kGroup = 128;             ///< disparities of a group
  static constexpr std::int16_t kNone = 0x7FFF;  ///< no word, and no cost
  /// Competitions for the same right pixel: the pixels of a row take turns, since each would wait
  /// for what its neighbor has written.
  static constexpr int kTurns = 4;

  Buffer<std::int16_t> index;       ///< of each disparity what makes a word of its cost
  Buffer<std::int16_t> right;       ///< [turn][group] the least words of the right pixels, mirrored
  std::ptrdiff_t right_stride = 0;  ///< from group to group [elements]
  /// Of each left pixel: its disparity of least cost, that cost, the runner-up's, and the costs of
  /// the disparities before and after.
  Buffer<std::int16_t> best, least, second, before, after;

  void resize(int width, int disparities);
};

/// Begins a row.
void start_selection(SelectionScratch& scratch);

/// Offers the costs of the columns begin .. end - 1, that of column x and disparity d at
/// (x - begin) * cost_lanes() + d, all of them below kCostLimit, and those of the cells d >= D just
/// below it. Pixels with low > high have no
/// expected range.
void offer_costs(const std::uint16_t* costs, int begin, int end, int width,
                 const SelectionOptions& options, const std::uint16_t* low,
                 const std::uint16_t* high, SelectionScratch& scratch);

/// Writes the row of the disparity map [1 / kDisparityOne px] and of the peak ratios (0 where there
/// is no disparity). The best of equal costs is the smallest disparity. The runner-up is the least
/// cost of the disparities that are not next to the best; a pixel without one has no disparity, nor
/// has one with low > high.
void finish_selection(int width, const SelectionOptions& options, const std::uint16_t* low,
                      const std::uint16_t* high, const RunnerUpTable& runner_up,
                      SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "base/buffer.hpp"
#include "stages/pixels/cost_lanes.hpp"

namespace mtstereo {

/// The last part of guided pixel matching: selects each pixel's disparity of least cost and checks
/// it. For each row: call start_selection(), then offer_costs() for its pixels in any order, then
/// finish_selection().

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

/// All valid costs are below this.
inline constexpr int kCostLimit = 511;

/// Maps the best cost to the least cost that is sufficient for its runner-up.
using RunnerUpTable = std::array<std::uint16_t, kCostLimit>;
RunnerUpTable runner_up_table(double confidence);

/// Scratch memory of one thread.
///
/// A cost and its disparity are compared as one 16-bit word: the cost in the upper nine bits, the
/// disparity in the lower seven, so that the smaller disparity wins among equal costs. 2^15 is
/// subtracted, since every processor compares signed words in one instruction. Seven bits hold
/// kGroup disparities; more disparities are divided into groups, whose words are compared
/// separately.
struct SelectionScratch {
  static constexpr int kGroup = 128;             ///< disparities of a group
  static constexpr std::int16_t kNone = 0x7FFF;  ///< no word, and no cost
  /// Copies of the right pixels' least words. Successive pixels of a row update them in turn: with
  /// one copy, each pixel's loads would wait for its neighbor's stores.
  static constexpr int kTurns = 4;

  Buffer<std::int16_t> index;       ///< per disparity: the sum with the shifted cost is the word
  Buffer<std::int16_t> right;       ///< [turn][group]: the right pixels' least words, mirrored
  std::ptrdiff_t right_stride = 0;  ///< from group to group [elements]
  /// Per left pixel: its disparity of least cost, that cost, the runner-up's cost, and the costs of
  /// the disparities before and after the best one.
  Buffer<std::int16_t> best, least, second, before, after;
  Buffer<std::int16_t> other;        ///< per left pixel: the disparity of its right pixel
  Buffer<std::uint16_t> sufficient;  ///< per left pixel: the least cost for its runner-up

  void resize(int width, int disparities);
};

/// Starts a row.
void start_selection(SelectionScratch& scratch);

/// Passes the costs of the columns begin .. end - 1: that of column x and disparity d is at
/// (x - begin) * cost_lanes() + d. Costs are below kCostLimit; those of the cells d >= D are
/// kCostLimit - 1. Pixels with low > high have no expected range. `windows` are those of the row's
/// tiles, nullptr = all lanes; disparities outside of them do not exist.
void offer_costs(const std::uint16_t* costs, int begin, int end, int width,
                 const SelectionOptions& options, const std::uint16_t* low,
                 const std::uint16_t* high, const CostWindow* windows, SelectionScratch& scratch);

/// Writes the row of the disparity map [1 / kDisparityOne px] and of the peak ratios (0 for pixels
/// without a disparity). Of equal costs the smallest disparity is the best. The runner-up is the
/// least cost of the disparities that differ from the best by more than 1. A pixel without a
/// runner-up or with low > high gets no disparity.
void finish_selection(int width, const SelectionOptions& options, const std::uint16_t* low,
                      const std::uint16_t* high, const RunnerUpTable& runner_up,
                      SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio);

}  // namespace mtstereo

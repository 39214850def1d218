// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "base/buffer.hpp"
#include "mtstereo/parameters.hpp"

/// The data of disparity_selection.hpp: its options, and the words that its kernels compare.

namespace mtstereo {

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

/// All valid costs are below this.
inline constexpr int kCostLimit = 511;

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

inline constexpr int kDisparityBits = 7;
inline constexpr int kMostGroups =
    (kLargestMaxDisparity + SelectionScratch::kGroup - 1) / SelectionScratch::kGroup;
static_assert(SelectionScratch::kGroup == 1 << kDisparityBits);
inline constexpr int kLowestWord = std::numeric_limits<std::int16_t>::min();
inline constexpr int kMostCost = (kCostLimit - 1) << kDisparityBits;
static_assert(kLowestWord + kMostCost + SelectionScratch::kGroup - 1 < SelectionScratch::kNone);

/// Pixels that are finished together, at most.
inline constexpr int kFinishedTogether = 8;

}  // namespace mtstereo

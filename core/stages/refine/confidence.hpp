// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The confidence of each disparity: how many pixels around it have a disparity that fits, and how
/// clearly those differ from their runners-up. A continuous form of the paper's votes ("Confidence
/// check and map refinement") that also decreases towards the border of a known region.

/// Radius of the window, without its middle pixel [px].
inline constexpr int kSupportRadius = 4;

/// Side of the window [px].
inline constexpr int kSupportSide = 2 * kSupportRadius + 1;

/// The window's pixels may be those of every second row and column: the ones between them say much
/// the same. A step of 1 takes all, as the paper does.
inline constexpr int kSupportStep = 2;
static_assert(kSupportRadius % kSupportStep == 0);

/// Rows and columns of the window that count.
constexpr int support_side(int step) { return 2 * (kSupportRadius / step) + 1; }

/// A disparity supports another one at a distance of n px (the larger of columns and rows) if the
/// two differ by at most kSupportTolerance + n * kSupportSlope, since surfaces may be slanted.
inline constexpr int kSupportTolerance = 32;  ///< [1 / kVoteOne px]
inline constexpr int kSupportSlope = 13;      ///< [1 / kVoteOne px per px]

/// The tolerance at a distance [1 / kVoteOne px].
constexpr int support_tolerance(int away) { return kSupportTolerance + away * kSupportSlope; }

/// No disparity. Its distance from every disparity, modulo 2^16, is larger than any tolerance.
inline constexpr std::uint16_t kSupportNone = 0xFC00;

/// Added to the ratio of each disparity, so that the upper bits of a sum of ratios count them. The
/// sum of 15 pixels fits into 16 bits.
inline constexpr std::uint16_t kSupportOne = 1 << 12;

/// Steps per 1 of the product whose cube root is the confidence.
inline constexpr int kSupportBits = 12;
inline constexpr int kSupportSteps = 1 << kSupportBits;

/// Copies of a disparity map and its peak ratios in the form that the sums need, with a border of
/// kSupportRadius columns on both sides.
struct SupportMap {
  Image<std::uint16_t> disparity;  ///< [1 / kVoteOne px], or kSupportNone
  Image<std::uint16_t> ratio;      ///< kSupportOne plus 0 .. 255; 0 without a disparity

  void resize(int width, int height, ReusedMemory* reused = nullptr);
};

/// Copies the rows y0 .. y1 - 1.
void copy_support(const Image<std::int32_t>& map, const Image<std::uint8_t>& ratio, int y0, int y1,
                  SupportMap& support);

/// Words of the widest vectors.
inline constexpr int kSupportLanes = kAlignment / 2;

/// Scratch memory of one thread.
struct SupportScratch {
  Buffer<std::uint16_t> count;  ///< number of supporting pixels
  Buffer<std::uint16_t> ratio;  ///< sum of their peak ratios
  Buffer<std::uint16_t> steps;  ///< the product in 1 / kSupportSteps, plus 1; 0 without support
  /// Twice the tolerance at each distance, minus 2^15: a vector each, since these constants need
  /// more registers than processors have.
  Buffer<std::int16_t> widest;

  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1: 255 times the cube root of c * c * r, at least 1. c is the share
/// of the window's pixels that support the middle one, including itself; r is the sum of their peak
/// ratios (0 .. 1) divided by the number of the window's pixels. The product is truncated to whole
/// steps of 1 / kSupportSteps. The confidence is 0 for pixels without a disparity and where `asked`
/// is 0; such a pixel can still support others. The window is cut off at the image's border.
/// `step`: 1 or kSupportStep.
void rate_support(const SupportMap& support, const Image<std::uint8_t>& asked, int step, int y0,
                  int y1, SupportScratch& scratch, Image<std::uint8_t>& confidence);

/// The part of rate_support() whose exactness is not obvious, available for tests: computes
/// SupportScratch::steps from `count` and `ratio`, for windows of `pixels` pixels (up to 81).
void find_support_steps(int pixels, int width, SupportScratch& scratch);

/// Multiplies the confidence of the rows y0 .. y1 - 1 by `weight` / 255, rounded; the result is at
/// least 1 where the confidence was.
void weigh_confidence(const Image<std::uint8_t>& weight, int y0, int y1,
                      Image<std::uint8_t>& confidence);

/// Sets the confidence of the rows y0 .. y1 - 1 to 0 where there is no disparity.
void clear_unknown(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint8_t>& confidence);

/// Removes the disparities of the rows y0 .. y1 - 1 whose confidence is below `least`.
void threshold_confidence(int least, int y0, int y1, Image<std::int32_t>& map,
                          Image<std::uint8_t>& confidence);

}  // namespace mtstereo

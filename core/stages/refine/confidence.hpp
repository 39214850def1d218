// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"

namespace mtstereo {

/// The confidence of each disparity: how many pixels around it have one that fits, and how clearly
/// they were told from their runners-up. A continuous form of the paper's votes ("Confidence check
/// and map refinement") that also falls towards the rim of what is known.

/// Half the side of the window, without its middle [px].
inline constexpr int kSupportRadius = 4;

/// Side of the window [px].
inline constexpr int kSupportSide = 2 * kSupportRadius + 1;

/// A disparity supports one that is n px away (the larger of columns and rows) where the two differ
/// by at most kSupportTolerance + n * kSupportSlope: surfaces may be slanted.
inline constexpr int kSupportTolerance = 32;  ///< [1 / kVoteOne px]
inline constexpr int kSupportSlope = 13;      ///< [1 / kVoteOne px per px]

/// Further from every disparity than any tolerance, the distance taken modulo 2^16.
inline constexpr std::uint16_t kSupportNone = 0xC000;

/// What each disparity adds to a sum of ratios: the upper bits count. A row of the window fits.
inline constexpr std::uint16_t kSupportOne = 1 << 12;

/// Steps to which a share is cut before its cube root is taken.
inline constexpr int kSupportSteps = 4096;

/// Copies of a disparity map and its peak ratios in the form that the sums are made of, with a
/// border of kSupportRadius columns on both sides.
struct SupportMap {
  Image<std::uint16_t> disparity;  ///< [1 / kVoteOne px], kSupportNone where there is none
  Image<std::uint16_t> ratio;      ///< kSupportOne and 0 .. 255, 0 where there is no disparity

  void resize(int width, int height);
};

/// Copies the rows y0 .. y1 - 1.
void copy_support(const Image<std::int32_t>& map, const Image<std::uint8_t>& ratio, int y0, int y1,
                  SupportMap& support);

/// Scratch memory of one thread.
struct SupportScratch {
  Buffer<std::uint16_t> count;  ///< pixels that support
  Buffer<std::uint16_t> ratio;  ///< sum of their peak ratios
  Buffer<std::uint16_t> steps;  ///< what the confidence is the cube root of, and 1; 0 for none

  void resize(int width);
};

/// Writes the rows y0 .. y1 - 1: 255 times the cube root of c * c * r, where c is the share of the
/// window's pixels that support the middle one, itself included, and r the sum of their peak ratios
/// (0 .. 1) divided by the window's pixels. The product is cut to whole 1/4096. 1 at least; 0 where
/// there is no disparity, and where `asked` is 0: a pixel can support others without being rated.
/// The window ends at the image's border.
void rate_support(const SupportMap& support, const Image<std::uint8_t>& asked, int y0, int y1,
                  SupportScratch& scratch, Image<std::uint8_t>& confidence);

/// The step of rate_support() by itself that is not obviously exact: the 1/4096 that the product is
/// cut to, and 1, from count and ratio, for windows of `pixels` pixels (up to 81); 0 where nothing
/// was counted.
void find_support_steps(int pixels, int width, SupportScratch& scratch);

/// Takes the disparities of the rows y0 .. y1 - 1 away whose confidence is below `least`.
void remove_doubtful(int least, int y0, int y1, Image<std::int32_t>& map,
                     Image<std::uint8_t>& confidence);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// Finds views that show nothing or repeat themselves. Reads a small part of the pixels, whatever
/// the size of the images.

/// A view is blank if the standard deviation of its gray values is at most this and the other view
/// has at least kContentDeviation.
inline constexpr double kBlankDeviation = 2.5;
inline constexpr double kContentDeviation = 10;

/// A view is frozen if it has repeated itself in this many successive pairs while the other one
/// changed each time. Encoders repeat single frames too.
inline constexpr int kFrozenPairs = 8;

/// What is known of the views of the successive pairs, indexed by Side.
class PairWatch {
 public:
  void watch(GrayView left, GrayView right);
  void reset() { *this = {}; }

  bool blank(int side) const { return blank_[side]; }
  bool frozen(int side) const { return repeats_[side] >= kFrozenPairs; }

 private:
  bool has_last_ = false;
  std::array<std::uint64_t, 2> last_{};  ///< checksums of the last pair
  std::array<bool, 2> blank_{};
  std::array<int, 2> repeats_{};  ///< successive pairs in which only this view was repeated
};

}  // namespace mtstereo

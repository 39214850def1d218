// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo {

/// A pair of nodes by their columns.
struct NodePair {
  int left_begin, left_end;    ///< first and last column of the left node [px]
  int right_begin, right_end;  ///< of the right node [px]

  int begin_disparity() const { return left_begin - right_begin; }
  int end_disparity() const { return left_end - right_end; }
};

/// Fractional bits of the interpolated disparities between the ends of a pair.
inline constexpr int kSlopeBits = 16;

/// Increase of the disparity from column to column of the left node, in 1 / 2^kSlopeBits px,
/// rounded towards zero. 0 for a node of one column.
inline int disparity_slope(const NodePair& pair) {
  const int length = pair.left_end - pair.left_begin;
  const long long rise = pair.end_disparity() - pair.begin_disparity();
  return length == 0 ? 0 : static_cast<int>(rise * (1 << kSlopeBits) / length);
}

}  // namespace mtstereo

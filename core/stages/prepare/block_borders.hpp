// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// How clearly a compressed view shows its blocks. JPEG and most video codecs divide each view into
/// blocks of 8x8 px, and gray values step from block to block.

/// Side of a block [px], and the same in halved views.
inline constexpr int kBlockSide = 8;
inline constexpr int kHalvedBlockSide = kBlockSide / 2;

/// The rows that are measured: one of so many.
inline constexpr int kBlockRows = 4;

/// The steps of some rows. They are whole numbers, and their sums the same in any order.
struct BlockBorders {
  int side = kBlockSide;  ///< of a block in the view, a power of two [px]
  /// By the column of the right pixel modulo `side`: the steps of the gray value between
  /// neighbors that exceed the mean step on both sides, up to 4 each [half gray values].
  std::array<std::int64_t, kBlockSide> steps{};
  std::int64_t count = 0;  ///< of the steps in each of these sums

  /// Adds the steps of other rows of the same view.
  void add(const BlockBorders& other);

  /// How many times as large as elsewhere the steps are in the columns of the borders, less what
  /// chance may add in a small view, whose edges may lie in some columns. About 1 in a view without
  /// blocks, 1.1 to 2.5 after JPEG of quality 80, 1.5 to 4.2 of quality 50; 0 in views that are too
  /// small.
  double visibility() const;

  /// Whether the view shows blocks.
  bool visible() const;
};

/// Measures the rows y0 .. y1 - 1.
BlockBorders measure_borders(GrayView view, int side, int y0, int y1);

}  // namespace mtstereo

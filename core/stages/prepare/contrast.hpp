// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// The contrast of a view, from the histogram of its gray values. In a view of a dark scene the
/// edges are as much smaller as its range of gray values.

/// The rows that are counted: one of so many.
inline constexpr int kContrastRows = 4;

/// A gray value is rare if fewer than one of so many pixels have it or are brighter.
inline constexpr int kRareShare = 1000;

/// Compression changes clipped pixels by this much at most.
inline constexpr int kClippedReach = 2;

/// One of so many pixels at least are clipped in views that have clipped pixels.
inline constexpr int kClippedShare = 100;

/// GrayHistogram::clipped_from() of views without clipped pixels.
inline constexpr int kNothingClipped = 256;

/// The gray values of some rows.
struct GrayHistogram {
  std::array<std::int64_t, 256> counts{};

  /// Adds the values of other rows of the same view.
  void add(const GrayHistogram& other);

  /// The number of pixels.
  std::int64_t total() const;

  /// How far apart the gray values are that 5 % of the pixels are below and above; 0 for no pixels.
  int range() const;

  /// The gray value from which on pixels are clipped by the sensor: kClippedReach below the
  /// brightest one that is not rare; kNothingClipped if few pixels are that bright.
  int clipped_from() const;
};

/// Counts the rows y0 .. y1 - 1.
GrayHistogram count_grays(GrayView view, int y0, int y1);

}  // namespace mtstereo

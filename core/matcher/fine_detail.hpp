// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "base/bands.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// How much the finest octave of the views shows of the scene: whether full resolution has anything
/// that half the resolution has not.
///
/// At pixels that are matched at nearly whole disparities, the two views show the same points of
/// the scene, so that the product of their high frequencies is the energy of what both have in
/// common. Noise and compression differ in the views and cancel out. The energy in the finest
/// octave, divided by the energy in the next one, depends on lens, focus and processing of the
/// camera more than on the scene.

/// What is compared. `disparity` and `confidence` belong to the left view.
struct DetailViews {
  GrayView left;
  GrayView right;  ///< as it was matched
  DisparityView disparity;
  GrayView confidence;
  int disparity_offset;  ///< added to the disparities [px]
};

/// The rows that are measured: one of so many.
inline constexpr int kDetailRows = 4;

/// A disparity is nearly whole up to this distance from a whole one [1 / kDisparityOne px].
inline constexpr int kNearlyWhole = kDisparityOne / 8;

/// Columns on both sides of a point that are read [px].
inline constexpr int kDetailReach = 6;

/// Sums over some points of the views. They are whole numbers, and the same in any order.
struct FineDetail {
  std::int64_t fine = 0;    ///< products of both views' finest octave [kBandOne^2 gray values^2]
  std::int64_t coarse = 0;  ///< the same of the next octave
  std::int64_t points = 0;

  /// Adds the sums of other rows of the same views.
  void add(const FineDetail& other);

  /// The energy in the finest octave, divided by that in the next one; at least 0. Nothing if there
  /// are too few points for it, or if the views have hardly any texture there.
  std::optional<double> share() const;
};

/// The factor of the values that the band filters give.
inline constexpr int kBandOne = 32;

/// With fewer points, or with less energy per point in the coarse octave [gray values^2], there is
/// no share.
inline constexpr int kLeastDetailPoints = 250;
inline constexpr double kLeastCoarseEnergy = 0.5;

/// Measures the points in the rows y0 .. y1 - 1.
FineDetail measure_detail(const DetailViews& views, int y0, int y1);

/// The same for all rows.
FineDetail measure_detail(const Bands& bands, const DetailViews& views);

}  // namespace mtstereo

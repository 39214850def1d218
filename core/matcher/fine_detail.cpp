// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/fine_detail.hpp"

#include <algorithm>
#include <cstdlib>

namespace mtstereo {
namespace {

/// A half-band high-pass filter along the row, of every `step`-th column: for 1 the finest octave,
/// for 2 the next one. The values have the factor kBandOne.
int band(const std::uint8_t* pixel, int step) {
  return 16 * pixel[0] - 9 * (pixel[-step] + pixel[step]) + pixel[-3 * step] + pixel[3 * step];
}

void add_point(const std::uint8_t* left, const std::uint8_t* right, FineDetail& sums) {
  sums.fine += std::int64_t{band(left, 1)} * band(right, 1);
  sums.coarse += std::int64_t{band(left, 2)} * band(right, 2);
  ++sums.points;
}

void add_row(const DetailViews& views, int y, FineDetail& sums) {
  const std::int32_t* disparity = views.disparity.row(y);
  const std::uint8_t* confidence = views.confidence.row(y);
  const std::uint8_t* left = views.left.row(y);
  const std::uint8_t* right = views.right.row(y);
  const int last = std::min(views.left.width, views.right.width) - kDetailReach - 1;
  for (int x = kDetailReach; x < views.left.width - kDetailReach; ++x) {
    if (disparity[x] == kNoDisparity || confidence[x] <= kMostInferred) continue;
    const int whole = (disparity[x] + kDisparityOne / 2) / kDisparityOne;
    if (std::abs(disparity[x] - whole * kDisparityOne) > kNearlyWhole) continue;
    const int partner = x - whole - views.disparity_offset;
    if (partner >= kDetailReach && partner <= last) add_point(left + x, right + partner, sums);
  }
}

}  // namespace

std::optional<double> FineDetail::share() const {
  const double least = kLeastCoarseEnergy * kBandOne * kBandOne * static_cast<double>(points);
  if (points < kLeastDetailPoints || static_cast<double>(coarse) < least) return std::nullopt;
  return std::max(static_cast<double>(fine) / static_cast<double>(coarse), 0.0);
}

void FineDetail::add(const FineDetail& other) {
  fine += other.fine;
  coarse += other.coarse;
  points += other.points;
}

FineDetail measure_detail(const DetailViews& views, int y0, int y1) {
  FineDetail sums;
  const int first = (y0 + kDetailRows - 1) / kDetailRows * kDetailRows;
  for (int y = first; y < y1; y += kDetailRows) add_row(views, y, sums);
  return sums;
}

FineDetail measure_detail(const Bands& bands, const DetailViews& views) {
  return bands.sum_of_rows(FineDetail(),
                           [&](int y0, int y1) { return measure_detail(views, y0, y1); });
}

}  // namespace mtstereo

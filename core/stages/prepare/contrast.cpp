// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/contrast.hpp"

#include <cstddef>
#include <numeric>

namespace mtstereo {

void GrayHistogram::add(const GrayHistogram& other) {
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
}

std::int64_t GrayHistogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

int GrayHistogram::range() const {
  const std::int64_t rest = total() / 20;
  std::int64_t below = 0;
  int first = 0, last = 255;
  while (first < last && (below += counts[first]) <= rest) ++first;
  std::int64_t above = 0;
  while (last > first && (above += counts[last]) <= rest) --last;
  return last - first;
}

int GrayHistogram::clipped_from() const {
  const std::int64_t all = total();
  int brightest = 255;
  std::int64_t reaching = counts[brightest];
  while (brightest > kClippedReach && reaching * kRareShare < all) reaching += counts[--brightest];
  const int least = brightest - kClippedReach;
  for (int gray = least; gray < brightest; ++gray) reaching += counts[gray];
  return all > 0 && reaching * kClippedShare >= all ? least : kNothingClipped;
}

GrayHistogram count_grays(GrayView view, int y0, int y1) {
  GrayHistogram histogram;
  const int first = (y0 + kContrastRows - 1) / kContrastRows * kContrastRows;
  for (int y = first; y < y1; y += kContrastRows) {
    const std::uint8_t* row = view.row(y);
    for (int x = 0; x < view.width; ++x) ++histogram.counts[row[x]];
  }
  return histogram;
}

}  // namespace mtstereo

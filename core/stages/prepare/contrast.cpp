// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/contrast.hpp"

#include <cstddef>

namespace mtstereo {

void GrayHistogram::add(const GrayHistogram& other) {
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
}

int GrayHistogram::range() const {
  std::int64_t all = 0;
  for (const std::int64_t count : counts) all += count;
  const std::int64_t rest = all / 20;
  std::int64_t below = 0;
  int first = 0, last = 255;
  while (first < last && (below += counts[first]) <= rest) ++first;
  std::int64_t above = 0;
  while (last > first && (above += counts[last]) <= rest) --last;
  return last - first;
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

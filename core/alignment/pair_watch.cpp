// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/pair_watch.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo {
namespace {

/// Figures of some pixels of a view: every n-th one in a few rows.
struct RowSample {
  std::uint64_t checksum = 0;
  double deviation = 0;  ///< standard deviation of the gray values
};

RowSample sample_of(GrayView view) {
  constexpr int kRows = 64, kColumns = 256;
  const int rows = std::min(view.height, kRows), columns = std::min(view.width, kColumns);
  RowSample sample;
  std::int64_t sum = 0, squares = 0;
  for (int j = 0; j < rows; ++j) {
    const std::uint8_t* row = view.row(view.height * j / rows);
    for (int i = 0; i < columns; ++i) {
      const int gray = row[view.width * i / columns];
      sum += gray;
      squares += gray * gray;
      sample.checksum = (sample.checksum ^ static_cast<std::uint64_t>(gray)) * 1099511628211U;
    }
  }
  const double count = static_cast<double>(rows) * columns;
  const double mean = static_cast<double>(sum) / count;
  sample.deviation = std::sqrt(std::max(static_cast<double>(squares) / count - mean * mean, 0.0));
  return sample;
}

}  // namespace

void PairWatch::watch(GrayView left, GrayView right) {
  const std::array<RowSample, 2> now = {sample_of(left), sample_of(right)};
  for (int side = 0; side < 2; ++side) {
    const RowSample& other = now[1 - side];
    blank_[side] = now[side].deviation <= kBlankDeviation && other.deviation >= kContentDeviation;
    const bool repeated = has_last_ && now[side].checksum == last_[side];
    const bool other_changed = other.checksum != last_[1 - side];
    if (!repeated) {
      repeats_[side] = 0;
    } else if (other_changed) {
      repeats_[side] = std::min(repeats_[side] + 1, kFrozenPairs);
    }
  }
  last_ = {now[0].checksum, now[1].checksum};
  has_last_ = true;
}

}  // namespace mtstereo

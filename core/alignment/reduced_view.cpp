// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/reduced_view.hpp"

#include <algorithm>
#include <cstring>

#define HWY_TARGET_INCLUDE "alignment/reduced_view.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

// Compilers vectorize these plain loops.

void add_row(const std::uint8_t* __restrict__ row, int width, std::int32_t* __restrict__ sums) {
  for (int x = 0; x < width; ++x) sums[x] += row[x];
}

void add_difference(const std::int16_t* __restrict__ added,
                    const std::int16_t* __restrict__ removed, int width,
                    std::int32_t* __restrict__ sums) {
  for (int x = 0; x < width; ++x) sums[x] += added[x] - removed[x];
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(add_row);
HWY_EXPORT(add_difference);

namespace {

/// The means of the squares of one row of squares.
void reduce_row(GrayView view, int y, ReducedView& reduced) {
  const int factor = reduced.factor;
  const int width = reduced.means.width();
  std::int32_t* sums = reduced.row_sums.data();
  std::memset(sums, 0, sizeof(*sums) * width * factor);
  for (int i = 0; i < factor; ++i) {
    HWY_DYNAMIC_DISPATCH(add_row)(view.row(y * factor + i), width * factor, sums);
  }
  std::int16_t* means = reduced.means.row(y);
  const int area = factor * factor;
  for (int x = 0; x < width; ++x) {
    int sum = 0;
    for (int i = 0; i < factor; ++i) sum += sums[x * factor + i];
    means[x] = static_cast<std::int16_t>((2 * kHighPassGain * sum + area) / (2 * area));
  }
}

/// One row of the difference from the local means; the window is clipped at the border.
void subtract_mean(const std::int32_t* sums, int rows, int y, ReducedView& reduced) {
  constexpr int kHalf = kHighPassSize / 2;
  const int width = reduced.means.width();
  const std::int16_t* means = reduced.means.row(y);
  std::uint8_t* out = reduced.gray.row(y);
  std::int32_t sum = 0;
  for (int x = 0; x < std::min(kHalf, width); ++x) sum += sums[x];
  for (int x = 0; x < width; ++x) {
    if (x + kHalf < width) sum += sums[x + kHalf];
    if (x - kHalf - 1 >= 0) sum -= sums[x - kHalf - 1];
    const int count = rows * (std::min(x + kHalf, width - 1) - std::max(x - kHalf, 0) + 1);
    out[x] = static_cast<std::uint8_t>(std::clamp(128 + means[x] - sum / count, 0, 255));
  }
}

}  // namespace

int reduction_factor(int width) { return std::max(1, (width + 320) / 640); }

void ReducedView::reduce(GrayView view) {
  factor = reduction_factor(view.width);
  const int width = view.width / factor, height = view.height / factor;
  gray.resize(width, height);
  means.resize(width, height);
  row_sums.resize(static_cast<std::size_t>(width) * factor);
  column_sums.resize(width);
  for (int y = 0; y < height; ++y) reduce_row(view, y, *this);

  constexpr int kHalf = kHighPassSize / 2;
  std::int32_t* sums = column_sums.data();
  std::fill_n(sums, width, 0);
  for (int y = 0; y < std::min(kHalf, height); ++y) {
    for (int x = 0; x < width; ++x) sums[x] += means.row(y)[x];
  }
  for (int y = 0; y < height; ++y) {
    const bool adds = y + kHalf < height, removes = y - kHalf - 1 >= 0;
    if (adds && removes) {
      HWY_DYNAMIC_DISPATCH(add_difference)
      (means.row(y + kHalf), means.row(y - kHalf - 1), width, sums);
    } else {
      for (int x = 0; adds && x < width; ++x) sums[x] += means.row(y + kHalf)[x];
      for (int x = 0; removes && x < width; ++x) sums[x] -= means.row(y - kHalf - 1)[x];
    }
    const int rows = std::min(y + kHalf, height - 1) - std::max(y - kHalf, 0) + 1;
    subtract_mean(sums, rows, y, *this);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

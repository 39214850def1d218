// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/cost_volume.hpp"

#include <algorithm>
#include <cmath>

#define HWY_TARGET_INCLUDE "stages/prepare/cost_volume.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The cost's input of one pixel row of both views.
struct RowPair {
  const std::int16_t* left[3];
  const std::int16_t* right[3];
};

RowPair row_pair(const PreprocessedView& left, const PreprocessedView& right, int y) {
  return {{left.gray.row(y), left.sobel_x.row(y), left.sobel_y.row(y)},
          {right.gray.row(y), right.sobel_x.row(y), right.sobel_y.row(y)}};
}

/// The unsmoothed costs of a vector of pixels that begins at column x.
template <class D>
hn::Vec<D> raw_cost(D du, const RowPair& rows, int x, int d) {
  const hn::RebindToSigned<D> di;
  auto sum = hn::Zero(du);
  for (int i = 0; i < 3; ++i) {
    const auto difference =
        hn::Sub(hn::LoadU(di, rows.left[i] + x), hn::LoadU(di, rows.right[i] + x - d));
    sum = hn::Add(sum, hn::BitCast(du, hn::Abs(difference)));
  }
  return sum;
}

/// Unsmoothed costs of one row of cells at disparity d, into out[0 .. columns - 1].
void reduced_row(const PreprocessedView& left, const PreprocessedView& right, int cell_row, int d,
                 int shift, std::uint16_t* raw, std::int16_t* out) {
  const hn::CappedTag<std::uint16_t, kAlignment / 2> du;
  const hn::RebindToSigned<decltype(du)> di;
  const int lanes = static_cast<int>(hn::Lanes(du));
  const int width = left.gray.width();
  const int height = left.gray.height();
  std::uint16_t* target = shift == 0 ? reinterpret_cast<std::uint16_t*>(out) : raw;

  const int y = cell_row << shift;
  const RowPair upper = row_pair(left, right, y);
  if (shift == 0) {
    for (int x = d; x < width; x += lanes) hn::StoreU(raw_cost(du, upper, x, d), du, target + x);
  } else {
    const RowPair lower = row_pair(left, right, std::min(y + 1, height - 1));
    for (int x = d; x < width; x += lanes) {
      hn::StoreU(hn::AverageRound(raw_cost(du, upper, x, d), raw_cost(du, lower, x, d)), du,
                 target + x);
    }
  }
  std::fill_n(target, d, target[d]);
  if (shift == 0) return;
  target[width] = target[width - 1];  // the last cell of an odd width has one column only
  for (int x = 0; x < width; x += 2 * lanes) {
    hn::Vec<decltype(du)> even, odd;
    hn::LoadInterleaved2(du, raw + x, even, odd);
    hn::StoreU(hn::BitCast(di, hn::AverageRound(even, odd)), di, out + x / 2);
  }
}

/// Weighted sums along the row. `in` has kernel.size() - 1 cells on each side of the row.
void smooth_row(const std::int16_t* in, int columns, const SmoothingKernel& kernel,
                std::int16_t* out) {
  const hn::CappedTag<std::int16_t, kAlignment / 2> di;
  const int lanes = static_cast<int>(hn::Lanes(di));
  const int radius = static_cast<int>(kernel.size()) - 1;
  for (int x = 0; x < columns; x += lanes) {
    auto sum = hn::MulFixedPoint15(hn::LoadU(di, in + x), hn::Set(di, kernel[0]));
    for (int k = 1; k <= radius; ++k) {
      const auto weight = hn::Set(di, kernel[k]);
      sum = hn::Add(sum, hn::MulFixedPoint15(hn::LoadU(di, in + x - k), weight));
      sum = hn::Add(sum, hn::MulFixedPoint15(hn::LoadU(di, in + x + k), weight));
    }
    hn::StoreU(sum, di, out + x);
  }
}

/// Writes the weighted sums of 2 radius + 1 rows to the volume; rows[radius] is the center.
void smooth_column(const std::int16_t* const* rows, int columns, const SmoothingKernel& kernel,
                   std::uint16_t* out) {
  const hn::CappedTag<std::int16_t, kAlignment / 2> di;
  const hn::RebindToUnsigned<decltype(di)> du;
  const int lanes = static_cast<int>(hn::Lanes(di));
  const int radius = static_cast<int>(kernel.size()) - 1;
  for (int x = 0; x < columns; x += lanes) {
    auto sum = hn::MulFixedPoint15(hn::LoadU(di, rows[radius] + x), hn::Set(di, kernel[0]));
    for (int k = 1; k <= radius; ++k) {
      const auto weight = hn::Set(di, kernel[k]);
      sum = hn::Add(sum, hn::MulFixedPoint15(hn::LoadU(di, rows[radius - k] + x), weight));
      sum = hn::Add(sum, hn::MulFixedPoint15(hn::LoadU(di, rows[radius + k] + x), weight));
    }
    hn::StoreU(hn::BitCast(du, sum), du, out + x);
  }
}

void cost_slices(const PreprocessedView& left, const PreprocessedView& right,
                 const SmoothingKernel& kernel, int d0, int d1, CostScratch& scratch,
                 CostVolume& volume) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  const int taps = 2 * radius + 1;
  const int columns = volume.columns;
  std::int16_t* reduced = scratch.reduced.data() + radius;
  // The ring holds the last `taps` horizontally smoothed rows of every slice of the block.
  const auto ring_row = [&](int d, int cell_row) {
    return scratch.ring.data() + ((d - d0) * taps + cell_row % taps) * volume.stride;
  };
  const std::int16_t* rows[2 * 41 + 1];

  for (int in = 0; in < volume.rows + radius; ++in) {
    const int out = in - radius;
    for (int d = d0; d < d1; ++d) {
      if (in < volume.rows) {
        reduced_row(left, right, in, d, volume.shift, scratch.raw.data(), reduced);
        std::fill_n(reduced - radius, radius, reduced[0]);
        std::fill_n(reduced + columns, radius, reduced[columns - 1]);
        smooth_row(reduced, columns, kernel, ring_row(d, in));
      }
      if (out < 0) continue;
      for (int k = -radius; k <= radius; ++k) {
        rows[radius + k] = ring_row(d, std::clamp(out + k, 0, volume.rows - 1));
      }
      smooth_column(
          rows, columns, kernel,
          volume.cells.data() +
              (static_cast<std::ptrdiff_t>(out) * volume.disparities + d) * volume.stride);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(cost_slices);

void CostVolume::resize(int width, int height, int disparity_count, int resolution_shift) {
  constexpr int kLanes = kAlignment / sizeof(std::uint16_t);
  disparities = disparity_count;
  shift = resolution_shift;
  columns = (width + (1 << shift) - 1) >> shift;
  rows = (height + (1 << shift) - 1) >> shift;
  stride = (columns + kLanes - 1) / kLanes * kLanes;
  cells.resize(static_cast<std::size_t>(rows) * disparities * stride);
}

SmoothingKernel smoothing_kernel(int size, int shift) {
  const double sigma = 0.3 * ((size - 1) * 0.5 - 1) + 0.8;
  // A mean over 2 px has a variance of 1/4 px^2; the kernel contributes the rest, in cells.
  const double variance = shift == 0 ? sigma * sigma : (sigma * sigma - 0.25) / 4;
  const int radius = (size / 2 + shift) >> shift;
  std::vector<double> weights(radius + 1, 1.0);
  double sum = 1;
  for (int k = 1; k <= radius; ++k) {
    weights[k] = std::exp(-k * k / (2 * variance));
    sum += 2 * weights[k];
  }
  SmoothingKernel kernel(radius + 1);
  int rest = 32768;
  for (int k = radius; k > 0; --k) {
    kernel[k] = static_cast<std::int16_t>(std::lround(weights[k] / sum * 32768));
    rest -= 2 * kernel[k];
  }
  kernel[0] = static_cast<std::int16_t>(std::min(rest, 32767));
  return kernel;
}

void CostScratch::resize(const CostVolume& volume, const SmoothingKernel& kernel) {
  const std::size_t radius = kernel.size() - 1;
  raw.resize((static_cast<std::size_t>(volume.columns) << volume.shift) + 2 * kAlignment);
  reduced.resize(volume.columns + 2 * radius + 2 * kAlignment);
  ring.resize(slices_per_block(volume, kernel) * (2 * radius + 1) * volume.stride);
}

int slices_per_block(const CostVolume& volume, const SmoothingKernel& kernel) {
  constexpr std::size_t kRingBytes =
      256 * 1024;  // leaves room for the rest in a second-level cache
  const std::size_t slice = (2 * kernel.size() - 1) * volume.stride * sizeof(std::int16_t);
  return static_cast<int>(std::clamp<std::size_t>(kRingBytes / slice, 1, 8));
}

void compute_cost_slices(const PreprocessedView& left, const PreprocessedView& right,
                         const SmoothingKernel& kernel, int d0, int d1, CostScratch& scratch,
                         CostVolume& volume) {
  HWY_DYNAMIC_DISPATCH(cost_slices)(left, right, kernel, d0, d1, scratch, volume);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/preprocess.hpp"

#include <algorithm>
#include <cstring>

#include "stages/prepare/sobel_rows.hpp"

#define HWY_TARGET_INCLUDE "stages/prepare/preprocess.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Words = hn::CappedTag<std::int16_t, kAlignment / 2>;
using Bytes = hn::Rebind<std::uint8_t, Words>;
using Vector = hn::Vec<Words>;

Vector load_gray(const std::uint8_t* row) {
  return hn::PromoteTo(Words(), hn::LoadU(Bytes(), row));
}

void sum_vector(SobelRows rows, int x, SobelSums sums) {
  const Words d16;
  const Vector above = load_gray(rows.above + x);
  const Vector here = load_gray(rows.here + x);
  const Vector below = load_gray(rows.below + x);
  const Vector smooth = hn::Add(hn::Add(above, below), hn::Add(here, here));
  hn::StoreU(smooth, d16, sums.smooth + x);
  hn::StoreU(hn::Sub(below, above), d16, sums.difference + x);
}

/// Computes the column sums of a row. Reads nothing past the end of the rows, which may be in the
/// caller's image.
void sum_columns(SobelRows rows, int width, SobelSums sums) {
  const int step = static_cast<int>(hn::Lanes(Words()));
  int x = 0;
  for (; x + step <= width; x += step) sum_vector(rows, x, sums);
  for (; x < width; ++x) {
    const int above = rows.above[x];
    const int below = rows.below[x];
    sums.smooth[x] = static_cast<std::int16_t>(above + 2 * rows.here[x] + below);
    sums.difference[x] = static_cast<std::int16_t>(below - above);
  }
  for (std::int16_t* row : {sums.smooth, sums.difference}) {
    row[-1] = row[std::min(1, width - 1)];
    row[width] = row[std::max(width - 2, 0)];
  }
}

Vector sobel_x(SobelSums sums, int x) {
  const Words d16;
  return hn::Sub(hn::LoadU(d16, sums.smooth + x + 1), hn::LoadU(d16, sums.smooth + x - 1));
}

Vector sobel_y(SobelSums sums, int x) {
  const Words d16;
  const Vector middle = hn::LoadU(d16, sums.difference + x);
  const Vector ends =
      hn::Add(hn::LoadU(d16, sums.difference + x - 1), hn::LoadU(d16, sums.difference + x + 1));
  return hn::Add(ends, hn::Add(middle, middle));
}

/// The levels of a row of edge strengths e = |Sobel x| + |Sobel y|: ((255 - e / 2) - 125) * 255 /
/// 130 * q / 256, which is (260 - e) * 51 q / (1024 * 13).
void write_levels(SobelSums sums, int width, int gray_levels, std::uint8_t* levels) {
  const Words d16;
  const hn::RebindToUnsigned<Words> du16;
  constexpr int kFlat = 260;
  // For numbers below 4096, multiplying by this and truncating 16 bits is a division by 13. The
  // numbers are at most 51 * 260 * 256 / 1024.
  constexpr int kThirteenth = (1 << 16) / 13 + 1;
  const auto slope = hn::Set(du16, static_cast<std::uint16_t>(51 * gray_levels));
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto edge = hn::Add(hn::Abs(sobel_x(sums, x)), hn::Abs(sobel_y(sums, x)));
    const auto above = hn::SaturatedSub(hn::Set(du16, kFlat), hn::BitCast(du16, edge));
    const auto scaled = hn::MulHigh(hn::ShiftLeft<6>(above), slope);
    const auto level = hn::MulHigh(scaled, hn::Set(du16, kThirteenth));
    hn::StoreU(hn::DemoteTo(Bytes(), hn::BitCast(d16, level)), Bytes(), levels + x);
  }
}

/// value * weight / 256, rounded half up.
Vector weighted(Vector value, int weight) {
  const Words d16;
  // Processors have an instruction for (a * b + 2^14) / 2^15. Sobel values are at most 1020, so
  // both factors fit into 16 bits.
  static_assert(1020 << 4 < 1 << 15 && kCostWeights[1] << 3 < 1 << 15);
  const Vector factor = hn::Set(d16, static_cast<std::int16_t>(weight << 3));
  return hn::MulFixedPoint15(hn::ShiftLeft<4>(value), factor);
}

/// Reads nothing past the end of the row of gray values, which may be in the caller's image.
void write_costs(const std::uint8_t* here, SobelSums sums, int width, std::int16_t* gray,
                 std::int16_t* x_costs, std::int16_t* y_costs) {
  const Words d16;
  const int step = static_cast<int>(hn::Lanes(d16));
  for (int x = 0; x < width; x += step) {
    hn::StoreU(weighted(sobel_x(sums, x), kCostWeights[1]), d16, x_costs + x);
    hn::StoreU(weighted(sobel_y(sums, x), kCostWeights[2]), d16, y_costs + x);
  }
  int x = 0;
  for (; x + step <= width; x += step) {
    hn::StoreU(weighted(load_gray(here + x), kCostWeights[0]), d16, gray + x);
  }
  for (; x < width; ++x) {
    gray[x] = static_cast<std::int16_t>((here[x] * kCostWeights[0] + 128) >> 8);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(sum_columns);
HWY_EXPORT(write_levels);
HWY_EXPORT(write_costs);

namespace {

SobelSums sums_in(SobelScratch& scratch, int width) {
  scratch.resize(width);
  return {scratch.smooth.data() + 1, scratch.difference.data() + 1};
}

SobelRows rows_around(GrayView image, int y) {
  const int last = image.height - 1;
  const int above = y > 0 ? y - 1 : std::min(1, last);
  const int below = y < last ? y + 1 : std::max(last - 1, 0);
  return {image.row(above), image.row(y), image.row(below)};
}

}  // namespace

void SobelScratch::resize(int width) {
  constexpr int kVector = kAlignment / 2;
  smooth.resize(width + 2 + kVector);
  difference.resize(width + 2 + kVector);
}

void PreprocessedView::resize(int width, int height) {
  median.resize(width, height);
  level.resize(width, height);
}

void PreprocessedView::resize_costs(int width, int height) {
  gray.resize(width, height);
  sobel_x.resize(width, height);
  sobel_y.resize(width, height);
}

void level_rows(int gray_levels, int y0, int y1, SobelScratch& scratch, PreprocessedView& view) {
  const GrayView median = view.median.view();
  const SobelSums sums = sums_in(scratch, median.width);
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(sum_columns)(rows_around(median, y), median.width, sums);
    HWY_DYNAMIC_DISPATCH(write_levels)(sums, median.width, gray_levels, view.level.row(y));
  }
}

void cost_rows(GrayView image, int y0, int y1, SobelScratch& scratch, PreprocessedView& view) {
  const SobelSums sums = sums_in(scratch, image.width);
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(sum_columns)(rows_around(image, y), image.width, sums);
    HWY_DYNAMIC_DISPATCH(write_costs)
    (image.row(y), sums, image.width, view.gray.row(y), view.sobel_x.row(y), view.sobel_y.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

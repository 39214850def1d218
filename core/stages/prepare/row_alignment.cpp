// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/row_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "stages/prepare/cubic_weights.hpp"

#define HWY_TARGET_INCLUDE "stages/prepare/row_alignment.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Interpolates `count` pixels from four rows of them: the sum of their products with the weights.
/// Reads and writes nothing after the last pixel.
void interpolate(const std::uint8_t* const* in, const CubicWeights& weights, int count,
                 std::uint8_t* out) {
  const hn::CappedTag<std::int16_t, kAlignmentBlock> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  int x = 0;
  for (const int step = static_cast<int>(hn::Lanes(d16)); x + step <= count; x += step) {
    auto sum = hn::Set(d16, 32);  // in 1/64 gray values
    for (int k = 0; k < 4; ++k) {
      const auto gray = hn::ShiftLeft<6>(hn::PromoteTo(d16, hn::LoadU(d8, in[k] + x)));
      sum = hn::Add(sum, hn::MulFixedPoint15(gray, hn::Set(d16, weights[k])));
    }
    hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<6>(sum)), d8, out + x);
  }
  for (; x < count; ++x) {
    int sum = 32;
    for (int k = 0; k < 4; ++k) sum += ((in[k][x] << 6) * weights[k] + (1 << 14)) >> 15;
    out[x] = static_cast<std::uint8_t>(std::clamp(sum >> 6, 0, 255));
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(interpolate);

namespace {

constexpr std::array<CubicWeights, kPhases> kWeights = cubic_weights();
/// Pixels of border on either side of the scratch row.
constexpr int kBorder = kLargestSidewaysShift + 4;

/// A position as whole pixels and a phase.
struct Position {
  int whole;
  int phase;
};

Position position_of(double displacement) {
  const auto steps = static_cast<int>(std::floor(displacement * kPhases + 0.5));
  const int whole = static_cast<int>(std::floor(static_cast<double>(steps) / kPhases));
  return {whole, steps - whole * kPhases};
}

/// Interpolates row y along the columns.
void displace_rows(GrayView view, int y, const RowDisplacement& by, std::uint8_t* out) {
  const auto kernel = HWY_DYNAMIC_DISPATCH(interpolate);
  for (int x = 0; x < view.width; x += kAlignmentBlock) {
    const double center = x + (kAlignmentBlock - 1) / 2.0;
    const Position at = position_of(by.base + by.slope * center);
    std::array<const std::uint8_t*, 4> in{};
    for (int k = 0; k < 4; ++k) {
      in[k] = view.row(std::clamp(y + at.whole + k - 1, 0, view.height - 1)) + x;
    }
    kernel(in.data(), kWeights[at.phase], std::min(kAlignmentBlock, view.width - x), out + x);
  }
}

/// Interpolates along the row. kBorder pixels before and after it can be read.
void displace_columns(const std::uint8_t* row, int width, const RowDisplacement& by,
                      std::uint8_t* out) {
  const auto kernel = HWY_DYNAMIC_DISPATCH(interpolate);
  for (int x = 0; x < width; x += kAlignmentBlock) {
    const double center = x + (kAlignmentBlock - 1) / 2.0;
    const double limit = kLargestSidewaysShift;
    const Position at = position_of(std::clamp(by.shift + by.zoom * center, -limit, limit));
    const std::uint8_t* first = row + x + at.whole - 1;
    const std::array<const std::uint8_t*, 4> in = {first, first + 1, first + 2, first + 3};
    kernel(in.data(), kWeights[at.phase], std::min(kAlignmentBlock, width - x), out + x);
  }
}

}  // namespace

RowDisplacement displacement_of_row(const RowField& field, int y, int width, int height) {
  const double half = width / 2.0;
  const double center = (width - 1) / 2.0;
  const double v = (y - (height - 1) / 2.0) / half;
  RowDisplacement row;
  row.slope = (field.roll + field.product * v) / half;
  row.base = field.offset + field.stretch * v + field.square * v * v - row.slope * center;
  if (std::abs(field.roll) > kSmallestRoll * half) row.shift = -field.roll * v;
  if (std::abs(field.stretch) > kSmallestStretch * half) {
    row.zoom = field.stretch / half;
    row.shift -= row.zoom * center;
  }
  return row;
}

void AlignmentScratch::resize(int width) { row.resize(width + 2 * kBorder); }

void align_rows(GrayView view, const RowField& field, int y0, int y1, AlignmentScratch& scratch,
                Image<std::uint8_t>& out) {
  for (int y = y0; y < y1; ++y) {
    const RowDisplacement by = displacement_of_row(field, y, view.width, view.height);
    if (!by.moves_sideways()) {
      displace_rows(view, y, by, out.row(y));
      continue;
    }
    scratch.resize(view.width);
    std::uint8_t* row = scratch.row.data() + kBorder;
    displace_rows(view, y, by, row);
    std::fill_n(row - kBorder, kBorder, row[0]);
    std::fill_n(row + view.width, kBorder, row[view.width - 1]);
    displace_columns(row, view.width, by, out.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/enlarging.hpp"

#include <algorithm>

#include "stages/refine/enlarged_row.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/enlarging.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Ints = hn::CappedTag<std::int32_t, kAlignment / sizeof(std::int32_t)>;
using One = hn::CappedTag<std::int32_t, 1>;

/// The disparities of one pixel in each of the half pixels from `column` on: the pixel on the side
/// of the half pixel's horizontal neighbor, from `beside` on. `columns` are the pixels' columns. A
/// pixel's center is a quarter of a half pixel away from the half pixel's, in both directions.
template <class D, class Vec = hn::Vec<D>>
HWY_INLINE Vec enlarged(D di32, const EnlargedRow& row, int column, int beside, Vec columns) {
  const auto zero = hn::Zero(di32), near = hn::Set(di32, kDisparityOne);
  const auto disparity = hn::LoadU(di32, row.nearest + column);
  // The neighbors' disparities if they belong to the same surface, else the pixel's own.
  const auto continued = [&](const std::int32_t* neighbors) {
    const auto neighbor = hn::LoadU(di32, neighbors);
    const auto apart = hn::Gt(hn::Abs(hn::Sub(neighbor, disparity)), near);
    return hn::IfThenElse(hn::Or(apart, hn::Eq(neighbor, zero)), disparity, neighbor);
  };
  const auto three = hn::Add(continued(row.nearest + beside), continued(row.next + column));
  const auto nine = hn::Add(hn::ShiftLeft<3>(disparity), disparity);
  const auto sum =
      hn::Add(hn::Add(nine, continued(row.next + beside)), hn::Add(hn::ShiftLeft<1>(three), three));
  // Sixteenths of a half pixel's disparity are eighths of a pixel's.
  const auto rounded = hn::ShiftRight<3>(hn::Add(sum, hn::Set(di32, 4)));
  // What is inferred may be beyond the first column.
  const auto beyond = hn::Gt(disparity, hn::ShiftLeft<7>(columns));
  const auto limit = hn::Set(di32, row.limit);
  const auto most = hn::IfThenElse(beyond, limit, hn::Min(hn::ShiftLeft<8>(columns), limit));
  return hn::IfThenElse(hn::Eq(disparity, zero), zero, hn::Min(rounded, most));
}

/// Both pixels of each of a vector of half pixels from `column` on, none of them in the border.
template <class D>
HWY_INLINE void enlarge_inside(D di32, const EnlargedRow& row, int column, std::int32_t* out) {
  static_assert(kNoDisparity == 0);
  const auto zero = hn::Zero(di32), one = hn::Set(di32, 1);
  std::int32_t* pixels = out + 2 * column;
  if (hn::AllTrue(di32, hn::Eq(hn::LoadU(di32, row.nearest + column), zero))) {
    hn::StoreInterleaved2(zero, zero, di32, pixels);
    return;
  }
  const auto left = hn::ShiftLeft<1>(hn::Iota(di32, column));
  hn::StoreInterleaved2(enlarged(di32, row, column, column - 1, left),
                        enlarged(di32, row, column, column + 1, hn::Add(left, one)), di32, pixels);
}

/// One pixel of the border.
void enlarge_at(const EnlargedRow& row, int x, int beside, std::int32_t* out) {
  const One di32;
  hn::StoreU(enlarged(di32, row, x / 2, beside, hn::Set(di32, x)), di32, out + x);
}

void enlarge_row(const EnlargedRow& row, int half_width, int width, std::int32_t* out) {
  const Ints di32;
  const int last = half_width - 1;
  const int step = static_cast<int>(hn::Lanes(di32));
  enlarge_at(row, 0, 0, out);
  if (width > 1) enlarge_at(row, 1, std::min(1, last), out);
  if (last > step) {
    // The last vector overlaps the one before instead of extending past the end of the row.
    for (int x = 1; x < last; x += step) enlarge_inside(di32, row, std::min(x, last - step), out);
  } else {
    for (int x = 1; x < last; ++x) enlarge_inside(One(), row, x, out);
  }
  if (last == 0) return;
  enlarge_at(row, 2 * last, last - 1, out);
  if (2 * last + 1 < width) enlarge_at(row, 2 * last + 1, last, out);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(enlarge_row);

void enlarge_rows(const Image<std::int32_t>& half, int max_disparity, int y0, int y1,
                  Image<std::int32_t>& map) {
  const auto enlarge = HWY_DYNAMIC_DISPATCH(enlarge_row);
  for (int y = y0; y < y1; ++y) {
    const int next = std::clamp(y % 2 == 0 ? y / 2 - 1 : y / 2 + 1, 0, half.height() - 1);
    const EnlargedRow row = {half.row(y / 2), half.row(next), max_disparity * kDisparityOne - 1};
    enlarge(row, half.width(), map.width(), map.row(y));
  }
}

void enlarge_confidence(const Image<std::uint8_t>& half, int y0, int y1,
                        Image<std::uint8_t>& confidence) {
  const int width = confidence.width();
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* __restrict__ in = half.row(y / 2);
    std::uint8_t* __restrict__ out = confidence.row(y);
    for (int x = 0; x < width / 2; ++x) out[2 * x] = out[2 * x + 1] = in[x];
    if (width % 2 != 0) out[width - 1] = in[width / 2];
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

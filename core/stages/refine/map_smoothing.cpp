// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/map_smoothing.hpp"

#include <algorithm>

#include "mtstereo/image.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/map_smoothing.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Ints = hn::CappedTag<std::int32_t, kAlignment / sizeof(std::int32_t)>;
using Vec = hn::Vec<Ints>;

/// The means of the pixels from column x on; at least one of them has a disparity.
HWY_INLINE Vec means_at(const std::int32_t* const* lines, int radius, int x, Vec middle) {
  const Ints di32;
  const hn::Rebind<float, Ints> df32;
  const auto zero = hn::Zero(di32), near = hn::Set(di32, kDisparityOne);
  auto rises = zero;  // sum of the pairs' differences from the pixel
  auto pairs = zero;  // minus their number
  for (int distance = 1; distance <= radius; ++distance) {
    const auto one = hn::LoadU(di32, lines[radius - distance] + x);
    const auto other = hn::LoadU(di32, lines[radius + distance] + x);
    const auto rise = hn::Sub(one, middle), fall = hn::Sub(other, middle);
    const auto apart = hn::Gt(hn::Max(hn::Abs(rise), hn::Abs(fall)), near);
    const auto taken = hn::AndNot(apart, hn::Gt(hn::Min(one, other), zero));
    rises = hn::Add(rises, hn::IfThenElseZero(taken, hn::Add(rise, fall)));
    pairs = hn::Add(pairs, hn::VecFromMask(di32, taken));
  }
  // Of averaged pixels, including itself.
  const auto count = hn::Sub(hn::Set(di32, 1), hn::Add(pairs, pairs));
  // Rounds towards zero, and so towards the pixel's own disparity.
  const auto mean = hn::Div(hn::ConvertTo(df32, rises), hn::ConvertTo(df32, count));
  const auto known = hn::Gt(middle, zero);
  return hn::IfThenElseZero(known, hn::Add(middle, hn::ConvertTo(di32, mean)));
}

/// Smooths the middle row of `lines`: lines[radius - i][x] and lines[radius + i][x] are the pair at
/// distance i from its pixel x.
void smooth_row(const std::int32_t* const* lines, int radius, int width, std::int32_t* out) {
  const Ints di32;
  const auto none = hn::Zero(di32);
  static_assert(kNoDisparity == 0);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(di32))) {
    const auto middle = hn::LoadU(di32, lines[radius] + x);
    const bool empty = hn::AllTrue(di32, hn::Eq(middle, none));
    hn::StoreU(empty ? none : means_at(lines, radius, x, middle), di32, out + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(smooth_row);

void SmoothingScratch::resize(int width, int radius) {
  line.resize(width + 2 * radius);
  lines.resize(2 * radius + 1);
}

void smooth_along_rows(const Image<std::int32_t>& map, int radius, int y0, int y1,
                       SmoothingScratch& scratch, Image<std::int32_t>& smoothed) {
  const int width = map.width();
  std::int32_t* middle = scratch.line.data() + radius;
  std::fill_n(middle - radius, radius, kNoDisparity);
  std::fill_n(middle + width, radius, kNoDisparity);
  for (int i = 0; i <= 2 * radius; ++i) scratch.lines[i] = scratch.line.data() + i;
  const auto smooth = HWY_DYNAMIC_DISPATCH(smooth_row);
  for (int y = y0; y < y1; ++y) {
    std::copy_n(map.row(y), width, middle);
    smooth(scratch.lines.data(), radius, width, smoothed.row(y));
  }
}

void smooth_along_columns(const Image<std::int32_t>& smoothed, int radius, int y0, int y1,
                          SmoothingScratch& scratch, Image<std::int32_t>& map) {
  const int width = map.width();
  std::fill_n(scratch.line.data(), width, kNoDisparity);
  const auto smooth = HWY_DYNAMIC_DISPATCH(smooth_row);
  for (int y = y0; y < y1; ++y) {
    for (int i = 0; i <= 2 * radius; ++i) {
      const int row = y - radius + i;
      const bool inside = row >= 0 && row < map.height();
      scratch.lines[i] = inside ? smoothed.row(row) : scratch.line.data();
    }
    smooth(scratch.lines.data(), radius, width, map.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/gap_filling.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "mtstereo/image.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/gap_filling.cpp"
#include "base/simd.hpp"
#include "base/simd_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Bit i: pixel i of the first `count`, at most kGapColumns, has a disparity. Reads the row's
/// padding.
std::uint64_t known_bits(const std::int32_t* row, int count) {
  const hn::CappedTag<std::int32_t, kAlignment / 4> d32;
  const auto none = hn::Set(d32, kNoDisparity);
  std::uint64_t unknown = 0;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d32))) {
    unknown |= bits_of(d32, hn::Eq(hn::LoadU(d32, row + i), none)) << i;
  }
  return ~unknown & first_bits(count);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(known_bits);

namespace {

/// Calls body(i) for each set bit i.
template <typename Body>
void for_each_bit(std::uint64_t bits, Body&& body) {
  for (; bits != 0; bits &= bits - 1) body(std::countr_zero(bits));
}

/// Fills the pixels 1 .. steps - 1 after `first`, which is pixel 0; pixel `steps` is the gap's
/// other end. The strides are from pixel to pixel [elements].
void fill_gap(const GapFilling& gaps, int steps, std::ptrdiff_t map_stride, std::int32_t* first,
              std::ptrdiff_t confidence_stride, std::uint8_t* first_confidence) {
  const std::uint8_t weaker =
      std::min(*first_confidence, first_confidence[steps * confidence_stride]);
  const std::uint8_t confidence = std::clamp<std::uint8_t>(weaker / 2, 1, gaps.most_confidence);
  // Pixel k gets first + k * rise / steps plus one half, truncated. The whole part and the
  // remainder, in 1 / (2 * steps), grow by the same amounts from pixel to pixel, so that one
  // division is enough. The result lies between the ends and so is at least 1.
  const std::int32_t rise = first[steps * map_stride] - *first;
  const bool falls = rise % steps < 0;
  const std::int32_t whole = rise / steps - falls;
  const std::int32_t part = 2 * (rise % steps + falls * steps);
  std::int32_t disparity = *first;
  std::int32_t rest = steps;
  for (int k = 1; k < steps; ++k) {
    disparity += whole;
    rest += part;
    if (rest >= 2 * steps) {
      rest -= 2 * steps;
      ++disparity;
    }
    first[k * map_stride] = disparity;
    first_confidence[k * confidence_stride] = confidence;
  }
}

/// Fills the gap between two pixels that are `steps` apart, if there is one and it may be filled.
void close_gap(const GapFilling& gaps, int steps, std::ptrdiff_t map_stride, std::int32_t* first,
               std::ptrdiff_t confidence_stride, std::uint8_t* first_confidence) {
  if (steps < 2 || steps - 1 > gaps.max_gap) return;
  if (std::abs(first[steps * map_stride] - *first) > gaps.tolerance) return;
  fill_gap(gaps, steps, map_stride, first, confidence_stride, first_confidence);
}

/// Fills the gaps of a row.
void fill_row(const GapFilling& gaps, int width, std::int32_t* row, std::uint8_t* confidence) {
  const auto known_columns = HWY_DYNAMIC_DISPATCH(known_bits);
  int last = -1;  // the last known pixel of the words before
  for (int x0 = 0; x0 < width; x0 += kGapColumns) {
    const std::uint64_t known = known_columns(row + x0, std::min(kGapColumns, width - x0));
    const std::uint64_t begins = known & ~(known << 1);
    for_each_bit(begins, [&](int i) {
      const std::uint64_t below = known & ((std::uint64_t{1} << i) - 1);
      const int from = below != 0 ? x0 + std::bit_width(below) - 1 : last;
      if (from >= 0) close_gap(gaps, x0 + i - from, 1, row + from, 1, confidence + from);
    });
    if (known != 0) last = x0 + std::bit_width(known) - 1;
  }
}

/// Fills the gaps of at most kGapColumns columns.
void fill_columns(const GapFilling& gaps, int x0, int columns, Image<std::int32_t>& map,
                  Image<std::uint8_t>& confidence) {
  const auto known_columns = HWY_DYNAMIC_DISPATCH(known_bits);
  std::array<int, kGapColumns> last;  // the last known row before a gap
  std::uint64_t seen = 0;             // columns that have one
  std::uint64_t above = 0;            // the known columns of the row before
  for (int y = 0; y < map.height(); ++y) {
    const std::uint64_t known = known_columns(map.row(y) + x0, columns);
    for_each_bit(above & ~known, [&](int i) { last[i] = y - 1; });
    for_each_bit(known & ~above & seen, [&](int i) {
      close_gap(gaps, y - last[i], map.stride(), map.row(last[i]) + x0 + i, confidence.stride(),
                confidence.row(last[i]) + x0 + i);
    });
    seen |= known;
    above = known;
  }
}

}  // namespace

void fill_gaps_along_rows(const GapFilling& gaps, int y0, int y1, Image<std::int32_t>& map,
                          Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) fill_row(gaps, map.width(), map.row(y), confidence.row(y));
}

void fill_gaps_along_columns(const GapFilling& gaps, int x0, int x1, Image<std::int32_t>& map,
                             Image<std::uint8_t>& confidence) {
  for (int x = x0; x < x1; x += kGapColumns) {
    fill_columns(gaps, x, std::min(kGapColumns, x1 - x), map, confidence);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

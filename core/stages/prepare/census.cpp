// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/census.hpp"

#include <algorithm>
#include <cstring>

#include "stages/prepare/census_lines.hpp"

#define HWY_TARGET_INCLUDE "stages/prepare/census.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Bytes = hn::CappedTag<std::uint8_t, kAlignment>;
using Sums = hn::CappedTag<std::int16_t, kAlignment / 2>;

/// The weighted sum of five values, weights 1 4 6 4 1: value(i) returns the i-th one.
template <typename Value>
HWY_INLINE hn::Vec<Sums> binomial(Value&& value) {
  const auto outer = hn::Add(value(0), value(4));
  const auto middle = value(2);
  const auto inner = hn::Add(hn::Add(value(1), value(3)), middle);
  return hn::Add(hn::Add(outer, hn::ShiftLeft<2>(inner)), hn::ShiftLeft<1>(middle));
}

/// Smooths one row. `lines` are the filter's rows, `width` + 4 px wide. The sums of signed gray
/// values fit 16 bits.
void smooth_row(const std::int8_t* const* lines, int width, std::int16_t* sums,
                std::int8_t* smoothed) {
  const Sums d16;
  const hn::Rebind<std::int8_t, Sums> d8;
  const int step = static_cast<int>(hn::Lanes(d16));
  for (int x = 0; x < width + kCensusSmoothing - 1; x += step) {
    const auto sum =
        binomial([&](int i) { return hn::PromoteTo(d16, hn::LoadU(d8, lines[i] + x)); });
    hn::StoreU(sum, d16, sums + x);
  }
  const auto half = hn::Set(d16, 128);
  for (int x = 0; x < width; x += step) {
    const auto sum = binomial([&](int i) { return hn::LoadU(d16, sums + x + i); });
    hn::StoreU(hn::DemoteTo(d8, hn::ShiftRight<8>(hn::Add(sum, half))), d8, smoothed + x);
  }
}

/// One byte of the census transform of the pixels from column x on. `lines` are the rows from
/// kCensusReach above to kCensusReach below, beginning kCensusReach columns to the left.
template <const CensusNeighbors& kNeighbors>
HWY_INLINE hn::Vec<Bytes> census_byte(const std::int8_t* const* lines, int x) {
  const Bytes d8;
  const hn::RebindToSigned<Bytes> di8;
  const auto pixel = [&](int row, int column) {
    return hn::LoadU(di8, lines[kCensusReach + row] + x + kCensusReach + column);
  };
  const auto center = pixel(0, 0);
  auto byte = hn::Zero(d8);
  for (int bit = 0; bit < 8; ++bit) {
    const auto neighbor = pixel(kNeighbors.rows[bit], kNeighbors.columns[bit]);
    const auto darker = hn::BitCast(d8, hn::VecFromMask(di8, hn::Lt(neighbor, center)));
    const auto set = hn::Set(d8, static_cast<std::uint8_t>(1 << bit));
    byte = hn::Or(byte, hn::And(darker, set));
  }
  return byte;
}

void transform_row(const CensusLines& lines, int width, std::uint32_t* words) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const auto write = [&](int x, std::uint32_t* out) {
    const bool one_scale = lines.smoothed == nullptr;
    const auto byte2 =
        one_scale ? census_byte<kBetween>(lines.view, x) : census_byte<kCoarse>(lines.smoothed, x);
    // The lowest byte of a word comes first in memory: all supported processors are little-endian.
    hn::StoreInterleaved4(census_byte<kNear>(lines.view, x), census_byte<kFar>(lines.view, x),
                          byte2, hn::Zero(d8), d8, reinterpret_cast<std::uint8_t*>(out));
  };
  int x = 0;
  for (; x + step <= width; x += step) write(x, words + x);
  if (x < width) {
    std::uint32_t last[kAlignment];
    write(x, last);
    std::memcpy(words + x, last, (width - x) * sizeof(std::uint32_t));
  }
}

/// Reverses the lanes. Highway has no such function for bytes.
hn::Vec<Bytes> reverse(hn::Vec<Bytes> bytes) {
  const hn::RepartitionToWide<Bytes> d16;
  const auto pairs = hn::Reverse(d16, hn::BitCast(d16, bytes));
  return hn::BitCast(Bytes(), hn::Or(hn::ShiftLeft<8>(pairs), hn::ShiftRight<8>(pairs)));
}

void mirror_row(const std::uint32_t* words, int width, std::uint8_t* const* planes) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  int x = 0;
  for (; x + step <= width; x += step) {
    hn::Vec<Bytes> byte0, byte1, byte2, unused;
    hn::LoadInterleaved4(d8, reinterpret_cast<const std::uint8_t*>(words + x), byte0, byte1, byte2,
                         unused);
    const int to = width - step - x;
    hn::StoreU(reverse(byte0), d8, planes[0] + to);
    hn::StoreU(reverse(byte1), d8, planes[1] + to);
    hn::StoreU(reverse(byte2), d8, planes[2] + to);
  }
  for (; x < width; ++x) {
    for (int i = 0; i < kCensusBytes; ++i) {
      planes[i][width - 1 - x] = static_cast<std::uint8_t>(words[x] >> 8 * i);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(smooth_row);
HWY_EXPORT(transform_row);
HWY_EXPORT(mirror_row);

namespace {

/// Additional rows and columns of the view on each side that the smoothed view needs.
constexpr int kSmoothingReach = kCensusSmoothing / 2;
constexpr int kViewReach = kCensusReach + kSmoothingReach;
constexpr int kLines = 2 * kCensusReach + 1;

/// Copies a row as signed numbers, since few processors compare unsigned bytes, and repeats its end
/// pixels.
void pad_row(const std::uint8_t* row, int width, std::int8_t* padded) {
  std::int8_t* inside = padded + kViewReach;
  for (int x = 0; x < width; ++x) inside[x] = static_cast<std::int8_t>(row[x] - 128);
  std::fill_n(padded, kViewReach, inside[0]);
  std::fill_n(inside + width, kViewReach, inside[width - 1]);
}

}  // namespace

void CensusScratch::resize(int width, int rows) {
  view.resize(width + 2 * kViewReach, rows + 2 * kViewReach);
  smoothed.resize(width + 2 * kCensusReach, rows + 2 * kCensusReach);
  sums.resize(width + 2 * kViewReach);
}

void census_rows(GrayView image, int scales, int row_step, int y0, int y1, CensusScratch& scratch,
                 CensusImage& census) {
  static_assert(kCensusReach % 4 == 0, "smoothed rows are as far apart as those transformed");
  const int width = image.width;
  const int rows = (y1 - y0 - 1) * row_step + 1;
  if (scratch.smoothed.width() < width + 2 * kCensusReach ||
      scratch.smoothed.height() < rows + 2 * kCensusReach) {
    scratch.resize(width, rows);
  }
  for (int i = 0; i < rows + 2 * kViewReach; ++i) {
    const int y = std::clamp(y0 * row_step - kViewReach + i, 0, image.height - 1);
    pad_row(image.row(y), width, scratch.view.row(i));
  }
  for (int i = 0; i < rows + 2 * kCensusReach && scales > 1; i += row_step) {
    const std::int8_t* lines[kCensusSmoothing];
    for (int k = 0; k < kCensusSmoothing; ++k) lines[k] = scratch.view.row(i + k);
    HWY_DYNAMIC_DISPATCH(smooth_row)
    (lines, width + 2 * kCensusReach, scratch.sums.data(), scratch.smoothed.row(i));
  }
  for (int y = y0; y < y1; ++y) {
    const int first = (y - y0) * row_step;
    const std::int8_t* view[kLines];
    const std::int8_t* smoothed[kLines];
    for (int i = 0; i < kLines; ++i) {
      view[i] = scratch.view.row(first + kSmoothingReach + i) + kSmoothingReach;
      smoothed[i] = scratch.smoothed.row(first + i);
    }
    const CensusLines lines = {view, scales > 1 ? smoothed : nullptr};
    HWY_DYNAMIC_DISPATCH(transform_row)(lines, width, census.bits.row(y));
  }
}

void mirror_census_row(const std::uint32_t* bits, int width, int beyond,
                       std::uint8_t* const (&planes)[kCensusBytes]) {
  HWY_DYNAMIC_DISPATCH(mirror_row)(bits, width, planes);
  for (std::uint8_t* plane : planes) std::memset(plane + width, plane[width - 1], beyond);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

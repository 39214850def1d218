// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/census.hpp"

#include <algorithm>
#include <cstring>

#define HWY_TARGET_INCLUDE "stages/prepare/census.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Side of the window [px].
constexpr int kSide = 5;

/// Index of a bit's pixel in the window, row by row. The bits skip the center.
constexpr int neighbor_of(int bit) { return bit < kCensusBits / 2 ? bit : bit + 1; }

using Bytes = hn::CappedTag<std::uint8_t, kAlignment>;

/// Byte kByte of the census transform of the pixels from column x on. `lines` are the window's
/// rows, padded, with gray values as signed numbers, since few processors compare unsigned bytes.
template <int kByte>
hn::Vec<Bytes> census_byte(const std::uint8_t* const* lines, int x) {
  const Bytes d8;
  const hn::RebindToSigned<Bytes> di8;
  const auto center = hn::BitCast(di8, hn::LoadU(d8, lines[kSide / 2] + x + kSide / 2));
  auto byte = hn::Zero(d8);
  for (int bit = 0; bit < 8; ++bit) {
    const int neighbor = neighbor_of(8 * kByte + bit);
    const auto value =
        hn::BitCast(di8, hn::LoadU(d8, lines[neighbor / kSide] + x + neighbor % kSide));
    const auto darker = hn::BitCast(d8, hn::VecFromMask(di8, hn::Lt(value, center)));
    byte = hn::Or(byte, hn::And(darker, hn::Set(d8, static_cast<std::uint8_t>(1 << bit))));
  }
  return byte;
}

void transform_row(const std::uint8_t* const* lines, int width, std::uint32_t* words) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const auto write = [&](int x, std::uint32_t* out) {
    // The lowest byte of a word comes first in memory: all supported processors are little-endian.
    hn::StoreInterleaved4(census_byte<0>(lines, x), census_byte<1>(lines, x),
                          census_byte<2>(lines, x), hn::Zero(d8), d8,
                          reinterpret_cast<std::uint8_t*>(out));
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

void split_row(const std::uint32_t* words, int width, RowOrder order, std::uint8_t* const* planes) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const bool mirrored = order == RowOrder::kMirrored;
  int x = 0;
  for (; x + step <= width; x += step) {
    hn::Vec<Bytes> byte0, byte1, byte2, none;
    hn::LoadInterleaved4(d8, reinterpret_cast<const std::uint8_t*>(words + x), byte0, byte1, byte2,
                         none);
    const int to = mirrored ? width - step - x : x;
    hn::StoreU(mirrored ? reverse(byte0) : byte0, d8, planes[0] + to);
    hn::StoreU(mirrored ? reverse(byte1) : byte1, d8, planes[1] + to);
    hn::StoreU(mirrored ? reverse(byte2) : byte2, d8, planes[2] + to);
  }
  for (; x < width; ++x) {
    for (int i = 0; i < kCensusBytes; ++i) {
      planes[i][mirrored ? width - 1 - x : x] = static_cast<std::uint8_t>(words[x] >> 8 * i);
    }
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(transform_row);
HWY_EXPORT(split_row);

namespace {

constexpr int kRadius = 2;

/// Copies a row, repeats its end pixels, and shifts the gray values to -128 .. 127.
void pad_row(const std::uint8_t* row, int width, std::uint8_t* padded) {
  std::uint8_t* inside = padded + kRadius;
  for (int x = 0; x < width; ++x) inside[x] = row[x] ^ 0x80;
  for (int i = 1; i <= kRadius; ++i) {
    inside[-i] = inside[0];
    inside[width - 1 + i] = inside[width - 1];
  }
}

}  // namespace

void CensusScratch::resize(int width, int rows) {
  padded.resize(width + 2 * kRadius, rows + 2 * kRadius);
}

void census_rows(GrayView image, int y0, int y1, CensusScratch& scratch, CensusImage& census) {
  const int width = image.width;
  const int rows = y1 - y0 + 2 * kRadius;
  if (scratch.padded.width() < width + 2 * kRadius || scratch.padded.height() < rows) {
    scratch.resize(width, y1 - y0);
  }
  for (int i = 0; i < rows; ++i) {
    const int y = std::clamp(y0 - kRadius + i, 0, image.height - 1);
    pad_row(image.row(y), width, scratch.padded.row(i));
  }
  const auto transform = HWY_DYNAMIC_DISPATCH(transform_row);
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* lines[2 * kRadius + 1];
    for (int i = 0; i <= 2 * kRadius; ++i) lines[i] = scratch.padded.row(y - y0 + i);
    transform(lines, width, census.bits.row(y));
  }
}

void split_census_row(const std::uint32_t* bits, int width, RowOrder order, int beyond,
                      std::uint8_t* const (&planes)[kCensusBytes]) {
  HWY_DYNAMIC_DISPATCH(split_row)(bits, width, order, planes);
  for (std::uint8_t* plane : planes) std::memset(plane + width, plane[width - 1], beyond);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

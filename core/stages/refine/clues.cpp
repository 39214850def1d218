// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/clues.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "mtstereo/parameters.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/clues.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Adds up the bytes x .. x + count - 1 of each column x; the sums fit into bytes.
void add_columns(const std::uint8_t* row, int count, int width, std::uint8_t* sum) {
  const hn::CappedTag<std::uint8_t, kAlignment> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d8))) {
    auto total = hn::LoadU(d8, row + x);
    for (int i = 1; i < count; ++i) total = hn::Add(total, hn::LoadU(d8, row + x + i));
    hn::StoreU(total, d8, sum + x);
  }
}

// The loops from here on are vectorized by compilers, for the target.

void copy_row(const std::int32_t* __restrict__ map, int width, std::int16_t* __restrict__ out) {
  for (int x = 0; x < width; ++x) {
    out[x] = static_cast<std::int16_t>(map[x] / (kDisparityOne / kClueOne));
  }
}

/// Marks the matched pixels.
void mark_matched(const std::uint8_t* __restrict__ confidence, int width,
                  std::uint8_t* __restrict__ marks) {
  for (int x = 0; x < width; ++x) marks[x] = confidence[x] > kMostInferred;
}

/// The changes from pixel to pixel, except for the first one.
void find_row_changes(const std::uint8_t* __restrict__ row, int width,
                      std::uint8_t* __restrict__ changes) {
  for (int x = 1; x < width; ++x) {
    const int change = std::max(row[x], row[x - 1]) - std::min(row[x], row[x - 1]);
    changes[x] = std::min<std::uint8_t>(static_cast<std::uint8_t>(change), kMostChange);
  }
}

/// The place of the pixel left of each pixel's partner, in a row whose border is 2 pixels wide.
void find_partners(const std::int32_t* __restrict__ map, int width, int right_width,
                   std::uint32_t* __restrict__ places) {
  for (int x = 0; x < width; ++x) {
    const int partner = (x * kDisparityOne - map[x] + kDisparityOne / 2) >> 8;
    const int least = partner < -1 ? -1 : partner;
    places[x] = static_cast<std::uint32_t>((least > right_width ? right_width : least) + 1);
  }
}

/// The least difference from the first three of the four gray values in each of `partners`.
void find_least(const std::uint8_t* __restrict__ left, const std::uint32_t* __restrict__ partners,
                int width, std::uint8_t* __restrict__ mismatch) {
  constexpr int kFirst = std::endian::native == std::endian::big ? 8 : 0;
  for (int x = 0; x < width; ++x) {
    int least = kMostMismatch;
    for (int i = 0; i < 3; ++i) {
      const int other = static_cast<int>(partners[x] >> (kFirst + 8 * i) & 255);
      const int difference = left[x] > other ? left[x] - other : other - left[x];
      least = difference < least ? difference : least;
    }
    mismatch[x] = static_cast<std::uint8_t>(least);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(add_columns);
HWY_EXPORT(copy_row);
HWY_EXPORT(mark_matched);
HWY_EXPORT(find_row_changes);
HWY_EXPORT(find_partners);
HWY_EXPORT(find_least);

namespace {

constexpr int kShareSide = 2 * kShareReach + 1;
constexpr int kVector = static_cast<int>(kAlignment);

void copy_disparities(const std::int32_t* map, int width, std::int16_t* out) {
  HWY_DYNAMIC_DISPATCH(copy_row)(map, width, out + kClueBorder);
  std::fill_n(out, kClueBorder, out[kClueBorder]);
  std::fill_n(out + kClueBorder + width, kClueBorder, out[kClueBorder + width - 1]);
}

static_assert(1 << 8 == kDisparityOne);

void find_mismatch(const RatedViews& views, const std::int32_t* map, int y, int width,
                   ClueScratch& scratch) {
  const int right_width = views.right.width;
  std::uint8_t* right = scratch.right.data();
  map_row(views.right.row(y), right_width, views.balance->mapping, right + 2);
  std::memset(right, right[2], 2);
  std::memset(right + 2 + right_width, right[1 + right_width], 3);
  std::uint32_t* partner = scratch.partner.data();
  HWY_DYNAMIC_DISPATCH(find_partners)(map, width, right_width, partner);
  for (int x = 0; x < width; ++x) std::memcpy(partner + x, right + partner[x], sizeof *partner);
  std::uint8_t* mismatch = scratch.values.data();
  std::uint8_t* left = scratch.left.data();
  balance_row(views.left, y, *views.balance, 2 * views.agreement_tile, left);
  HWY_DYNAMIC_DISPATCH(find_least)(left, partner, width, mismatch + 1);
  mismatch[0] = mismatch[1];
  mismatch[width + 1] = mismatch[width];
}

/// The changes from pixel to pixel; those outside of the row are 0.
void find_changes(const std::uint8_t* row, int width, std::uint8_t* changes) {
  constexpr int kBorder = kTextureSide / 2;
  std::memset(changes, 0, kBorder + 1);
  HWY_DYNAMIC_DISPATCH(find_row_changes)(row, width, changes + kBorder);
  std::memset(changes + kBorder + width, 0, kTextureSide - kBorder);
}

}  // namespace

void ClueMaps::resize(int width, int height, ReusedMemory* reused) {
  disparity.resize(width + 2 * kClueBorder, height, reused);
  matched.resize(width, height, reused);
  mismatch.resize(width, height, reused);
  texture.resize(width, height, reused);
}

void ClueScratch::resize(int width) {
  marks.resize(width + 2 * kShareReach + kVector);
  values.resize(width + kTextureSide + kVector);
  left.resize(width);
  right.resize(width + 5);  // two pixels before, three after
  partner.resize(width);
}

void gather_clues(const RatedViews& views, const Image<std::int32_t>& map,
                  const Image<std::uint8_t>& confidence, int y0, int y1, ClueScratch& scratch,
                  ClueMaps& clues) {
  const int width = map.width();
  std::uint8_t* marks = scratch.marks.data();
  std::memset(marks, 0, width + 2 * kShareReach);
  for (int y = y0; y < y1; ++y) {
    copy_disparities(map.row(y), width, clues.disparity.row(y));
    HWY_DYNAMIC_DISPATCH(mark_matched)(confidence.row(y), width, marks + kShareReach);
    HWY_DYNAMIC_DISPATCH(add_columns)(marks, kShareSide, width, clues.matched.row(y));
    find_mismatch(views, map.row(y), y, width, scratch);
    HWY_DYNAMIC_DISPATCH(add_columns)(scratch.values.data(), 3, width, clues.mismatch.row(y));
    find_changes(views.left.row(y), width, scratch.values.data());
    HWY_DYNAMIC_DISPATCH(add_columns)
    (scratch.values.data(), kTextureSide, width, clues.texture.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

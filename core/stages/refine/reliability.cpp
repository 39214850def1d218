// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/reliability.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "stages/refine/reliability_rows.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/reliability.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Words = hn::CappedTag<std::int16_t, kAlignment / sizeof(std::int16_t)>;
using Bytes = hn::Rebind<std::uint8_t, Words>;

/// The bins of the two clues about other surfaces: the shortest distance, or kNoSurface.
void find_surfaces(const SurfaceRows& rows, int width, std::uint8_t* nearer,
                   std::uint8_t* farther) {
  const Words d16;
  const Bytes d8;
  const auto step = hn::Set(d16, kOtherSurface);
  const auto none = hn::Set(d16, kNoSurface);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const std::int16_t* at = rows.middle + x;
    const auto own = hn::LoadU(d16, at);
    const auto near = hn::Add(own, step), far = hn::Sub(own, step);
    auto distance = none;
    for (std::size_t i = kNearerDistances.size(); i-- > 0;) {
      const int k = kNearerDistances[i];
      const auto is_nearer = hn::Gt(hn::LoadU(d16, at - k), near);
      distance = hn::IfThenElse(is_nearer, hn::Set(d16, static_cast<std::int16_t>(k)), distance);
    }
    hn::StoreU(hn::DemoteTo(d8, distance), d8, nearer + x);
    distance = none;
    for (std::size_t i = kFartherDistances.size(); i-- > 0;) {
      const int k = kFartherDistances[i];
      const auto row = hn::Min(hn::LoadU(d16, at - k), hn::LoadU(d16, at + k));
      const auto column =
          hn::Min(hn::LoadU(d16, rows.above[i] + x), hn::LoadU(d16, rows.below[i] + x));
      const auto is_farther = hn::Lt(hn::Min(row, column), far);
      distance = hn::IfThenElse(is_farther, hn::Set(d16, static_cast<std::int16_t>(k)), distance);
    }
    hn::StoreU(hn::DemoteTo(d8, distance), d8, farther + x);
  }
}

/// Adds up `count` rows.
void add_rows(const std::uint8_t* const* rows, int count, int width, std::uint16_t* sum) {
  const hn::RebindToUnsigned<Words> du16;
  const Bytes d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(du16))) {
    auto total = hn::Zero(du16);
    for (int i = 0; i < count; ++i) {
      total = hn::Add(total, hn::PromoteTo(du16, hn::LoadU(d8, rows[i] + x)));
    }
    hn::StoreU(total, du16, sum + x);
  }
}

/// Adds up the bytes x .. x + count - 1 of each column x; the sums fit into bytes.
void add_columns(const std::uint8_t* row, int count, int width, std::uint8_t* sum) {
  const hn::CappedTag<std::uint8_t, kAlignment> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d8))) {
    auto total = hn::LoadU(d8, row + x);
    for (int i = 1; i < count; ++i) total = hn::Add(total, hn::LoadU(d8, row + x + i));
    hn::StoreU(total, d8, sum + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(find_surfaces);
HWY_EXPORT(add_rows);
HWY_EXPORT(add_columns);

namespace {

constexpr int kShareSide = 2 * kShareReach + 1;
constexpr int kVector = static_cast<int>(kAlignment);

/// The ends of the bins of clues whose values are not bins themselves: the bin of a value is the
/// number of ends up to it.
constexpr int kMismatchEnds[] = {3, 5, 7, 9, 14, 18, 23, 27, 36, 45, 54, 72, 90, 126, 180, 270};
constexpr int kTextureEnds[] = {1, 3, 8, 14, 20, 27, 40, 54, 75, 100, 135, 175, 230, 300, 400, 500};
constexpr int kPartnerEnds[] = {-40, -20, -10, -5, 0, 3, 6, 10, 16, 24};
constexpr float kNoiseEnds[] = {.1F, .3F, .6F, 1, 1.5F, 2, 2.5F, 3, 4, 5, 7, 10};

template <typename Value, std::size_t kEnds>
constexpr std::uint8_t bin_of(Value value, const Value (&ends)[kEnds]) {
  std::uint8_t bin = 0;
  for (const Value end : ends) bin += value >= end;
  return bin;
}

/// The bins of the values first, first + 1 ... first + kCount - 1.
template <std::size_t kCount, std::size_t kEnds>
constexpr std::array<std::uint8_t, kCount> bins_from(int first, const int (&ends)[kEnds]) {
  std::array<std::uint8_t, kCount> bins{};
  for (std::size_t i = 0; i < kCount; ++i) bins[i] = bin_of(first + static_cast<int>(i), ends);
  return bins;
}

constexpr auto kMismatchBins = bins_from<9 * kMostMismatch + 1>(0, kMismatchEnds);
constexpr auto kTextureBins = bins_from<3 * kTextureSide * kMostChange + 1>(0, kTextureEnds);

/// The bins of the partner's columns, from kPartnerEnds[0] - 1 on.
constexpr int kFirstPartner = kPartnerEnds[0] - 1;
constexpr int kLastPartner = 24;
constexpr auto kPartnerBins =
    bins_from<kLastPartner - kFirstPartner + 1>(kFirstPartner, kPartnerEnds);

void copy_disparities(const std::int32_t* map, int width, std::int16_t* out) {
  for (int x = 0; x < width; ++x) {
    out[kClueBorder + x] = static_cast<std::int16_t>(map[x] / (kDisparityOne / kClueOne));
  }
  std::fill_n(out, kClueBorder, out[kClueBorder]);
  std::fill_n(out + kClueBorder + width, kClueBorder, out[kClueBorder + width - 1]);
}

/// The column of the right view that shows the pixel [1 / kDisparityOne px].
int partner_of(int x, std::int32_t disparity, int offset) {
  return (x - offset) * kDisparityOne - disparity;
}

constexpr int kDisparityShift = 8;
static_assert(1 << kDisparityShift == kDisparityOne);

void find_mismatch(const RatedViews& views, const std::int32_t* map, int y, int width,
                   std::uint8_t* mismatch) {
  const std::uint8_t* left = views.left.row(y);
  const std::uint8_t* right = views.right.row(y);
  const int last = views.right.width - 1;
  const int offset = views.disparity_offset;
  for (int x = 0; x < width; ++x) {
    const int gray = left[x];
    const int partner = (partner_of(x, map[x], offset) + kDisparityOne / 2) >> kDisparityShift;
    int least = kMostMismatch;
    for (int i = -1; i <= 1; ++i) {
      least = std::min(least, std::abs(gray - right[std::clamp(partner + i, 0, last)]));
    }
    mismatch[x + 1] = static_cast<std::uint8_t>(least);
  }
  mismatch[0] = mismatch[1];
  mismatch[width + 1] = mismatch[width];
}

/// The changes from pixel to pixel; those outside of the row are 0.
void find_changes(const std::uint8_t* row, int width, std::uint8_t* changes) {
  constexpr int kBorder = kTextureSide / 2;
  std::memset(changes, 0, width + kTextureSide);
  for (int x = 1; x < width; ++x) {
    changes[kBorder + x] =
        static_cast<std::uint8_t>(std::min(std::abs(row[x] - row[x - 1]), kMostChange));
  }
}

/// The number of the rows or columns of a window of kShareSide that are inside of the image.
int inside(int middle, int size) {
  return std::min(middle + kShareReach, size - 1) - std::max(middle - kShareReach, 0) + 1;
}

/// The share of matched pixels in 16ths.
void find_share_bins(const ClueMaps& clues, int y, int width, ReliabilityScratch& scratch) {
  const int height = clues.matched.height();
  const int first = std::max(y - kShareReach, 0);
  const int rows = inside(y, height);
  const std::uint8_t* lines[kShareSide];
  for (int i = 0; i < rows; ++i) lines[i] = clues.matched.row(first + i);
  HWY_DYNAMIC_DISPATCH(add_rows)(lines, rows, width, scratch.sum.data());
  // Entry i: 16 / (rows * (i + 1)) as a fraction of 2^16, rounded up.
  std::array<std::uint32_t, kShareSide> shares{};
  for (int i = 0; i < kShareSide; ++i) {
    const std::uint32_t pixels = static_cast<std::uint32_t>(rows * (i + 1));
    shares[i] = ((16U << 16) + pixels - 1) / pixels;
  }
  std::uint8_t* bins = scratch.bins[kShareClue].data();
  for (int x = 0; x < width; ++x) {
    bins[x] = static_cast<std::uint8_t>(scratch.sum[x] * shares[inside(x, width) - 1] >> 16);
  }
}

/// The bins of the sums of three rows, `step` rows apart.
template <std::size_t kCount>
void find_sum_bins(const Image<std::uint8_t>& rows, int step, int y,
                   const std::array<std::uint8_t, kCount>& bin_of_sum, int width,
                   Buffer<std::uint16_t>& sum, Buffer<std::uint8_t>& bins) {
  const std::uint8_t* lines[] = {rows.row(std::max(y - step, 0)), rows.row(y),
                                 rows.row(std::min(y + step, rows.height() - 1))};
  HWY_DYNAMIC_DISPATCH(add_rows)(lines, 3, width, sum.data());
  for (int x = 0; x < width; ++x) bins[x] = bin_of_sum[sum[x]];
}

void find_surface_bins(const ClueMaps& clues, int y, int width, ReliabilityScratch& scratch) {
  const int last = clues.disparity.height() - 1;
  SurfaceRows rows{};
  rows.middle = clues.disparity.row(y) + kClueBorder;
  for (std::size_t i = 0; i < kFartherDistances.size(); ++i) {
    rows.above[i] = clues.disparity.row(std::max(y - kFartherDistances[i], 0)) + kClueBorder;
    rows.below[i] = clues.disparity.row(std::min(y + kFartherDistances[i], last)) + kClueBorder;
  }
  HWY_DYNAMIC_DISPATCH(find_surfaces)
  (rows, width, scratch.bins[kNearerClue].data(), scratch.bins[kFartherClue].data());
}

/// Keeps the confidence of inferred and matched disparities apart.
int apart(int before, int rated) {
  if (before > kMostInferred) return std::max(rated, kMostInferred + 1);
  return 1 + (rated - 1) * (kMostInferred - 1) / 254;
}

}  // namespace

void ClueMaps::resize(int width, int height) {
  disparity.resize(width + 2 * kClueBorder, height);
  matched.resize(width, height);
  mismatch.resize(width, height);
  texture.resize(width, height);
}

void ReliabilityScratch::resize(int width) {
  marks.resize(width + 2 * kShareReach + kVector);
  values.resize(width + kTextureSide + kVector);
  sum.resize(width + kVector);
  for (Buffer<std::uint8_t>& row : bins) row.resize(width + kVector);
}

void gather_clues(const RatedViews& views, const Image<std::int32_t>& map,
                  const Image<std::uint8_t>& confidence, int y0, int y1,
                  ReliabilityScratch& scratch, ClueMaps& clues) {
  const int width = map.width();
  std::uint8_t* marks = scratch.marks.data();
  std::memset(marks, 0, width + 2 * kShareReach);
  for (int y = y0; y < y1; ++y) {
    copy_disparities(map.row(y), width, clues.disparity.row(y));
    const std::uint8_t* row = confidence.row(y);
    for (int x = 0; x < width; ++x) marks[kShareReach + x] = row[x] > kMostInferred;
    HWY_DYNAMIC_DISPATCH(add_columns)(marks, kShareSide, width, clues.matched.row(y));
    find_mismatch(views, map.row(y), y, width, scratch.values.data());
    HWY_DYNAMIC_DISPATCH(add_columns)(scratch.values.data(), 3, width, clues.mismatch.row(y));
    find_changes(views.left.row(y), width, scratch.values.data());
    HWY_DYNAMIC_DISPATCH(add_columns)
    (scratch.values.data(), kTextureSide, width, clues.texture.row(y));
  }
}

void find_clue_bins(const RatedViews& views, const Image<std::int32_t>& map,
                    const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                    ReliabilityScratch& scratch) {
  const int width = map.width();
  find_share_bins(clues, y, width, scratch);
  find_sum_bins(clues.mismatch, 1, y, kMismatchBins, width, scratch.sum,
                scratch.bins[kMismatchClue]);
  find_sum_bins(clues.texture, kTextureStep, y, kTextureBins, width, scratch.sum,
                scratch.bins[kTextureClue]);
  find_surface_bins(clues, y, width, scratch);
  const std::int32_t* row = map.row(y);
  const std::uint8_t* row_confidence = confidence.row(y);
  std::uint8_t* support = scratch.bins[kSupportClue].data();
  std::uint8_t* column = scratch.bins[kPartnerClue].data();
  for (int x = 0; x < width; ++x) support[x] = row_confidence[x] / 8;
  for (int x = 0; x < width; ++x) {
    const int partner = partner_of(x, row[x], views.disparity_offset) >> kDisparityShift;
    const int limited = std::clamp(partner, kFirstPartner, kLastPartner);
    column[x] = kPartnerBins[limited - kFirstPartner];
  }
  std::memset(scratch.bins[kNoiseClue].data(), bin_of(views.noise_level, kNoiseEnds), width);
}

void rate_reliability(const RatedViews& views, const Image<std::int32_t>& map,
                      const ClueMaps& clues, Inferred inferred, int y0, int y1,
                      ReliabilityScratch& scratch, Image<std::uint8_t>& confidence) {
  // Locals, so that the compiler need not load them again after each pixel.
  const std::uint8_t* bins[kClues];
  for (int clue = 0; clue < kClues; ++clue) bins[clue] = scratch.bins[clue].data();
  const int noise = kReliabilityTable[kNoiseClue][bin_of(views.noise_level, kNoiseEnds)];
  static_assert(kNoiseClue == kClues - 1);
  const int width = map.width();
  for (int y = y0; y < y1; ++y) {
    find_clue_bins(views, map, confidence, clues, y, scratch);
    std::uint8_t* row = confidence.row(y);
    for (int x = 0; x < width; ++x) {
      int sum = noise;
      for (int clue = 0; clue < kNoiseClue; ++clue) sum += kReliabilityTable[clue][bins[clue][x]];
      const int rated = std::clamp(sum / kReliabilityOne, 1, 255);
      row[x] =
          static_cast<std::uint8_t>(inferred == Inferred::kApart ? apart(row[x], rated) : rated);
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

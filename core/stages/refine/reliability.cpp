// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/reliability.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "stages/refine/block_grid.hpp"
#include "stages/refine/guide_clue.hpp"
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

/// The bins of the clue about the columns that show the pixels.
void find_partner_bins(const std::int32_t* __restrict__ map, int width,
                       std::uint8_t* __restrict__ bins) {
  constexpr int kLeast = kPartnerEnds[0] - 1, kMost = 24;
  for (int x = 0; x < width; ++x) {
    const int partner = (x * kDisparityOne - map[x]) >> 8;
    const int limited = partner < kLeast ? kLeast : partner;
    bins[x] = static_cast<std::uint8_t>(limited > kMost ? kMost : limited);
  }
  // Bytes, which take a quarter of the vectors.
  for (int x = 0; x < width; ++x) {
    const auto partner = static_cast<std::int8_t>(bins[x]);
    std::uint8_t bin = 0;
    for (const int end : kPartnerEnds) bin += partner >= end;
    bins[x] = bin;
  }
}

using Sixteen = hn::FixedTag<std::uint8_t, 16>;
using Eight = hn::FixedTag<std::int16_t, 8>;

/// One of 32 bytes for each of the bins.
HWY_INLINE hn::Vec<Sixteen> look_up(const std::uint8_t* bytes, hn::Vec<Sixteen> bins) {
  const Sixteen d8;
  const auto most = hn::Set(d8, 15);
  const auto place = hn::And(bins, most);
  return hn::IfThenElse(hn::Gt(bins, most), hn::TableLookupBytes(hn::Load(d8, bytes + 16), place),
                        hn::TableLookupBytes(hn::Load(d8, bytes), place));
}

/// The confidence by the sum of the entries.
HWY_INLINE hn::Vec<Eight> rated(hn::Vec<Eight> sum, hn::Vec<Eight> before, bool apart) {
  const Eight d16;
  static_assert(kReliabilityOne == 1 << 4);
  const auto one = hn::Set(d16, 1), most = hn::Set(d16, kMostInferred);
  const auto rating = hn::Min(hn::Max(hn::ShiftRight<4>(sum), one), hn::Set(d16, 255));
  if (!apart) return rating;
  // A division by 254, exact for these values.
  const auto product = hn::Mul(hn::Sub(rating, one), hn::Set(d16, kMostInferred - 1));
  const auto low = hn::ShiftRight<4>(hn::MulHigh(product, hn::Set(d16, 4129)));
  return hn::IfThenElse(hn::Gt(before, most), hn::Max(rating, hn::Add(most, one)),
                        hn::Add(low, one));
}

/// Replaces the confidence of a row.
void rate_row(const RatedBins& row, int width, std::uint8_t* confidence) {
  const Sixteen d8;
  const hn::Half<Sixteen> half;
  const Eight d16;
  for (int x = 0; x < width; x += 16) {
    auto lower = hn::Set(d16, static_cast<std::int16_t>(row.same)), upper = lower;
    for (int clue = 0; clue < kPixelClues; ++clue) {
      const auto bins = hn::LoadU(d8, row.bins[clue] + x);
      const auto first = look_up(row.entries[clue].of[0], bins);
      const auto second = look_up(row.entries[clue].of[1], bins);
      lower = hn::Add(lower, hn::BitCast(d16, hn::InterleaveLower(d8, first, second)));
      upper = hn::Add(upper, hn::BitCast(d16, hn::InterleaveUpper(d8, first, second)));
    }
    std::uint8_t* out = confidence + x;
    const auto before = hn::PromoteTo(d16, hn::LoadU(half, out));
    hn::StoreU(hn::DemoteTo(half, rated(lower, before, row.apart)), half, out);
    const auto next = hn::PromoteTo(d16, hn::LoadU(half, out + 8));
    hn::StoreU(hn::DemoteTo(half, rated(upper, next, row.apart)), half, out + 8);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(find_surfaces);
HWY_EXPORT(add_rows);
HWY_EXPORT(find_partner_bins);
HWY_EXPORT(rate_row);

namespace {

constexpr int kShareSide = 2 * kShareReach + 1;
constexpr int kVector = static_cast<int>(kAlignment);

/// The ends of the bins of clues whose values are not bins themselves: the bin of a value is the
/// number of ends up to it.
constexpr int kMismatchEnds[] = {3, 5, 7, 9, 14, 18, 23, 27, 36, 45, 54, 72, 90, 126, 180, 270};
constexpr int kTextureEnds[] = {1, 3, 8, 14, 20, 27, 40, 54, 75, 100, 135, 175, 230, 300, 400, 500};
constexpr float kNoiseEnds[] = {.1F, .3F, .6F, 1, 1.5F, 2, 2.5F, 3, 4, 5, 7, 10};
constexpr float kDetailEnds[] = {.024F, .03F, .037F, .045F, .06F, .1F, .2F};

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

/// The number of the rows or columns of a window of kShareSide that are inside of the image.
int inside(int middle, int size) {
  return std::min(middle + kShareReach, size - 1) - std::max(middle - kShareReach, 0) + 1;
}

/// The products with the fraction `share` of 2^16.
void share_out(const std::uint16_t* __restrict__ sum, std::uint32_t share, int count,
               std::uint8_t* __restrict__ bins) {
  for (int i = 0; i < count; ++i) bins[i] = static_cast<std::uint8_t>(sum[i] * share >> 16);
}

/// The share of matched pixels in 16ths.
void find_share_bins(const ClueMaps& clues, int y, int width, ReliabilityScratch& scratch) {
  const int height = clues.matched.height();
  const int first = std::max(y - kShareReach, 0);
  const int rows = inside(y, height);
  const std::uint8_t* lines[kShareSide];
  for (int i = 0; i < rows; ++i) lines[i] = clues.matched.row(first + i);
  HWY_DYNAMIC_DISPATCH(add_rows)(lines, rows, width, scratch.sum.data());
  const std::uint16_t* sum = scratch.sum.data();
  std::uint8_t* bins = scratch.bins[kShareClue].data();
  // All windows of the columns first .. end - 1 have as many columns.
  const auto divide = [&](int begin, int end) {
    // 16 / pixels as a fraction of 2^16, rounded up.
    const std::uint32_t pixels = static_cast<std::uint32_t>(rows * inside(begin, width));
    const std::uint32_t share = ((16U << 16) + pixels - 1) / pixels;
    share_out(sum + begin, share, end - begin, bins + begin);
  };
  const int left = std::min(kShareReach, width);
  const int right = std::max(left, width - kShareReach);
  for (int x = 0; x < left; ++x) divide(x, x + 1);
  if (left < right) divide(left, right);
  for (int x = right; x < width; ++x) divide(x, x + 1);
}

/// The bins of the sums of three rows, `step` rows apart.
template <std::size_t kCount>
void find_sum_bins(const Image<std::uint8_t>& rows, int step, int y,
                   const std::array<std::uint8_t, kCount>& bin_of_sum, int width,
                   std::uint16_t* __restrict__ sum, std::uint8_t* __restrict__ bins) {
  const std::uint8_t* lines[] = {rows.row(std::max(y - step, 0)), rows.row(y),
                                 rows.row(std::min(y + step, rows.height() - 1))};
  HWY_DYNAMIC_DISPATCH(add_rows)(lines, 3, width, sum);
  int x = 0;
  // Eight at once, because the speed of a loop that short depends on its place in memory.
  for (; x + 8 <= width; x += 8) {
    for (int i = x; i < x + 8; ++i) bins[i] = bin_of_sum[sum[i]];
  }
  for (; x < width; ++x) bins[x] = bin_of_sum[sum[x]];
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

/// The bins of the clue about the agreement: a pixel of the image is a tile of the views.
void find_agreement_bins(const RatedViews& views, int y, int width, std::uint8_t* bins) {
  const Image<std::uint8_t>& shares = *views.agreement;
  const int tile = views.agreement_tile;
  const std::uint8_t* row = shares.row(std::min(y / tile, shares.height() - 1));
  for (int x = 0; x < width;) {
    const int column = std::min(x / tile, shares.width() - 1);
    // The last tile reaches to the end of the row.
    const bool last = column == shares.width() - 1;
    const int end = last ? width : std::min((column + 1) * tile, width);
    std::memset(bins + x, row[column], end - x);
    x = end;
  }
}

/// The columns of the table for rate_row().
std::array<EntryBytes, kPixelClues> entry_bytes(const ReliabilityTable& table) {
  std::array<EntryBytes, kPixelClues> columns;
  for (int clue = 0; clue < kPixelClues; ++clue) {
    for (int bin = 0; bin < kClueBins; ++bin) {
      std::uint8_t bytes[2];
      std::memcpy(bytes, &table[clue][bin], 2);
      for (int i = 0; i < 2; ++i) columns[clue].of[i][bin] = bytes[i];
    }
  }
  return columns;
}

}  // namespace

void ReliabilityScratch::resize(int width) {
  sum.resize(width + kVector);
  expected.resize(width);
  for (Buffer<std::uint8_t>& row : bins) row.resize(width + kVector);
}

void find_clue_bins(const RatedViews& views, const Image<std::int32_t>& map,
                    const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                    ReliabilityScratch& scratch) {
  const int width = map.width();
  find_share_bins(clues, y, width, scratch);
  find_sum_bins(clues.mismatch, 1, y, kMismatchBins, width, scratch.sum.data(),
                scratch.bins[kMismatchClue].data());
  find_sum_bins(clues.texture, kTextureStep, y, kTextureBins, width, scratch.sum.data(),
                scratch.bins[kTextureClue].data());
  find_surface_bins(clues, y, width, scratch);
  const std::uint8_t* row_confidence = confidence.row(y);
  std::uint8_t* support = scratch.bins[kSupportClue].data();
  for (int x = 0; x < width; ++x) support[x] = row_confidence[x] / 8;
  HWY_DYNAMIC_DISPATCH(find_partner_bins)
  (map.row(y), width, scratch.bins[kPartnerClue].data());
  find_agreement_bins(views, y, width, scratch.bins[kAgreementClue].data());
  find_guide_bins(views.guide, map, y, scratch.expected.data(), scratch.bins[kGuideClue].data());
  find_grid_bins(views.grid_level, views.block_side, map.row(y), width,
                 scratch.bins[kGridClue].data());
  std::memset(scratch.bins[kNoiseClue].data(), bin_of(views.noise_level, kNoiseEnds), width);
  std::memset(scratch.bins[kDetailClue].data(), bin_of(views.fine_detail, kDetailEnds), width);
}

void rate_reliability(const RatedViews& views, const Image<std::int32_t>& map,
                      const ClueMaps& clues, const ReliabilityTable& table, Inferred inferred,
                      int y0, int y1, ReliabilityScratch& scratch,
                      Image<std::uint8_t>& confidence) {
  static_assert(kPixelClues == kClues - 2);
  const std::array<EntryBytes, kPixelClues> entries = entry_bytes(table);
  RatedBins row{};
  for (int clue = 0; clue < kPixelClues; ++clue) row.bins[clue] = scratch.bins[clue].data();
  row.entries = entries.data();
  row.same = table[kNoiseClue][bin_of(views.noise_level, kNoiseEnds)] +
             table[kDetailClue][bin_of(views.fine_detail, kDetailEnds)];
  row.apart = inferred == Inferred::kApart;
  for (int y = y0; y < y1; ++y) {
    find_clue_bins(views, map, confidence, clues, y, scratch);
    HWY_DYNAMIC_DISPATCH(rate_row)(row, map.width(), confidence.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

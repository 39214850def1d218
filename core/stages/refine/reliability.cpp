// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/reliability.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/ramp.hpp"
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
  // Copies, so that compilers know the values.
  constexpr auto kNearer = kNearerDistances;
  constexpr auto kFarther = kFartherDistances;
  const auto step = hn::Set(d16, kOtherSurface);
  const auto none = hn::Set(d16, kNoSurface);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const std::int16_t* at = rows.middle + x;
    const auto own = hn::LoadU(d16, at);
    const auto near = hn::Add(own, step), far = hn::Sub(own, step);
    auto distance = none;
    for (std::size_t i = kNearer.size(); i-- > 0;) {
      const int k = kNearer[i];
      const auto is_nearer = hn::Gt(hn::LoadU(d16, at - k), near);
      distance = hn::IfThenElse(is_nearer, hn::Set(d16, static_cast<std::int16_t>(k)), distance);
    }
    hn::StoreU(hn::DemoteTo(d8, distance), d8, nearer + x);
    distance = none;
    for (std::size_t i = kFarther.size(); i-- > 0;) {
      const int k = kFarther[i];
      const auto row = hn::Min(hn::LoadU(d16, at - k), hn::LoadU(d16, at + k));
      const auto column =
          hn::Min(hn::LoadU(d16, rows.above[i] + x), hn::LoadU(d16, rows.below[i] + x));
      const auto is_farther = hn::Lt(hn::Min(row, column), far);
      distance = hn::IfThenElse(is_farther, hn::Set(d16, static_cast<std::int16_t>(k)), distance);
    }
    hn::StoreU(hn::DemoteTo(d8, distance), d8, farther + x);
  }
}

/// Adds up `count` rows of ClueMaps::matched.
void add_rows(const std::uint8_t* const* rows, int count, int width, std::uint16_t* sum) {
  constexpr int kTogether = 255 / (2 * kShareReach + 1);  // their sums fit into bytes
  const hn::CappedTag<std::uint8_t, kAlignment> d8;
  const hn::Half<decltype(d8)> half;
  const hn::Rebind<std::uint16_t, decltype(half)> d16;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d8))) {
    auto lower = hn::Zero(d16), upper = lower;
    for (int i = 0; i < count; i += kTogether) {
      auto bytes = hn::LoadU(d8, rows[i] + x);
      for (int k = i + 1; k < std::min(i + kTogether, count); ++k) {
        bytes = hn::Add(bytes, hn::LoadU(d8, rows[k] + x));
      }
      lower = hn::Add(lower, hn::PromoteTo(d16, hn::LowerHalf(half, bytes)));
      upper = hn::Add(upper, hn::PromoteTo(d16, hn::UpperHalf(half, bytes)));
    }
    hn::StoreU(lower, d16, sum + x);
    hn::StoreU(upper, d16, sum + x + hn::Lanes(d16));
  }
}

/// The bins of the sums of three rows: the number of ends up to the sum.
template <std::size_t kEnds>
HWY_INLINE void find_sum_bins(const SummedRows& rows, const std::int16_t (&ends)[kEnds], int width,
                              std::uint8_t* bins) {
  const Words d16;
  const Bytes d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    auto sum = hn::PromoteTo(d16, hn::LoadU(d8, rows[0] + x));
    for (int i = 1; i < 3; ++i) sum = hn::Add(sum, hn::PromoteTo(d16, hn::LoadU(d8, rows[i] + x)));
    auto bin = hn::Zero(d16);
    for (const std::int16_t end : ends) {
      const auto reached = hn::Gt(sum, hn::Set(d16, static_cast<std::int16_t>(end - 1)));
      bin = hn::Sub(bin, hn::VecFromMask(d16, reached));
    }
    hn::StoreU(hn::DemoteTo(d8, bin), d8, bins + x);
  }
}

void find_mismatch_bins(const SummedRows& rows, int width, std::uint8_t* bins) {
  find_sum_bins(rows, kMismatchEnds, width, bins);
}

/// Replaces the bins of clipped pixels.
void mark_clipped(const std::uint8_t* __restrict__ left, std::uint8_t clipped_from, int width,
                  std::uint8_t* __restrict__ bins) {
  for (int x = 0; x < width; ++x) bins[x] = left[x] >= clipped_from ? kClippedBin : bins[x];
}

void find_texture_bins(const SummedRows& rows, int width, std::uint8_t* bins) {
  find_sum_bins(rows, kTextureEnds, width, bins);
}

/// The products with the fraction `share` of 2^16.
void share_out(const std::uint16_t* __restrict__ sum, std::uint32_t share, int count,
               std::uint8_t* __restrict__ bins) {
  for (int i = 0; i < count; ++i) bins[i] = static_cast<std::uint8_t>(sum[i] * share >> 16);
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

using Rated = hn::CappedTag<std::uint8_t, 32>;
using RatedWords = hn::Repartition<std::int16_t, Rated>;

/// One of 32 bytes for each of the bins.
HWY_INLINE hn::Vec<Rated> look_up(const std::uint8_t* bytes, hn::Vec<Rated> bins) {
  const Rated d8;
  const auto most = hn::Set(d8, 15);
  const auto place = hn::And(bins, most);
  return hn::IfThenElse(hn::Gt(bins, most),
                        hn::TableLookupBytes(hn::LoadDup128(d8, bytes + 16), place),
                        hn::TableLookupBytes(hn::LoadDup128(d8, bytes), place));
}

/// The confidence by the sum of the entries. `matched` is 0 or all bits.
HWY_INLINE hn::Vec<RatedWords> rated(hn::Vec<RatedWords> sum, hn::Vec<Rated> matched, bool apart) {
  const RatedWords d16;
  static_assert(kReliabilityOne == 1 << 4);
  const auto one = hn::Set(d16, 1), most = hn::Set(d16, kMostInferred);
  const auto rating = hn::Min(hn::Max(hn::ShiftRight<4>(sum), one), hn::Set(d16, 255));
  if (!apart) return rating;
  // A division by 254, exact for these values.
  const auto product = hn::Mul(hn::Sub(rating, one), hn::Set(d16, kMostInferred - 1));
  const auto low = hn::ShiftRight<4>(hn::MulHigh(product, hn::Set(d16, 4129)));
  return hn::IfThenElse(hn::MaskFromVec(hn::BitCast(d16, matched)),
                        hn::Max(rating, hn::Add(most, one)), hn::Add(low, one));
}

/// The places of the lower bytes of eight words, then of the upper ones.
constexpr auto kBytesInOrder = [] {
  struct {
    alignas(16) std::uint8_t of[16];
  } places{};
  constexpr int kFirst = std::endian::native == std::endian::big ? 1 : 0;
  for (int i = 0; i < 16; ++i) {
    places.of[i] = static_cast<std::uint8_t>((2 * (i % 8) + i / 8) ^ kFirst);
  }
  return places;
}();

/// Replaces the confidence of a row.
void rate_row(const RatedBins& row, int width, std::uint8_t* confidence) {
  const Rated d8;
  const RatedWords d16;
  const auto in_order = hn::LoadDup128(d8, kBytesInOrder.of);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d8))) {
    auto lower = hn::Set(d16, static_cast<std::int16_t>(row.same)), upper = lower;
    for (int clue = 0; clue < kPixelClues; ++clue) {
      const auto bins = hn::LoadU(d8, row.bins[clue] + x);
      const auto first = look_up(row.entries[clue].of[0], bins);
      const auto second = look_up(row.entries[clue].of[1], bins);
      lower = hn::Add(lower, hn::BitCast(d16, hn::InterleaveLower(d8, first, second)));
      upper = hn::Add(upper, hn::BitCast(d16, hn::InterleaveUpper(d8, first, second)));
    }
    const auto before = hn::LoadU(d8, confidence + x);
    const auto matched = hn::VecFromMask(d8, hn::Gt(before, hn::Set(d8, kMostInferred)));
    lower = rated(lower, hn::InterleaveLower(d8, matched, matched), row.apart);
    upper = rated(upper, hn::InterleaveUpper(d8, matched, matched), row.apart);
    const auto both = hn::BitCast(d8, hn::Or(lower, hn::ShiftLeft<8>(upper)));
    hn::StoreU(hn::TableLookupBytes(both, in_order), d8, confidence + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(find_surfaces);
HWY_EXPORT(add_rows);
HWY_EXPORT(find_mismatch_bins);
HWY_EXPORT(mark_clipped);
HWY_EXPORT(find_texture_bins);
HWY_EXPORT(share_out);
HWY_EXPORT(find_partner_bins);
HWY_EXPORT(rate_row);

namespace {

constexpr int kShareSide = 2 * kShareReach + 1;
constexpr int kVector = static_cast<int>(kAlignment);

/// The ends of the bins of clues whose values are not bins themselves: the bin of a value is the
/// number of ends up to it.
constexpr float kNoiseEnds[] = {.1F, .3F, .6F, 1, 1.5F, 2, 2.5F, 3, 4, 5, 7, 10};
constexpr float kDetailEnds[] = {.024F, .03F, .037F, .045F, .06F, .1F, .2F};

/// Views are sharp from the first share of fine detail on, and soft at the second one.
struct DetailLimits {
  float sharp, soft;
};
constexpr DetailLimits kDetailLimits = {.2F, .06F};
constexpr DetailLimits kHalvedDetailLimits = {.12F, .03F};

/// Views have little noise up to the first level, and are noisy from the second one on [gray
/// values].
constexpr float kLittleNoise = 3;
constexpr float kMuchNoise = 5;

/// The BlockGrid::level() of views whose blocks count in full.
constexpr float kBlockyLevel = 2;

template <typename Value, std::size_t kEnds>
constexpr std::uint8_t bin_of(Value value, const Value (&ends)[kEnds]) {
  std::uint8_t bin = 0;
  for (const Value end : ends) bin += value >= end;
  return bin;
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
  const std::uint16_t* sum = scratch.sum.data();
  std::uint8_t* bins = scratch.bins[kShareClue].data();
  // All windows of the columns first .. end - 1 have as many columns.
  const auto divide = [&](int begin, int end) {
    // 16 / pixels as a fraction of 2^16, rounded up.
    const std::uint32_t pixels = static_cast<std::uint32_t>(rows * inside(begin, width));
    const std::uint32_t share = ((16U << 16) + pixels - 1) / pixels;
    HWY_DYNAMIC_DISPATCH(share_out)(sum + begin, share, end - begin, bins + begin);
  };
  const int left = std::min(kShareReach, width);
  const int right = std::max(left, width - kShareReach);
  for (int x = 0; x < left; ++x) divide(x, x + 1);
  if (left < right) divide(left, right);
  for (int x = right; x < width; ++x) divide(x, x + 1);
}

/// Row y and those `step` rows above and below.
SummedRows rows_around(const Image<std::uint8_t>& rows, int step, int y) {
  return {rows.row(std::max(y - step, 0)), rows.row(y),
          rows.row(std::min(y + step, rows.height() - 1))};
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

/// The bins that row y has in common with the other rows of its tiles.
void find_shared_bins(const RatedViews& views, int y, int width, ReliabilityScratch& scratch) {
  find_agreement_bins(views, y, width, scratch.bins[kAgreementClue].data());
  std::memset(scratch.bins[kNoiseClue].data(), bin_of(views.noise_level, kNoiseEnds), width);
  std::memset(scratch.bins[kDetailClue].data(), bin_of(views.fine_detail, kDetailEnds), width);
}

/// All other bins of row y.
void find_row_bins(const RatedViews& views, const Image<std::int32_t>& map,
                   const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                   ReliabilityScratch& scratch) {
  const int width = map.width();
  find_share_bins(clues, y, width, scratch);
  HWY_DYNAMIC_DISPATCH(find_mismatch_bins)
  (rows_around(clues.mismatch, 1, y), width, scratch.bins[kMismatchClue].data());
  if (views.clipped_from < kNothingClipped) {
    HWY_DYNAMIC_DISPATCH(mark_clipped)
    (views.left.row(y), static_cast<std::uint8_t>(views.clipped_from), width,
     scratch.bins[kMismatchClue].data());
  }
  HWY_DYNAMIC_DISPATCH(find_texture_bins)
  (rows_around(clues.texture, kTextureStep, y), width, scratch.bins[kTextureClue].data());
  find_surface_bins(clues, y, width, scratch);
  const std::uint8_t* row_confidence = confidence.row(y);
  std::uint8_t* support = scratch.bins[kSupportClue].data();
  for (int x = 0; x < width; ++x) support[x] = row_confidence[x] / 8;
  HWY_DYNAMIC_DISPATCH(find_partner_bins)
  (map.row(y), width, scratch.bins[kPartnerClue].data());
  find_guide_bins(views.guide, map, y, scratch.expected.data(), scratch.bins[kGuideClue].data());
  find_grid_bins(views.grid_level, views.block_side, map.row(y), width,
                 scratch.bins[kGridClue].data());
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
  expected.resize(width + kGuidePadding);
  for (Buffer<std::uint8_t>& row : bins) row.resize(width + kGuidePadding);
}

PartShares part_shares(const RatedViews& views) {
  const DetailLimits detail = views.halved ? kHalvedDetailLimits : kDetailLimits;
  return {1, ramp(detail.sharp, detail.soft, views.fine_detail),
          ramp(kLittleNoise, kMuchNoise, views.noise_level),
          ramp(0, kBlockyLevel, static_cast<float>(views.grid_level))};
}

ReliabilityTable table_for(const TableParts& parts, const PartShares& shares) {
  ReliabilityTable table{};
  for (int clue = 0; clue < kClues; ++clue) {
    for (int bin = 0; bin < kClueBins; ++bin) {
      long sum = 0;
      for (int part = 0; part < kTableParts; ++part) {
        sum += std::lround(shares[part] * static_cast<float>(parts[part][clue][bin]));
      }
      table[clue][bin] = static_cast<std::int16_t>(sum);
    }
  }
  return table;
}

void find_clue_bins(const RatedViews& views, const Image<std::int32_t>& map,
                    const Image<std::uint8_t>& confidence, const ClueMaps& clues, int y,
                    ReliabilityScratch& scratch) {
  find_shared_bins(views, y, map.width(), scratch);
  find_row_bins(views, map, confidence, clues, y, scratch);
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
    if (y == y0 || y % views.agreement_tile == 0) {
      find_shared_bins(views, y, map.width(), scratch);
    }
    find_row_bins(views, map, confidence, clues, y, scratch);
    HWY_DYNAMIC_DISPATCH(rate_row)(row, map.width(), confidence.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

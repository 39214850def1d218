// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/disparity_refinement.hpp"

#include <algorithm>
#include <cstring>

#include "mtstereo/image.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/disparity_refinement.cpp"
#include "base/simd.hpp"
#include "base/simd_transpose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Scratch = RefinementScratch;
using Ints = hn::CappedTag<std::int32_t, kAlignment / sizeof(std::int32_t)>;

constexpr int kRadius = kRefinementRadius;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kReach = Scratch::kShifts / 2;  // the largest shift [px]
static_assert(2 * kSide * kCensusBits < 256, "a column's costs are summed in bytes");

/// The ring buffers' rows of one image row.
struct RingRow {
  std::uint8_t* costs[Scratch::kShifts];
  std::int8_t* rounded;
  std::uint8_t* known;
};

RingRow ring_row(int y, Scratch& scratch) {
  // The first rows lie above the image.
  const std::ptrdiff_t row = (y + 2 * Scratch::kRows) % Scratch::kRows;
  RingRow ring;
  for (int i = 0; i < Scratch::kShifts; ++i) {
    ring.costs[i] = scratch.costs.data() + (row * Scratch::kShifts + i) * scratch.stride;
  }
  ring.rounded = scratch.rounded.data() + row * scratch.stride;
  ring.known = scratch.known.data() + row * scratch.stride;
  return ring;
}

/// Units of the map in a pixel of the full views.
constexpr int kPixel = kDisparityOne / 2;

/// Splits the disparities of a row into whole pixels of the full views and rounding errors.
void round_row(const std::int32_t* __restrict__ disparity, int width,
               std::int32_t* __restrict__ places, std::int8_t* __restrict__ rounded,
               std::uint8_t* __restrict__ known) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t whole = (disparity[x] + kPixel / 2) / kPixel;
    const bool inside = whole <= 2 * x;
    places[x] = inside ? 2 * x - whole : 0;
    rounded[x] = static_cast<std::int8_t>(inside ? disparity[x] - whole * kPixel : 0);
    known[x] = (disparity[x] != kNoDisparity) & inside;
  }
}

using Vec = hn::Vec<Ints>;

/// The words of the right view that a pixel of the map is compared with: from that of its odd pixel
/// at the last shift up to that of its even pixel at the first shift.
constexpr int kPartners = Scratch::kShifts + 1;

/// Copies the partners, four pixels at a time: row i of `partners` has those at right + places + i.
/// Processors load blocks and transpose them in less time than they gather words.
void copy_partners(const std::uint32_t* right, const std::int32_t* places, int width,
                   std::ptrdiff_t stride, std::uint32_t* partners) {
  for (int x = 0; x < width; x += 4) {
    const std::uint32_t* of[4];
    for (int i = 0; i < 4; ++i) of[i] = right + places[x + i];
    for (const int first : {0, kPartners - 4}) {
      std::uint32_t* out[4];
      for (int i = 0; i < 4; ++i) out[i] = partners + (first + i) * stride;
      transpose_four(of, first, out, x);
    }
  }
}

/// The costs of a row at all shifts, of two pixels of the full views each; 0 for pixels without a
/// disparity.
void cost_row(const std::uint32_t* left, const std::uint32_t* partners, std::ptrdiff_t stride,
              int width, const RingRow& ring) {
  const hn::CappedTag<std::uint32_t, kAlignment / sizeof(std::uint32_t)> d32;
  const hn::Repartition<std::uint8_t, decltype(d32)> bytes;
  const hn::Rebind<std::uint8_t, decltype(d32)> d8;
  const auto each = hn::Set(d32, 0x01010101);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto known = hn::Sub(hn::Zero(d8), hn::LoadU(d8, ring.known + x));
    hn::Vec<decltype(d32)> even, odd;
    hn::LoadInterleaved2(d32, left + 2 * x, even, odd);
    const auto bits_of = [&](auto pixel, int partner) HWY_ATTR {
      const auto of = hn::LoadU(d32, partners + partner * stride + x);
      return hn::PopulationCount(hn::BitCast(bytes, hn::Xor(pixel, of)));
    };
    for (int i = 0; i < Scratch::kShifts; ++i) {
      // The partners of the odd pixels are those of the even ones at the shift before.
      const auto bits = hn::Add(bits_of(even, kPartners - 2 - i), bits_of(odd, kPartners - 1 - i));
      const auto cost = hn::ShiftRight<24>(hn::Mul(hn::BitCast(d32, bits), each));
      hn::StoreU(hn::And(known, hn::U8FromU32(cost)), d8, ring.costs[i] + x);
    }
  }
}

void fill_ring_row(const CensusImage& left, const CensusImage& right,
                   const Image<std::int32_t>& map, int y, Scratch& scratch) {
  const int width = map.width();
  const RingRow ring = ring_row(y, scratch);
  if (y < 0 || y >= map.height()) {
    for (std::uint8_t* costs : ring.costs) std::memset(costs, 0, width);
    std::memset(ring.rounded, 0, width);
    std::memset(ring.known, 0, width);
    return;
  }
  const int columns = right.bits.width();
  std::copy_n(left.bits.row(y), columns, scratch.left.data());
  scratch.left[columns] = scratch.left[columns - 1];
  std::uint32_t* line = scratch.right.data();
  std::copy_n(right.bits.row(y), columns, line + kReach);
  std::fill_n(line, kReach, line[kReach]);
  std::fill_n(line + kReach + columns, kReach + 1, line[kReach + columns - 1]);
  round_row(map.row(y), width, scratch.places.data(), ring.rounded, ring.known);
  std::uint32_t* partners = scratch.partners.data();
  copy_partners(line, scratch.places.data(), width, scratch.stride, partners);
  cost_row(scratch.left.data(), partners, scratch.stride, width, ring);
}

/// Advances the sums of columns by one row.
template <typename Value, typename Sum>
void move_sums(const Value* __restrict__ added, const Value* __restrict__ removed, int width,
               Sum* __restrict__ sums) {
  for (int x = 0; x < width; ++x) sums[x] = static_cast<Sum>(sums[x] + added[x] - removed[x]);
}

void move_columns(int y, int width, Scratch& scratch) {
  const RingRow added = ring_row(y + kRadius, scratch);
  const RingRow removed = ring_row(y - kRadius - 1, scratch);
  for (int i = 0; i < Scratch::kShifts; ++i) {
    move_sums(added.costs[i], removed.costs[i], width,
              scratch.cost_columns.data() + i * scratch.stride + kRadius);
  }
  move_sums(added.rounded, removed.rounded, width, scratch.round_columns.data() + kRadius);
  move_sums(added.known, removed.known, width, scratch.known_columns.data() + kRadius);
}

/// The sums over the window from those over its columns. `columns` begins at the first window's
/// first column.
template <typename Sum>
void sum_window(const Sum* __restrict__ columns, int width, std::int16_t* __restrict__ sums) {
  static_assert(kSide == 5);
  for (int x = 0; x < width; ++x) {
    sums[x] = static_cast<std::int16_t>(columns[x] + columns[x + 1] + columns[x + 2] +
                                        columns[x + 3] + columns[x + 4]);
  }
}

/// The rows of RefinementScratch::sums: the costs of the shifts, then the rounding errors, then the
/// number of known disparities.
constexpr int kRounded = Scratch::kShifts;
constexpr int kKnown = Scratch::kShifts + 1;

void sum_windows(int width, Scratch& scratch) {
  const auto sums = [&](int row) { return scratch.sums.data() + row * scratch.stride; };
  for (int i = 0; i < Scratch::kShifts; ++i) {
    sum_window(scratch.cost_columns.data() + i * scratch.stride, width, sums(i));
  }
  sum_window(scratch.round_columns.data(), width, sums(kRounded));
  sum_window(scratch.known_columns.data(), width, sums(kKnown));
}

/// The smallest cost of the shifts -1 .. 1 px, the costs before and after it, and that shift.
struct Minimum {
  Vec before, best, after, shift;
};

/// Costs are in 1/32 bits. A shift by 1 px away from the given disparities costs 2 bits for each
/// pixel of the full views.
HWY_INLINE Minimum find_minimum(const std::int16_t* sums, std::ptrdiff_t stride, Vec rounded,
                                Vec known) {
  const Ints di32;
  const hn::Rebind<std::int16_t, Ints> d16;
  const auto cost = [&](int i, Vec away) {
    const auto sum = hn::PromoteTo(di32, hn::LoadU(d16, sums + i * stride));
    return hn::Add(hn::ShiftLeft<5>(sum), hn::Abs(away));
  };
  const auto one = hn::ShiftLeft<7>(known), two = hn::ShiftLeft<8>(known);
  const auto two_less = cost(0, hn::Add(two, rounded));
  const auto one_less = cost(1, hn::Add(one, rounded));
  const auto same = cost(2, rounded);
  const auto one_more = cost(3, hn::Sub(one, rounded));
  const auto two_more = cost(4, hn::Sub(two, rounded));
  const auto best = hn::Min(hn::Min(one_less, same), one_more);
  const auto less = hn::Eq(one_less, best);
  const auto more = hn::Eq(one_more, best);  // `less` takes precedence
  const auto select = [&](Vec if_less, Vec if_same, Vec if_more) {
    return hn::IfThenElse(less, if_less, hn::IfThenElse(more, if_more, if_same));
  };
  return {select(two_less, one_less, same), best, select(same, one_more, two_more),
          select(hn::Set(di32, -kPixel), hn::Zero(di32), hn::Set(di32, kPixel))};
}

/// Refines one row by the sums over its windows.
void refine_row(const std::int32_t* map, int width, int limit, const Scratch& scratch,
                std::int32_t* out) {
  const Ints di32;
  const hn::Rebind<std::int16_t, Ints> d16;
  const hn::Rebind<float, Ints> df32;
  const auto zero = hn::Zero(di32), unit = hn::Set(di32, 1);
  const auto ratio = [&](Vec a, Vec b) {
    return hn::Div(hn::ConvertTo(df32, a), hn::ConvertTo(df32, hn::Max(b, unit)));
  };
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(di32))) {
    const std::int16_t* sums = scratch.sums.data() + x;
    const auto given = hn::LoadU(di32, map + x);
    if (hn::AllTrue(di32, hn::Eq(given, zero))) {
      hn::StoreU(zero, di32, out + x);
      continue;
    }
    const auto rounded = hn::PromoteTo(di32, hn::LoadU(d16, sums + kRounded * scratch.stride));
    const auto known = hn::PromoteTo(di32, hn::LoadU(d16, sums + kKnown * scratch.stride));
    const Minimum at = find_minimum(sums, scratch.stride, rounded, known);
    const auto slope = hn::Sub(hn::Max(at.before, at.after), at.best);
    const auto between = ratio(hn::ShiftLeft<6>(hn::Sub(at.before, at.after)), slope);
    const auto change = hn::ConvertTo(di32, hn::Sub(between, ratio(rounded, known)));
    const auto refined = hn::Add(given, hn::Add(at.shift, change));
    const auto column = hn::ShiftLeft<8>(hn::Iota(di32, x));
    const auto possible =
        hn::Max(hn::Min(refined, hn::Min(hn::Max(column, given), hn::Set(di32, limit))), unit);
    // A minimum is below at least one neighbor and above none.
    const auto is_minimum =
        hn::AndNot(hn::Lt(hn::Min(at.before, at.after), at.best), hn::Gt(slope, zero));
    const auto kept = hn::IfThenElse(is_minimum, possible, given);
    hn::StoreU(hn::IfThenElse(hn::Eq(given, zero), zero, kept), di32, out + x);
  }
}

void refine_band(const CensusImage& left, const CensusImage& right, const Image<std::int32_t>& map,
                 int max_disparity, int y0, int y1, Scratch& scratch,
                 Image<std::int32_t>& refined) {
  const int width = map.width();
  const int limit = max_disparity * kPixel - 1;
  for (int y = y0 - 2 * kRadius; y < y1; ++y) {
    fill_ring_row(left, right, map, y + kRadius, scratch);
    move_columns(y, width, scratch);
    if (y < y0) continue;
    sum_windows(width, scratch);
    refine_row(map.row(y), width, limit, scratch, refined.row(y));
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(refine_band);

void RefinementScratch::resize(int width) {
  // A whole vector after the last pixel of a row is read and written.
  constexpr int kVector = static_cast<int>(kAlignment);
  stride = (width + 2 * kRefinementRadius + kVector) / kVector * kVector;
  left.resize(2 * stride);
  std::memset(left.data(), 0, left.size() * sizeof(left[0]));
  right.resize(2 * width + kShifts + 1);
  places.resize(stride);
  partners.resize((kShifts + 1) * stride);
  costs.resize(kRows * kShifts * stride);
  rounded.resize(kRows * stride);
  known.resize(kRows * stride);
  cost_columns.resize(kShifts * stride);
  round_columns.resize(stride);
  known_columns.resize(stride);
  sums.resize((kShifts + 2) * stride);
}

void refine_disparities(const CensusImage& left, const CensusImage& right,
                        const Image<std::int32_t>& map, int max_disparity, int y0, int y1,
                        RefinementScratch& scratch, Image<std::int32_t>& refined) {
  // No disparity is known above the first window and outside of the rows.
  const auto clear = [](auto& buffer) {
    std::memset(buffer.data(), 0, buffer.size() * sizeof(buffer[0]));
  };
  clear(scratch.places);
  clear(scratch.costs);
  clear(scratch.rounded);
  clear(scratch.known);
  clear(scratch.cost_columns);
  clear(scratch.round_columns);
  clear(scratch.known_columns);
  HWY_DYNAMIC_DISPATCH(refine_band)(left, right, map, max_disparity, y0, y1, scratch, refined);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

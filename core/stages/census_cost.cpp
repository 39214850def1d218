// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/census_cost.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/census_cost.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each processor.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mtstereo {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::CappedTag<std::uint8_t, kCostStep>;
using CensusBytes = std::uint8_t* const[kCensusBytes];

/// Takes the costs of a row into the ring's row `slot` and into the sum, where they replace those
/// that the ring held. `right` is mirrored and goes on for cost_lanes() columns beyond.
void replace_row(const CensusBytes& left, const CensusBytes& right, int width, int disparities,
                 std::uint8_t* slot, std::uint8_t* sum) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const int lanes = cost_lanes(disparities);
  for (int x = 0; x < width; ++x) {
    const auto bits0 = hn::Set(d8, left[0][x]);
    const auto bits1 = hn::Set(d8, left[1][x]);
    const auto bits2 = hn::Set(d8, left[2][x]);
    // Disparity d of this pixel is the mirrored right pixel width - 1 - x + d.
    const int first = width - 1 - x;
    const std::uint8_t* right0 = right[0] + first;
    const std::uint8_t* right1 = right[1] + first;
    const std::uint8_t* right2 = right[2] + first;
    std::uint8_t* old = slot + static_cast<std::ptrdiff_t>(x) * lanes;
    std::uint8_t* total = sum + static_cast<std::ptrdiff_t>(x) * lanes;
    for (int d = 0; d < lanes; d += step) {
      const auto count0 = hn::PopulationCount(hn::Xor(bits0, hn::LoadU(d8, right0 + d)));
      const auto count1 = hn::PopulationCount(hn::Xor(bits1, hn::LoadU(d8, right1 + d)));
      const auto count2 = hn::PopulationCount(hn::Xor(bits2, hn::LoadU(d8, right2 + d)));
      const auto cost = hn::Add(hn::Add(count0, count1), count2);
      hn::Store(hn::Add(hn::Sub(hn::Load(d8, total + d), hn::Load(d8, old + d)), cost), d8,
                total + d);
      hn::Store(cost, d8, old + d);
    }
  }
}

/// The binomial mean along the row of 1, 3 or 5 cells that lie at `offsets` from the middle one.
template <class V>
V mean_along_row(Bytes d8, const std::uint8_t* sums, const std::ptrdiff_t* offsets, int size,
                 V middle) {
  if (size == 1) return middle;
  const V near =
      hn::AverageRound(hn::LoadU(d8, sums + offsets[1]), hn::LoadU(d8, sums + offsets[2]));
  if (size == 3) return hn::AverageRound(near, middle);
  // 1 4 6 4 1 in sixteenths.
  const V far =
      hn::AverageRound(hn::LoadU(d8, sums + offsets[0]), hn::LoadU(d8, sums + offsets[3]));
  const V rest = hn::AverageRound(middle, hn::AverageRound(far, middle));
  return hn::AverageRound(near, rest);
}

void write_row(const CensusCostOptions& options, int width, const std::uint16_t* low,
               const std::uint16_t* high, const CensusCostScratch& scratch, std::uint8_t* costs) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const int lanes = cost_lanes(options.disparities);
  const std::uint8_t* below_table = scratch.tables.data();
  const std::uint8_t* above_table = below_table + 2 * lanes;
  const std::uint8_t* never = above_table + 2 * lanes;
  for (int x = 0; x < width; ++x) {
    const std::uint8_t* sums = scratch.vertical.data() + static_cast<std::ptrdiff_t>(x) * lanes;
    std::uint8_t* out = costs + static_cast<std::ptrdiff_t>(x) * lanes;
    const std::ptrdiff_t offsets[4] = {
        static_cast<std::ptrdiff_t>(std::max(x - 2, 0) - x) * lanes,
        static_cast<std::ptrdiff_t>(std::max(x - 1, 0) - x) * lanes,
        static_cast<std::ptrdiff_t>(std::min(x + 1, width - 1) - x) * lanes,
        static_cast<std::ptrdiff_t>(std::min(x + 2, width - 1) - x) * lanes};
    const bool expected = low[x] <= high[x];
    // Windows into tables of two halves: the penalty lies left of `low` and right of `high`.
    const std::uint8_t* below = below_table + lanes - (expected ? low[x] : 0);
    const std::uint8_t* above = above_table + (expected ? lanes - 1 - high[x] : 0);
    for (int d = 0; d < lanes; d += step) {
      const auto mean =
          mean_along_row(d8, sums + d, offsets, options.kernel_size, hn::Load(d8, sums + d));
      const auto penalty = hn::Max(hn::LoadU(d8, below + d), hn::LoadU(d8, above + d));
      hn::Store(hn::Max(hn::SaturatedAdd(mean, penalty), hn::Load(d8, never + d)), d8, out + d);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace mtstereo
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(replace_row);
HWY_EXPORT(write_row);

namespace {

using CensusBytes = std::uint8_t* const[kCensusBytes];

/// Takes the image's row next to `y` into ring and sum; beyond the border the border's row.
void take_row(const CensusImage& left, const CensusImage& right, const CensusCostOptions& options,
              int y, CensusCostScratch& scratch) {
  const int width = left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  const int inside = std::clamp(y, 0, left.bits.height() - 1);
  std::uint8_t* planes = scratch.planes.data();
  const auto next_plane = [&](int size) { return std::exchange(planes, planes + size); };
  const CensusBytes left_bytes = {next_plane(width), next_plane(width), next_plane(width)};
  const CensusBytes right_bytes = {next_plane(width + lanes), next_plane(width + lanes),
                                   next_plane(width + lanes)};
  split_census_row(left.bits.row(inside), width, RowOrder::kForward, 0, left_bytes);
  split_census_row(right.bits.row(inside), width, RowOrder::kMirrored, lanes, right_bytes);
  const std::ptrdiff_t row_cells = static_cast<std::ptrdiff_t>(width) * lanes;
  const int size = options.kernel_size;
  const int slot = ((y % size) + size) % size;
  HWY_DYNAMIC_DISPATCH(replace_row)
  (left_bytes, right_bytes, width, options.disparities, scratch.ring.data() + slot * row_cells,
   scratch.vertical.data());
}

}  // namespace

void CensusCostScratch::resize(int width, const CensusCostOptions& options) {
  const std::size_t lanes = cost_lanes(options.disparities);
  planes.resize(kCensusBytes * (2 * width + lanes));
  ring.resize(width * lanes * options.kernel_size);
  vertical.resize(width * lanes);
  tables.resize(5 * lanes);
  const int penalty = std::min(options.range_penalty * cost_scale(options), 255);
  std::uint8_t* below = tables.data();
  std::uint8_t* above = below + 2 * lanes;
  std::uint8_t* never = above + 2 * lanes;
  std::memset(below, penalty, lanes);
  std::memset(below + lanes, 0, lanes);
  std::memset(above, 0, lanes);
  std::memset(above + lanes, penalty, lanes);
  std::memset(never, 0, options.disparities);
  std::memset(never + options.disparities, kCensusNever, lanes - options.disparities);
}

void start_census_costs(const CensusImage& left, const CensusImage& right,
                        const CensusCostOptions& options, int y, CensusCostScratch& scratch) {
  std::memset(scratch.ring.data(), 0, scratch.ring.size());
  std::memset(scratch.vertical.data(), 0, scratch.vertical.size());
  const int reach = options.kernel_size / 2;
  for (int i = -reach; i < reach; ++i) take_row(left, right, options, y + i, scratch);
}

void census_cost_row(const CensusImage& left, const CensusImage& right,
                     const CensusCostOptions& options, int y, const std::uint16_t* low,
                     const std::uint16_t* high, CensusCostScratch& scratch, std::uint8_t* costs) {
  take_row(left, right, options, y + options.kernel_size / 2, scratch);
  HWY_DYNAMIC_DISPATCH(write_row)
  (options, left.bits.width(), low, high, scratch, costs);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

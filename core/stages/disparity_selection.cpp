// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/disparity_selection.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/image.hpp"
#include "stages/census_cost.hpp"
#include "stages/subpixel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/disparity_selection.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each processor.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mtstereo {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint16_t, 16>;

constexpr std::uint16_t kHighest = 0xFFFF;

/// The least of the costs first .. last - 1; whole vectors are read from aligned places, and what
/// lies behind `last` up to there must not be less.
int least_cost(Words d16, const std::uint16_t* costs, int first, int last) {
  const int step = static_cast<int>(hn::Lanes(d16));
  auto least = hn::Set(d16, kHighest);
  for (int d = first; d < last; d += step) least = hn::Min(least, hn::Load(d16, costs + d));
  return hn::GetLane(hn::MinOfLanes(d16, least));
}

/// The first disparity whose cost is `cost`, which is there.
int first_with_cost(Words d16, const std::uint16_t* costs, int cost) {
  const int step = static_cast<int>(hn::Lanes(d16));
  const auto wanted = hn::Set(d16, static_cast<std::uint16_t>(cost));
  for (int d = 0;; d += step) {
    const auto found = hn::FindFirstTrue(d16, hn::Eq(hn::Load(d16, costs + d), wanted));
    if (found >= 0) return d + static_cast<int>(found);
  }
}

/// Lets the pixel's costs compete for the right pixels it could show.
void offer_to_right(Words d16, const std::uint16_t* costs, int count, std::uint16_t* least,
                    std::uint16_t* disparity) {
  const int step = static_cast<int>(hn::Lanes(d16));
  auto index = hn::Iota(d16, 0);
  const auto next = hn::Set(d16, static_cast<std::uint16_t>(step));
  for (int d = 0; d < count; d += step) {
    const auto cost = hn::Load(d16, costs + d);
    const auto known = hn::LoadU(d16, least + d);
    const auto better = hn::Lt(cost, known);
    hn::StoreU(hn::Min(cost, known), d16, least + d);
    hn::StoreU(hn::IfThenElse(better, index, hn::LoadU(d16, disparity + d)), d16, disparity + d);
    index = hn::Add(index, next);
  }
}

/// The least cost of the disparities first .. last - 1 that are not within 1 of `best`, or
/// kHighest.
int runner_up_cost(Words d16, std::uint16_t* costs, int best, int first, int last, int count) {
  if (first > 0 || last < count) {  // a few only
    int least = kHighest;
    for (int d = first; d < last; ++d) {
      if (std::abs(d - best) > 1) least = std::min<int>(least, costs[d]);
    }
    return least;
  }
  std::uint16_t kept[3];
  const int begin = std::max(best - 1, 0);
  const int end = std::min(best + 2, count);
  for (int d = begin; d < end; ++d) {
    kept[d - begin] = costs[d];
    costs[d] = kHighest;
  }
  const int least = least_cost(d16, costs, 0, count);
  for (int d = begin; d < end; ++d) costs[d] = kept[d - begin];
  return least;
}

/// The pixel's disparity and peak ratio before the left-right check, from its `count` costs.
/// low > high: no disparity is expected.
std::int32_t select_one(Words d16, std::uint16_t* costs, int count, const SelectionOptions& options,
                        int low, int high, std::uint16_t& best, std::uint8_t& ratio) {
  if (low > high) return kNoDisparity;
  const int cost = least_cost(d16, costs, 0, count);
  const int whole = first_with_cost(d16, costs, cost);
  const bool narrow = options.runner_up_in_range;
  const int runner_up = runner_up_cost(d16, costs, whole, narrow ? low : 0,
                                       narrow ? std::min(high + 1, count) : count, count);
  if (runner_up == kHighest || !(runner_up > cost * (1 + options.confidence))) return kNoDisparity;
  int disparity = whole * kDisparityOne;
  if (options.subpixel && whole > 0 && whole + 1 < count && costs[whole + 1] >= cost) {
    disparity += symmetric_v_offset(costs[whole - 1], cost, costs[whole + 1]);
  }
  best = static_cast<std::uint16_t>(whole);
  ratio = static_cast<std::uint8_t>(std::max(peak_ratio(cost, runner_up), 1));
  return std::max(disparity, 1);
}

void select_row(std::uint16_t* sums, int width, const SelectionOptions& options,
                const std::uint16_t* low, const std::uint16_t* high, SelectionScratch& scratch,
                std::int32_t* disparity, std::uint8_t* ratio) {
  const Words d16;
  const int step = static_cast<int>(hn::Lanes(d16));
  const int lanes = cost_lanes(options.disparities);
  std::fill_n(scratch.least.data(), scratch.least.size(), kHighest);
  for (int x = 0; x < width; ++x) {
    std::uint16_t* costs = sums + static_cast<std::ptrdiff_t>(x) * lanes;
    const int count = std::min(options.disparities, x + 1);  // disparities with a right pixel
    // The rest of the last vector must not win.
    for (int d = count; d % step != 0; ++d) costs[d] = kHighest;
    const int first = width - 1 - x;
    offer_to_right(d16, costs, count, scratch.least.data() + first,
                   scratch.disparity.data() + first);
    scratch.best[x] = SelectionScratch::kNothing;
    ratio[x] = 0;
    disparity[x] =
        select_one(d16, costs, count, options, low[x], high[x], scratch.best[x], ratio[x]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace mtstereo
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(select_row);

namespace {

/// Takes away the disparities whose right pixel has another one.
void check_left_right(int width, int tolerance, const SelectionScratch& scratch,
                      std::int32_t* disparity, std::uint8_t* ratio) {
  for (int x = 0; x < width; ++x) {
    const int best = scratch.best[x];
    if (best == SelectionScratch::kNothing) continue;
    const int right = scratch.disparity[width - 1 - x + best];
    if (std::abs(right - best) <= tolerance) continue;
    disparity[x] = kNoDisparity;
    ratio[x] = 0;
  }
}

}  // namespace

void SelectionScratch::resize(int width) {
  // Whole vectors are read and written from each of them on.
  constexpr int kVector = 16;
  least.resize(width + kVector);
  disparity.resize(width + kVector);
  best.resize(width);
  std::fill_n(disparity.data(), disparity.size(), std::uint16_t{0});
}

void select_disparities(std::uint16_t* sums, int width, const SelectionOptions& options,
                        const std::uint16_t* low, const std::uint16_t* high,
                        SelectionScratch& scratch, std::int32_t* disparity, std::uint8_t* ratio) {
  HWY_DYNAMIC_DISPATCH(select_row)
  (sums, width, options, low, high, scratch, disparity, ratio);
  if (options.left_right_tolerance >= 0) {
    check_left_right(width, options.left_right_tolerance, scratch, disparity, ratio);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

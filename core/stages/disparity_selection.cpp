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

/// The costs d, d + 1, ... of a pixel with `count` of them; kHighest behind these.
template <class V>
V load_costs(Words d16, const std::uint16_t* costs, int d, int count, V index) {
  const V cost = hn::Load(d16, costs + d);
  if (d + static_cast<int>(hn::Lanes(d16)) <= count) return cost;
  const auto exists = hn::Lt(index, hn::Set(d16, static_cast<std::uint16_t>(count)));
  return hn::IfThenElse(exists, cost, hn::Set(d16, kHighest));
}

/// The least of a pixel's costs. On the way they compete for the right pixels that they could show.
int offer_to_right(Words d16, const std::uint16_t* costs, int count, std::uint16_t* right_least,
                   std::uint16_t* right_disparity) {
  const int step = static_cast<int>(hn::Lanes(d16));
  auto index = hn::Iota(d16, 0);
  auto least = hn::Set(d16, kHighest);
  const auto next = hn::Set(d16, static_cast<std::uint16_t>(step));
  for (int d = 0; d < count; d += step) {
    const auto cost = load_costs(d16, costs, d, count, index);
    const auto known = hn::LoadU(d16, right_least + d);
    const auto better = hn::Lt(cost, known);
    least = hn::Min(least, cost);
    hn::StoreU(hn::Min(cost, known), d16, right_least + d);
    hn::StoreU(hn::IfThenElse(better, index, hn::LoadU(d16, right_disparity + d)), d16,
               right_disparity + d);
    index = hn::Add(index, next);
  }
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

/// The least of a pixel's costs that are not within 1 of `best`, or kHighest.
int runner_up_of_all(Words d16, const std::uint16_t* costs, int best, int count) {
  const int step = static_cast<int>(hn::Lanes(d16));
  auto index = hn::Iota(d16, 0);
  auto least = hn::Set(d16, kHighest);
  const auto next = hn::Set(d16, static_cast<std::uint16_t>(step));
  // best - 1 .. best + 1 become 0 .. 2; below 0 the numbers begin again at the top.
  const auto before = hn::Set(d16, static_cast<std::uint16_t>(best - 1));
  const auto three = hn::Set(d16, 3);
  for (int d = 0; d < count; d += step) {
    const auto cost = load_costs(d16, costs, d, count, index);
    const auto beside = hn::Lt(hn::Sub(index, before), three);
    least = hn::Min(least, hn::IfThenElse(beside, hn::Set(d16, kHighest), cost));
    index = hn::Add(index, next);
  }
  return hn::GetLane(hn::MinOfLanes(d16, least));
}

/// The same of the disparities first .. last only.
int runner_up_of_range(const std::uint16_t* costs, int best, int first, int last) {
  int least = kHighest;
  for (int d = first; d <= last; ++d) {
    if (std::abs(d - best) > 1) least = std::min<int>(least, costs[d]);
  }
  return least;
}

/// The pixel's disparity and peak ratio before the left-right check, from its `count` costs, of
/// which the least is `cost`. low > high: no disparity is expected.
std::int32_t select_one(Words d16, const std::uint16_t* costs, int count, int cost,
                        const SelectionOptions& options, int low, int high, std::uint16_t& best,
                        std::uint8_t& ratio) {
  if (low > high) return kNoDisparity;
  const int whole = first_with_cost(d16, costs, cost);
  const int runner_up = options.runner_up_in_range
                            ? runner_up_of_range(costs, whole, low, std::min(high, count - 1))
                            : runner_up_of_all(d16, costs, whole, count);
  if (runner_up == kHighest || !(runner_up > cost * (1 + options.confidence))) return kNoDisparity;
  int disparity = whole * kDisparityOne;
  if (options.subpixel && whole > 0 && whole + 1 < count) {
    disparity += symmetric_v_offset(costs[whole - 1], cost, costs[whole + 1]);
  }
  best = static_cast<std::uint16_t>(whole);
  ratio = static_cast<std::uint8_t>(std::max(peak_ratio(cost, runner_up), 1));
  return std::max(disparity, 1);
}

void select_row(const std::uint16_t* sums, int width, const SelectionOptions& options,
                const std::uint16_t* low, const std::uint16_t* high, SelectionScratch& scratch,
                std::int32_t* disparity, std::uint8_t* ratio) {
  const Words d16;
  const int lanes = cost_lanes(options.disparities);
  std::fill_n(scratch.least.data(), scratch.least.size(), kHighest);
  for (int x = 0; x < width; ++x) {
    const std::uint16_t* costs = sums + static_cast<std::ptrdiff_t>(x) * lanes;
    const int count = std::min(options.disparities, x + 1);  // disparities with a right pixel
    const int first = width - 1 - x;
    const int cost = offer_to_right(d16, costs, count, scratch.least.data() + first,
                                    scratch.disparity.data() + first);
    scratch.best[x] = SelectionScratch::kNothing;
    ratio[x] = 0;
    disparity[x] =
        select_one(d16, costs, count, cost, options, low[x], high[x], scratch.best[x], ratio[x]);
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

void select_disparities(const std::uint16_t* sums, int width, const SelectionOptions& options,
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/column_optimization.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "stages/pixels/census_cost.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/column_optimization.cpp"
#include "base/simd.hpp"
#include "stages/pixels/path_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Copies the costs of the paths' first row, which has no predecessor.
void begin_columns(const ColumnStep& row, std::uint8_t* paths, std::uint8_t* least) {
  const Bytes d8;
  const int lanes = cost_lanes(row.disparities);
  const std::uint8_t* costs = row.costs;
  for (int x = 0; x < row.width; ++x, costs += lanes, paths += lanes) {
    auto lowest = hn::Set(d8, 255);
    for (int d = 0; d < lanes; d += static_cast<int>(hn::Lanes(d8))) {
      const auto cost = hn::Load(d8, costs + d);
      hn::Store(cost, d8, paths + d);
      lowest = hn::Min(lowest, cost);
    }
    least[x] = hn::GetLane(least_of_lanes(d8, lowest));
  }
}

void continue_columns(const ColumnStep& row, const std::uint8_t* before, std::uint8_t* paths,
                      std::uint8_t* least) {
  const Bytes d8;
  const int step = static_cast<int>(hn::Lanes(d8));
  const int lanes = cost_lanes(row.disparities);
  const auto small_step = hn::Set(d8, static_cast<std::uint8_t>(std::min(row.small_step, 255)));
  const auto never = hn::Set(d8, 255);
  const std::uint8_t* large_step = row.large_step->data();
  const std::uint8_t* costs = row.costs;
  for (int x = 0; x < row.width; ++x, costs += lanes, before += lanes, paths += lanes) {
    const int change = std::abs(row.gray[x] - row.gray_before[x]);
    const auto lowest_before = hn::Set(d8, least[x]);
    const auto any = hn::SaturatedAdd(lowest_before, hn::Set(d8, large_step[change]));
    auto lowest = never;
    auto previous = never;
    auto same = hn::Load(d8, before);
    for (int d = 0; d < lanes; d += step) {
      const auto after = d + step < lanes ? hn::Load(d8, before + d + step) : never;
      const auto path = path_costs(d8, hn::Load(d8, costs + d), previous, same, after, small_step,
                                   any, lowest_before);
      hn::Store(path, d8, paths + d);
      lowest = hn::Min(lowest, path);
      previous = same;
      same = after;
    }
    least[x] = hn::GetLane(least_of_lanes(d8, lowest));
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(begin_columns);
HWY_EXPORT(continue_columns);

void step_columns(const ColumnStep& row, const std::uint8_t* before, std::uint8_t* paths,
                  std::uint8_t* least) {
  if (before == nullptr) {
    HWY_DYNAMIC_DISPATCH(begin_columns)(row, paths, least);
  } else {
    HWY_DYNAMIC_DISPATCH(continue_columns)(row, before, paths, least);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/column_optimization.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <type_traits>

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
    const CostWindow window = window_at(row.windows, lanes, x);
    auto lowest = hn::Set(d8, 255);
    for (int d = window.begin; d < window.end; d += static_cast<int>(hn::Lanes(d8))) {
      const auto cost = hn::LoadU(d8, costs + d);
      hn::StoreU(cost, d8, paths + d);
      lowest = hn::Min(lowest, cost);
    }
    least[x] = least_lane(d8, lowest);
  }
}

/// Advances the paths of the columns x0 .. x1 - 1, which have the same window.
template <int kVectors>
HWY_INLINE void continue_tile(const ColumnStep& row, CostWindow window, int x0, int x1,
                              const std::uint8_t* before, std::uint8_t* paths,
                              std::uint8_t* least) {
  const Bytes d8;
  const std::ptrdiff_t lanes = cost_lanes(row.disparities);
  const auto small_step = hn::Set(d8, static_cast<std::uint8_t>(std::min(row.small_step, 255)));
  const std::uint8_t* large_step = row.large_step->data();
  const std::uint8_t* gray = row.gray;
  const std::uint8_t* gray_before = row.gray_before;
  const std::uint8_t* costs = row.costs;
  for (std::ptrdiff_t x = x0; x < x1; ++x) {
    const auto lowest = hn::Set(d8, least[x]);
    const int change = std::abs(gray[x] - gray_before[x]);
    const StepCosts steps = {small_step, lowest,
                             hn::SaturatedAdd(lowest, hn::Set(d8, large_step[change]))};
    least[x] = hn::GetLane(step_vectors<kVectors>(window, costs + x * lanes, before + x * lanes,
                                                  steps, paths + x * lanes));
  }
}

void continue_columns(const ColumnStep& of_row, std::uint8_t* before, std::uint8_t* paths,
                      std::uint8_t* least) {
  // A copy: the compiler knows that no store of bytes changes it.
  const ColumnStep row = of_row;
  const std::ptrdiff_t lanes = cost_lanes(row.disparities);
  for (int x0 = 0; x0 < row.width; x0 += kWindowTile) {
    const int x1 = std::min(x0 + kWindowTile, row.width);
    const CostWindow window = window_at(row.windows, static_cast<int>(lanes), x0);
    const CostWindow last = window_at(row.windows_before, static_cast<int>(lanes), x0);
    for (int x = x0; x < x1 && last != window; ++x) {
      extend_lanes(last, window, before + x * lanes);
    }
    with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      continue_tile<kVectors>(row, window, x0, x1, before, paths, least);
    });
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(begin_columns);
HWY_EXPORT(continue_columns);

void step_columns(const ColumnStep& row, std::uint8_t* before, std::uint8_t* paths,
                  std::uint8_t* least) {
  if (before == nullptr) {
    HWY_DYNAMIC_DISPATCH(begin_columns)(row, paths, least);
  } else {
    HWY_DYNAMIC_DISPATCH(continue_columns)(row, before, paths, least);
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/column_optimization.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
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
  const std::uint8_t* costs = row.costs;
  for (int x = 0; x < row.width; ++x) {
    auto lowest = hn::Set(d8, 255);
    const int size = window_at(row.windows, cost_lanes(row.disparities), x).size();
    for (int i = 0; i < size; i += static_cast<int>(hn::Lanes(d8))) {
      const auto cost = hn::LoadU(d8, costs + i);
      hn::StoreU(cost, d8, paths + i);
      lowest = hn::Min(lowest, cost);
    }
    least[x] = least_lane(d8, lowest);
    costs += size;
    paths += size;
  }
}

/// Advances the paths of the columns x0 .. x1 - 1, whose cells begin at `cell`.
template <int kVectors>
HWY_INLINE void continue_tile(const ColumnStep& row, int size, int x0, int x1, std::ptrdiff_t cell,
                              const std::uint8_t* before, std::uint8_t* paths,
                              std::uint8_t* least) {
  const Bytes d8;
  const auto small_step = hn::Set(d8, static_cast<std::uint8_t>(std::min(row.small_step, 255)));
  const std::uint8_t* large_steps = row.large_steps;
  const std::uint8_t* costs = row.costs;
  for (int x = x0; x < x1; ++x, cell += size) {
    const auto lowest = hn::Set(d8, least[x]);
    const StepCosts steps = {small_step, lowest,
                             hn::SaturatedAdd(lowest, hn::Set(d8, large_steps[x]))};
    least[x] = step_vectors<kVectors>(size, costs + cell, before + cell, steps, paths + cell);
  }
}

void continue_columns(const ColumnStep& of_row, const std::uint8_t* before, std::uint8_t* paths,
                      std::uint8_t* least) {
  // A copy: the compiler knows that no store of bytes changes it.
  const ColumnStep row = of_row;
  std::ptrdiff_t cell = 0;
  for (int x0 = 0; x0 < row.width; x0 += kWindowTile) {
    const int x1 = std::min(x0 + kWindowTile, row.width);
    const CostWindow window = window_at(row.windows, cost_lanes(row.disparities), x0);
    with_vectors<Bytes>(window, [&]<int kVectors>(std::integral_constant<int, kVectors>) HWY_ATTR {
      continue_tile<kVectors>(row, window.size(), x0, x1, cell, before, paths, least);
    });
    cell += std::ptrdiff_t{x1 - x0} * window.size();
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(begin_columns);
HWY_EXPORT(continue_columns);

void move_columns(const CostWindow* from, const CostWindow* to, int lanes, int width,
                  const std::uint8_t* paths, std::uint8_t* moved) {
  for (int x = 0; x < width; ++x) {
    const CostWindow before = window_at(from, lanes, x), next = window_at(to, lanes, x);
    for (int d = next.begin; d < next.end; d += kWindowStep, moved += kWindowStep) {
      if (before.begin <= d && d < before.end) {
        std::memcpy(moved, paths + (d - before.begin), kWindowStep);
      } else {
        std::memset(moved, 255, kWindowStep);
      }
    }
    paths += before.size();
  }
}

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

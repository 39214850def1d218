// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/column_optimization.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/disparity_selection.hpp"
#include "reference/pixels/path_matching.hpp"
#include "stages/pixels/smoothness.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo::column_optimization_test {
namespace {

using reference::RowCosts;

/// Rows of random costs and gray values.
struct Rows {
  Rows(int width, int disparities, int count, std::uint64_t seed) {
    Random random(seed);
    for (int y = 0; y < count; ++y) {
      costs.emplace_back(width, std::vector<int>(disparities));
      gray.emplace_back(width);
      for (std::vector<int>& pixel : costs.back()) {
        for (int& cost : pixel) cost = random.below(4) == 0 ? 0 : random.below(256);
      }
      for (std::uint8_t& value : gray.back()) {
        value = static_cast<std::uint8_t>(random.below(2) == 0 ? random.below(256) : 90);
      }
    }
  }
  std::vector<RowCosts> costs;
  std::vector<std::vector<std::uint8_t>> gray;
};

/// Follows the paths downwards; each row's costs overwrite those of the row before, or not.
std::vector<RowCosts> walked(const Rows& rows, const SmoothnessOptions& options, bool in_place,
                             const SearchWindows& windows = {}) {
  const int width = static_cast<int>(rows.costs[0].size());
  const int disparities = static_cast<int>(rows.costs[0][0].size());
  const int lanes = cost_lanes(disparities);
  const std::size_t cells = static_cast<std::size_t>(width) * lanes;
  Buffer<std::uint8_t> paths, moved, least, large_steps;
  paths.resize(2 * cells);
  moved.resize(cells);
  least.resize(width);
  large_steps.resize(width);
  std::vector<RowCosts> out;
  const std::uint8_t* before = nullptr;
  for (std::size_t y = 0; y < rows.costs.size(); ++y) {
    const std::size_t last = y == 0 ? 0 : y - 1;
    const CostWindow* own = windows.row(static_cast<int>(y));
    const CostWindow* of_last = windows.row(static_cast<int>(last));
    const Buffer<std::uint8_t> costs = test::cells_of(rows.costs[y], own);
    if (own != of_last) {
      move_columns(of_last, own, lanes, width, before, moved.data());
      before = moved.data();
    }
    find_large_steps(options, rows.gray[y].data(), rows.gray[last].data(), width,
                     large_steps.data());
    const ColumnStep step = {costs.data(), large_steps.data(), width,
                             disparities,  options.small_step, own};
    std::uint8_t* to = paths.data() + (in_place ? 0 : y % 2 * cells);
    step_columns(step, before, to, least.data());
    before = to;
    out.push_back(test::costs_of(to, own, width, disparities));
    for (int x = 0; x < width; ++x) {
      const int best = reference::first_least(out[y][x]);
      if (best < 0) continue;
      EXPECT_EQ(least[x], out[y][x][best]);
    }
  }
  return out;
}

void expect_reference(int width, int disparities, const SmoothnessOptions& options) {
  const Rows rows(width, disparities, 6, 100 * width + disparities);
  const std::vector<RowCosts> in_place = walked(rows, options, true);
  EXPECT_EQ(in_place, walked(rows, options, false)) << "the rows are written in place or not";
  RowCosts expected;
  for (std::size_t y = 0; y < rows.costs.size(); ++y) {
    expected = reference::column_step(rows.costs[y], expected, rows.gray[y].data(),
                                      rows.gray[y == 0 ? 0 : y - 1].data(), options);
    EXPECT_EQ(expected, in_place[y])
        << "row " << y << ", width " << width << ", " << disparities << " disparities, P1 "
        << options.small_step << ", P2 " << options.large_step;
  }
}

/// Rows of several tiles, in windows.
void expect_reference_in_windows(int width, int disparities, const SmoothnessOptions& options,
                                 Random& random) {
  Rows rows(width, disparities, 40, 100 * width + disparities);
  const SearchWindows windows = test::random_windows(width, 40, cost_lanes(disparities), random);
  const reference::Windows copy = test::copy_of(windows, width, 40);
  for (int y = 0; y < 40; ++y) reference::leave_out(copy, y, rows.costs[y]);
  const std::vector<RowCosts> in_place = walked(rows, options, true, windows);
  EXPECT_EQ(in_place, walked(rows, options, false, windows)) << "the rows are written in place";
  RowCosts expected;
  for (int y = 0; y < 40; ++y) {
    expected = reference::column_step(rows.costs[y], expected, rows.gray[y].data(),
                                      rows.gray[std::max(y - 1, 0)].data(), options);
    EXPECT_EQ(expected, in_place[y]) << "row " << y << ", width " << width << ", " << disparities
                                     << " disparities, P1 " << options.small_step;
  }
}

constexpr SmoothnessOptions kSteps[] = {{0, 0}, {4, 0}, {4, 30}, {15, 90}, {250, 250}, {300, 300}};

TEST(ColumnOptimization, EqualsReferenceForEveryNumberOfDisparitiesOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int disparities = 1; disparities <= 70; ++disparities) {
      for (const SmoothnessOptions& steps : kSteps) {
        expect_reference(1 + disparities % 9, disparities, steps);
      }
    }
    for (const int disparities : {200, 1023, 1984}) expect_reference(5, disparities, {15, 90});
  });
}

TEST(ColumnOptimization, EqualsReferenceInWindowsOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    Random random(1);
    for (int i = 0; i < 40; ++i) {
      // Windows without any disparity below D have no least cost, so D fills its lanes.
      expect_reference_in_windows(random.between(1, 60), 32 * random.between(1, 8),
                                  kSteps[i % std::size(kSteps)], random);
    }
  });
}

TEST(ColumnOptimization, TreatsColumnsApart) {
  const SmoothnessOptions options = {5, 30};
  Rows rows(9, 20, 8, 1);
  const std::vector<RowCosts> before = walked(rows, options, true);
  for (RowCosts& row : rows.costs) std::fill(row[4].begin(), row[4].end(), 7);
  const std::vector<RowCosts> after = walked(rows, options, true);
  for (std::size_t y = 0; y < before.size(); ++y) {
    for (int x = 0; x < 9; ++x) {
      if (x == 4) continue;
      EXPECT_EQ(before[y][x], after[y][x]) << "column " << x << ", row " << y;
    }
  }
}

}  // namespace
}  // namespace mtstereo::column_optimization_test

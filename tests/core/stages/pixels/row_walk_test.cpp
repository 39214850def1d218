// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/row_walk.hpp"

#include <gtest/gtest.h>

#include <array>

#include "reference/pixels/disparity_selection.hpp"
#include "reference/pixels/row_walk.hpp"
#include "stages/pixels/census_cost.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo::row_walk_test {
namespace {

using reference::RowCosts;
using reference::Selected;

/// A row of random costs in which 0 and `largest` occur often; 255 is the end of the scale.
RowCosts random_costs(int width, int disparities, int largest, Random& random) {
  RowCosts costs(width, std::vector<int>(disparities));
  for (std::vector<int>& pixel : costs) {
    for (int& cost : pixel) {
      const int kind = random.below(8);
      cost = kind == 0 ? 0 : kind == 1 ? largest : random.below(largest + 1);
    }
  }
  return costs;
}

/// Gray values with flat areas, small steps and the largest step.
std::vector<std::uint8_t> random_gray(int width, Random& random) {
  std::vector<std::uint8_t> gray(width);
  int value = random.below(256);
  for (std::uint8_t& pixel : gray) {
    const int kind = random.below(6);
    if (kind == 0) value = random.below(256);
    if (kind == 1) value = 255 * random.below(2);
    if (kind == 2) value = std::clamp(value + random.between(-3, 3), 0, 255);
    pixel = static_cast<std::uint8_t>(value);
  }
  return gray;
}

/// Rows and the costs of the paths along their columns.
struct Rows {
  RowCosts costs[kWalkedRows], above[kWalkedRows], below[kWalkedRows];
  std::vector<std::uint8_t> gray[kWalkedRows];
};

Rows random_rows(int width, int disparities, int largest, Random& random) {
  Rows rows;
  for (int r = 0; r < kWalkedRows; ++r) {
    rows.costs[r] = random_costs(width, disparities, largest, random);
    rows.above[r] = random_costs(width, disparities, 255, random);
    rows.below[r] = random_costs(width, disparities, 255, random);
    rows.gray[r] = random_gray(width, random);
  }
  return rows;
}

/// What the rows are matched with.
struct Setting {
  SmoothnessOptions steps;
  PathSums sums;
  SelectionOptions selection;
  const CostWindow* windows = nullptr;
};

/// Memory of earlier rows.
struct Scratch {
  RowWalkScratch walk;
  Candidates candidates[kWalkedRows];
};

/// The cells of each row: its costs, and those of the paths from above and below.
using RowCells = std::array<std::array<Buffer<std::uint8_t>, 3>, kWalkedRows>;

RowCells cells_of(const Rows& rows, const CostWindow* windows) {
  RowCells cells;
  for (std::size_t r = 0; r < kWalkedRows; ++r) {
    cells[r] = {test::cells_of(rows.costs[r], windows), test::cells_of(rows.above[r], windows),
                test::cells_of(rows.below[r], windows)};
  }
  return cells;
}

/// Matches the first rows. The last of them stands for those that are missing.
std::vector<Selected> matched(const Rows& rows, const RowCells& cells, const Setting& setting,
                              int count, Scratch& scratch) {
  const int width = static_cast<int>(rows.costs[0].size());
  const int disparities = setting.selection.disparities;
  const std::vector<std::uint16_t> low(width, 0);
  const std::vector<std::uint16_t> high(width, static_cast<std::uint16_t>(disparities - 1));
  WalkedRows walked = {{}, width, setting.steps, setting.windows, setting.sums};
  scratch.walk.resize(width, disparities);
  for (int r = 0; r < kWalkedRows; ++r) {
    const int from = std::min(r, count - 1);
    scratch.candidates[r].resize(width, disparities);
    walked.of[r] = {cells[from][0].data(),
                    rows.gray[from].data(),
                    cells[from][1].data(),
                    cells[from][2].data(),
                    low.data(),
                    high.data(),
                    &scratch.candidates[from]};
  }
  match_walked_rows(walked, setting.selection, scratch.walk);
  std::vector<Selected> out;
  for (int r = 0; r < count; ++r) {
    std::vector<std::int32_t> disparity(width);
    std::vector<std::uint8_t> ratio(width);
    finish_selection(width, setting.selection, runner_up_table(setting.selection.confidence),
                     low.data(), high.data(), scratch.candidates[r], disparity.data(),
                     ratio.data());
    for (int x = 0; x < width; ++x) out.push_back({disparity[x], ratio[x]});
  }
  return out;
}

std::vector<Selected> reference_of(const Rows& rows, const Setting& setting) {
  std::vector<Selected> out;
  for (int r = 0; r < kWalkedRows; ++r) {
    const RowCosts sums = reference::path_sums(rows.costs[r], rows.gray[r].data(), setting.steps,
                                               setting.sums, rows.above[r], rows.below[r]);
    const std::vector<int> low(sums.size(), 0);
    const std::vector<int> high(sums.size(), setting.selection.disparities - 1);
    const auto row = reference::select_disparities(sums, setting.selection, low, high);
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

testing::AssertionResult same_pixels(const std::vector<Selected>& expected,
                                     const std::vector<Selected>& actual) {
  const auto value = [](const std::vector<Selected>& pixels) {
    return [&pixels](int x, int y) { return y == 0 ? pixels[x].disparity : pixels[x].ratio; };
  };
  return test::same_pixels(static_cast<int>(actual.size()), 2, value(expected), value(actual));
}

/// On every instruction set; the reference, which takes longest, once. Returns the number of
/// disparities.
long expect_reference(const Rows& rows, const Setting& setting, Scratch& scratch) {
  const std::vector<Selected> expected = reference_of(rows, setting);
  const RowCells cells = cells_of(rows, setting.windows);
  test::for_each_simd_target([&] {
    for (const int count : {kWalkedRows, 3, 1}) {
      EXPECT_TRUE(same_pixels(expected, matched(rows, cells, setting, count, scratch)))
          << "disparities (row 0) and ratios (row 1), D " << setting.selection.disparities
          << ", P1 " << setting.steps.small_step << ", P2 " << setting.steps.large_step << ", sums "
          << static_cast<int>(setting.sums) << ", rows " << count;
    }
  });
  return std::count_if(expected.begin(), expected.end(),
                       [](const Selected& pixel) { return pixel.disparity != 0; });
}

Setting random_setting(int disparities, const SmoothnessOptions& steps, Random& random) {
  return {steps,
          static_cast<PathSums>(random.below(2)),
          {disparities, 0.06 * random.below(2), false, random.between(-1, 2), random.below(2) == 0,
           random.below(50)}};
}

constexpr SmoothnessOptions kSteps[] = {{0, 0},   {0, 1},   {1, 0},    {4, 0},     {4, 30},
                                        {20, 20}, {30, 4},  {20, 150}, {250, 250}, {0, 250},
                                        {250, 0}, {255, 1}, {300, 20}, {300, 300}};

long expect_reference_of_random(int width, int disparities, int largest,
                                const SmoothnessOptions& steps, Random& random, Scratch& scratch) {
  const Rows rows = random_rows(width, disparities, largest, random);
  return expect_reference(rows, random_setting(disparities, steps, random), scratch);
}

TEST(RowWalk, EqualsReferenceForEveryNumberOfDisparitiesOnEveryInstructionSet) {
  Scratch scratch;
  long known = 0;
  for (int disparities = 1; disparities <= 70; ++disparities) {
    Random random(disparities);
    for (const SmoothnessOptions& steps : kSteps) {
      known += expect_reference_of_random(random.between(1, 2 * disparities), disparities,
                                          disparities % 2 == 0 ? 255 : 60, steps, random, scratch);
    }
  }
  for (const int disparities : {96, 128, 200, 224, 1023, 1984}) {
    Random random(disparities);
    known += expect_reference_of_random(disparities + 5, disparities, 60, {4, 30}, random, scratch);
    known += expect_reference_of_random(30, disparities, 100, {20, 150}, random, scratch);
  }
  EXPECT_GT(known, 1000) << "too few results to compare";
}

TEST(RowWalk, EqualsReferenceAtEveryWidth) {
  Scratch scratch;
  for (int width = 1; width <= 70; ++width) {
    Random random(width);
    expect_reference_of_random(width, 33, 60, {20, 50}, random, scratch);
    expect_reference_of_random(width, 7, 255, {20, 150}, random, scratch);
  }
}

TEST(RowWalk, EqualsReferenceInWindowsOnEveryInstructionSet) {
  Scratch scratch;
  Random random(1);
  long known = 0;
  for (int i = 0; i < 100; ++i) {
    const int width = random.between(1, 200), disparities = 32 * random.between(1, 8);
    const SearchWindows windows = test::random_windows(width, 1, disparities, random);
    Rows rows = random_rows(width, disparities, 60, random);
    for (RowCosts& costs : rows.costs) {
      reference::leave_out(test::copy_of(windows, width, 1), 0, costs);
    }
    Setting setting = random_setting(disparities, kSteps[i % std::size(kSteps)], random);
    setting.windows = windows.row(0);
    known += expect_reference(rows, setting, scratch);
  }
  EXPECT_GT(known, 500) << "too few results to compare";
}

TEST(RowWalk, PrefersTheDisparityOfTheNeighbors) {
  // All pixels have disparity 10; one pixel costs slightly less at another one.
  Rows rows = {};
  for (int r = 0; r < kWalkedRows; ++r) {
    rows.costs[r] = RowCosts(61, std::vector<int>(30, 50));
    for (std::vector<int>& pixel : rows.costs[r]) pixel[10] = 0;
    rows.costs[r][40][10] = 20;
    rows.costs[r][40][25] = 10;
    rows.above[r] = rows.below[r] = rows.costs[r];
    rows.gray[r].assign(61, 100);
  }
  Scratch scratch;
  const auto best = [&](int large) {
    const Setting setting = {{4, large}, PathSums::kTwo, {30, 0, false, -1, false, 0}};
    return matched(rows, cells_of(rows, nullptr), setting, kWalkedRows, scratch)[40].disparity /
           256;
  };
  EXPECT_EQ(10, best(30));
  EXPECT_EQ(25, best(0)) << "the optimization is disabled";
  rows.gray[0][40] = 250;
  EXPECT_EQ(25, best(30)) << "the large penalty must decrease with the change of the gray value";
}

}  // namespace
}  // namespace mtstereo::row_walk_test

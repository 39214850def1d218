// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/scanline_optimization.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/scanline_optimization.hpp"
#include "stages/pixels/census_cost.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo {
namespace {

using reference::RowCosts;
using test::Random;

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

/// The sums of a row, with `scratch` from an earlier row.
RowCosts optimized(const RowCosts& costs, const std::vector<std::uint8_t>& gray,
                   const SmoothnessOptions& options, ScanlineScratch& scratch,
                   const CostWindow* windows = nullptr) {
  const int width = static_cast<int>(costs.size());
  const int disparities = static_cast<int>(costs[0].size());
  const int lanes = cost_lanes(disparities);
  Buffer<std::uint8_t> cells;
  cells.resize(static_cast<std::size_t>(width) * lanes);
  std::fill_n(cells.data(), cells.size(), std::uint8_t{kCensusNever});
  for (int x = 0; x < width; ++x) {
    for (int d = 0; d < disparities; ++d) {
      // Outside of the window a cost that would be the least.
      cells[static_cast<std::size_t>(x) * lanes + d] =
          static_cast<std::uint8_t>(std::max(costs[x][d], 0));
    }
  }
  scratch.resize(width, disparities);
  const LargeStepTable large_step = large_step_table(options);
  const ScanlineRow row = {cells.data(),       gray.data(), width, disparities,
                           options.small_step, &large_step, {},    windows};
  RowCosts out(width);
  start_scanline(row, scratch);
  for (int block = 0; block < scanline_blocks(width); ++block) {
    for (const ScanlineSums& part : scanline_block(row, block, scratch)) {
      for (int x = part.begin; x < part.end; ++x) {
        EXPECT_TRUE(out[x].empty()) << "column " << x << " occurs twice";
        const std::uint16_t* first =
            part.sums + static_cast<std::ptrdiff_t>(x - part.begin) * lanes;
        out[x].assign(first, first + disparities);
      }
    }
  }
  for (const std::vector<int>& pixel : out) EXPECT_FALSE(pixel.empty()) << "a column is missing";
  return out;
}

testing::AssertionResult same_costs(const RowCosts& expected, const RowCosts& actual) {
  return test::same_pixels(
      static_cast<int>(expected[0].size()), static_cast<int>(expected.size()),
      [&](int d, int x) { return expected[x][d]; }, [&](int d, int x) { return actual[x][d]; });
}

void expect_reference(int width, int disparities, int largest, const SmoothnessOptions& options,
                      Random& random, ScanlineScratch& scratch) {
  const RowCosts costs = random_costs(width, disparities, largest, random);
  const std::vector<std::uint8_t> gray = random_gray(width, random);
  EXPECT_TRUE(same_costs(reference::optimize_scanline(costs, gray.data(), options),
                         optimized(costs, gray, options, scratch)))
      << "cells (disparity, column), costs up to " << largest << ", P1 " << options.small_step
      << ", P2 " << options.large_step;
}

void expect_reference_in_windows(int width, int disparities, const SmoothnessOptions& options,
                                 Random& random, ScanlineScratch& scratch) {
  const SearchWindows windows = test::random_windows(width, 1, cost_lanes(disparities), random);
  const reference::Windows copy = test::copy_of(windows, width, 1);
  RowCosts costs = random_costs(width, disparities, 120, random);
  reference::leave_out(copy, 0, costs);
  const std::vector<std::uint8_t> gray = random_gray(width, random);
  RowCosts actual = optimized(costs, gray, options, scratch, windows.row(0));
  reference::leave_out(copy, 0, actual);
  EXPECT_TRUE(same_costs(reference::optimize_scanline(costs, gray.data(), options), actual))
      << "cells (disparity, column), P1 " << options.small_step << ", P2 " << options.large_step;
}

constexpr SmoothnessOptions kSteps[] = {{0, 0},   {0, 1},   {1, 0},    {4, 0},     {4, 30},
                                        {20, 20}, {30, 4},  {20, 150}, {250, 250}, {0, 250},
                                        {250, 0}, {255, 1}, {300, 20}, {300, 300}};

TEST(ScanlineOptimization, EqualsReferenceForEveryNumberOfDisparitiesOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    ScanlineScratch scratch;
    for (int disparities = 1; disparities <= 70; ++disparities) {
      Random random(disparities);
      for (const SmoothnessOptions& steps : kSteps) {
        expect_reference(random.between(1, 40), disparities, disparities % 2 == 0 ? 255 : 60, steps,
                         random, scratch);
      }
    }
    for (const int disparities : {200, 224, 1023, 1984}) {
      Random random(disparities);
      expect_reference(30, disparities, 255, {4, 30}, random, scratch);
      expect_reference(30, disparities, 100, {20, 150}, random, scratch);
    }
  });
}

TEST(ScanlineOptimization, EqualsReferenceAtEveryWidth) {
  ScanlineScratch scratch;
  for (int width = 1; width <= 70; ++width) {
    Random random(width);
    expect_reference(width, 33, 120, {20, 150}, random, scratch);
    expect_reference(width, 7, 255, {20, 150}, random, scratch);
  }
}

TEST(ScanlineOptimization, EqualsReferenceInWindowsOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    ScanlineScratch scratch;
    Random random(1);
    for (int i = 0; i < 200; ++i) {
      expect_reference_in_windows(random.between(1, 200), 32 * random.between(1, 8),
                                  kSteps[i % std::size(kSteps)], random, scratch);
    }
  });
}

TEST(ScanlineOptimization, IsTwiceTheCostsForEqualCosts) {
  ScanlineScratch scratch;
  for (const int cost : {0, 254, 255}) {
    for (const SmoothnessOptions& steps : kSteps) {
      const RowCosts costs(20, std::vector<int>(40, cost));
      const std::vector<std::uint8_t> gray(20, 90);
      EXPECT_TRUE(same_costs(RowCosts(20, std::vector<int>(40, 2 * cost)),
                             optimized(costs, gray, steps, scratch)))
          << "equal costs must stay equal";
    }
  }
}

TEST(ScanlineOptimization, IsTwiceTheCostsWithoutStepPenalties) {
  ScanlineScratch scratch;
  Random random(1);
  const RowCosts costs = random_costs(50, 45, 255, random);
  RowCosts twice = costs;
  for (std::vector<int>& pixel : twice) {
    for (int& cost : pixel) cost *= 2;
  }
  for (const SmoothnessOptions& off : {SmoothnessOptions{0, 0}, {4, 0}, {0, 1}}) {
    // A large step penalty of 1 becomes 0 at changes of the gray value.
    const std::vector<std::uint8_t> gray = [&] {
      std::vector<std::uint8_t> stripes(50);
      for (int x = 0; x < 50; ++x) stripes[x] = static_cast<std::uint8_t>(x % 2 * 9);
      return stripes;
    }();
    EXPECT_TRUE(same_costs(twice, optimized(costs, gray, off, scratch))) << off.small_step;
  }
}

TEST(ScanlineOptimization, PrefersTheDisparityOfTheNeighbors) {
  // All pixels have disparity 10; the middle pixel costs slightly less at another one.
  RowCosts costs(21, std::vector<int>(30, 50));
  for (std::vector<int>& pixel : costs) pixel[10] = 0;
  costs[10][10] = 20;
  costs[10][25] = 10;
  ScanlineScratch scratch;
  const auto best = [&](const std::vector<std::uint8_t>& gray, int large) {
    const RowCosts sums = optimized(costs, gray, {4, large}, scratch);
    return std::min_element(sums[10].begin(), sums[10].end()) - sums[10].begin();
  };
  std::vector<std::uint8_t> gray(21, 100);
  EXPECT_EQ(10, best(gray, 30));
  EXPECT_EQ(25, best(gray, 0)) << "the optimization is disabled";
  gray[10] = 250;
  EXPECT_EQ(25, best(gray, 30))
      << "the large penalty must decrease with the change of the gray value";
}

TEST(ScanlineOptimization, LargeStepDecreasesWithTheGrayChangeDownToTheSmallStep) {
  for (const SmoothnessOptions& steps : kSteps) {
    const LargeStepTable table = large_step_table(steps);
    for (int change = 0; change < 256; ++change) {
      EXPECT_EQ(reference::large_step(steps, change), table[change])
          << "P1 " << steps.small_step << ", P2 " << steps.large_step << ", change " << change;
    }
  }
  const LargeStepTable table = large_step_table({4, 30});
  EXPECT_EQ(30, table[0]);
  EXPECT_EQ(15, table[8]);
  EXPECT_EQ(4, table[255]);
}

}  // namespace
}  // namespace mtstereo

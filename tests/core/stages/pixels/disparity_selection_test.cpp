// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/disparity_selection.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/disparity_selection.hpp"
#include "reference/pixels/row_walk.hpp"
#include "stages/pixels/row_walk.hpp"
#include "support/compare.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo::disparity_selection_test {
namespace {

using reference::RowCosts;
using reference::Selected;

/// The expected disparities of each pixel of a row; none if low > high.
struct Ranges {
  std::vector<std::uint16_t> low, high;
};

Ranges all_expected(int width, int disparities) {
  return {std::vector<std::uint16_t>(width, 0),
          std::vector<std::uint16_t>(width, static_cast<std::uint16_t>(disparities - 1))};
}

Ranges random_ranges(int width, int disparities, Random& random) {
  Ranges ranges = all_expected(width, disparities);
  for (int x = 0; x < width; ++x) {
    const int kind = random.below(8);
    if (kind < 3) continue;
    const int low = kind == 3 ? 1 : random.below(disparities);
    const int high = kind == 3 ? 0 : random.between(low, disparities - 1);
    ranges.low[x] = static_cast<std::uint16_t>(low);
    ranges.high[x] = static_cast<std::uint16_t>(high);
  }
  return ranges;
}

/// Costs with many equal ones, and with a best disparity that often continues from pixel to pixel,
/// so that the right view sometimes agrees.
RowCosts random_costs(int width, int disparities, int largest, Random& random) {
  RowCosts costs(width, std::vector<int>(disparities));
  int best = random.below(disparities);
  for (std::vector<int>& pixel : costs) {
    for (int& cost : pixel) cost = random.below(largest + 1);
    if (random.below(8) == 0) best = random.below(disparities);
    if (random.below(4) == 0) best = std::clamp(best + random.between(-1, 1), 0, disparities - 1);
    pixel[best] /= 16;
  }
  return costs;
}

/// Memory of earlier rows.
struct Scratch {
  RowWalkScratch walk;
  Candidates candidates;
};

/// Selects one row by its costs.
std::vector<Selected> selected(const RowCosts& costs, const SelectionOptions& options,
                               const Ranges& ranges, Scratch& scratch,
                               const CostWindow* windows = nullptr) {
  const int width = static_cast<int>(costs.size());
  const Buffer<std::uint8_t> cells = test::cells_of(costs, windows);
  std::vector<std::int32_t> disparity(width, -77);
  std::vector<std::uint8_t> ratio(width, 77);
  scratch.walk.resize(width, options.disparities);
  scratch.candidates.resize(width, options.disparities);
  const PathRow row = {
      cells.data(),       nullptr, nullptr, nullptr, ranges.low.data(), ranges.high.data(),
      &scratch.candidates};
  match_row_by_cost({{row}, width, {}, windows, PathSums::kTwo}, 0, options, scratch.walk);
  finish_selection(width, options, runner_up_table(options.confidence), ranges.low.data(),
                   ranges.high.data(), scratch.candidates, disparity.data(), ratio.data());
  std::vector<Selected> out;
  for (int x = 0; x < width; ++x) out.push_back({disparity[x], ratio[x]});
  return out;
}

/// Compares disparities and peak ratios on every instruction set; the reference, which takes
/// longest, is computed once. Returns the number of disparities.
long expect_reference(const RowCosts& costs, const SelectionOptions& options, const Ranges& ranges,
                      Scratch& scratch, const CostWindow* windows = nullptr) {
  const std::vector<Selected> expected =
      reference::select_disparities(reference::twice(costs), options, ranges.low, ranges.high);
  const auto value = [](const std::vector<Selected>& row) {
    return [&row](int x, int y) { return y == 0 ? row[x].disparity : row[x].ratio; };
  };
  test::for_each_simd_target([&] {
    const std::vector<Selected> actual = selected(costs, options, ranges, scratch, windows);
    const int width = static_cast<int>(costs.size());
    EXPECT_TRUE(test::same_pixels(width, 2, value(expected), value(actual)))
        << "disparities (row 0) and ratios (row 1), D " << options.disparities << ", confidence "
        << options.confidence << ", runner-up in range " << options.runner_up_in_range
        << ", tolerance " << options.left_right_tolerance << ", subpixel " << options.subpixel;
  });
  return std::count_if(expected.begin(), expected.end(),
                       [](const Selected& pixel) { return pixel.disparity != 0; });
}

/// All combinations of options on random rows of this size.
long expect_reference_with_all_options(int width, int disparities, Random& random,
                                       Scratch& scratch) {
  long known = 0;
  for (const double confidence : {0.0, 0.06, 1.0}) {
    for (const bool in_range : {false, true}) {
      for (const int tolerance : {-1, 0, 1}) {
        const int largest = random.below(3) == 0 ? 12 : 255;
        known += expect_reference(random_costs(width, disparities, largest, random),
                                  {disparities, confidence, in_range, tolerance,
                                   random.below(2) == 0, random.below(50), random.between(-1, 3)},
                                  random_ranges(width, disparities, random), scratch);
      }
    }
  }
  return known;
}

TEST(DisparitySelection, EqualsReferenceInWindowsOnEveryInstructionSet) {
  Scratch scratch;
  Random random(1);
  long known = 0;
  for (int i = 0; i < 150; ++i) {
    const int width = random.between(1, 300), disparities = random.between(1, 400);
    const SearchWindows windows = test::random_windows(width, 1, cost_lanes(disparities), random);
    RowCosts costs = random_costs(width, disparities, 255, random);
    reference::leave_out(test::copy_of(windows, width, 1), 0, costs);
    known += expect_reference(
        costs, {disparities, 0.06, i % 2 == 0, random.between(-1, 1), i % 3 > 0, random.below(50)},
        random_ranges(width, disparities, random), scratch, windows.row(0));
  }
  EXPECT_GT(known, 500);
}

TEST(DisparitySelection, EqualsReferenceForEveryNumberOfDisparitiesOnEveryInstructionSet) {
  long known = 0;
  Scratch scratch;
  for (int disparities = 1; disparities <= 70; ++disparities) {
    Random random(disparities);
    known += expect_reference_with_all_options(disparities + random.below(60), disparities, random,
                                               scratch);
  }
  Random random(300);
  known += expect_reference_with_all_options(305, 300, random, scratch);
  // Two rows of the largest number; all options would take seconds.
  for (const bool in_range : {false, true}) {
    known += expect_reference(random_costs(1989, 1984, 255, random),
                              {1984, 0.06, in_range, in_range ? 1 : -1, in_range, 30, 1},
                              random_ranges(1989, 1984, random), scratch);
  }
  EXPECT_GT(known, 10000) << "too few results to compare";
}

TEST(DisparitySelection, EqualsReferenceAtEveryWidth) {
  Scratch scratch;
  for (int width = 1; width <= 70; ++width) {
    Random random(width);
    expect_reference_with_all_options(width, random.between(1, width), random, scratch);
  }
}

TEST(DisparitySelection, EqualsReferenceForEqualCosts) {
  Scratch scratch;
  for (const int cost : {0, 1, 255}) {
    const RowCosts costs(60, std::vector<int>(40, cost));
    for (const int tolerance : {-1, 0}) {
      EXPECT_EQ(0, expect_reference(costs, {40, 0, false, tolerance, true, 0}, all_expected(60, 40),
                                    scratch))
          << "equal costs have no best disparity";
    }
  }
}

/// A row of 60 px in which pixel 50 has these costs and all other pixels have equal ones.
struct OnePixel {
  explicit OnePixel(const std::vector<int>& pixel)
      : disparities(static_cast<int>(pixel.size())), costs(60, std::vector<int>(disparities, 250)) {
    costs[50] = pixel;
  }
  Selected select(double confidence, bool in_range = false, int low = 0, int high = 39,
                  int tolerance = -1, bool subpixel = false) const {
    Ranges ranges = all_expected(60, disparities);
    ranges.low[50] = static_cast<std::uint16_t>(low);
    ranges.high[50] = static_cast<std::uint16_t>(high);
    Scratch scratch;
    return selected(costs, {disparities, confidence, in_range, tolerance, subpixel, 0}, ranges,
                    scratch)[50];
  }
  int disparities;
  RowCosts costs;
};

TEST(DisparitySelection, SelectsTheSmallestDisparityOfEqualCosts) {
  std::vector<int> costs(40, 200);
  costs[20] = costs[21] = 50;
  EXPECT_EQ(20 * 256, OnePixel(costs).select(0.5).disparity);
}

// Feature: left-right check, uniqueness, confidence threshold
TEST(DisparitySelection, RejectsADisparityWithACloseRunnerUp) {
  std::vector<int> costs(40, 200);
  costs[20] = 50;
  for (const int runner_up : {0, 18, 22, 39}) {
    std::vector<int> rival = costs;
    rival[runner_up] = 56;
    EXPECT_EQ(0, OnePixel(rival).select(0.12).disparity) << "12 % is not more than 12 %";
    EXPECT_EQ(0, OnePixel(rival).select(0.12).ratio);
    rival[runner_up] = 57;
    EXPECT_EQ(20 * 256, OnePixel(rival).select(0.12).disparity);
    EXPECT_EQ(14 * 255 / 114, OnePixel(rival).select(0.12).ratio);
  }
}

TEST(DisparitySelection, SearchesTheRunnerUpInTheGivenRange) {
  std::vector<int> costs(40, 200);
  costs[20] = 50;
  costs[30] = 51;
  EXPECT_EQ(0, OnePixel(costs).select(0.12, false, 15, 25).disparity);
  EXPECT_EQ(20 * 256, OnePixel(costs).select(0.12, true, 15, 25).disparity);
  EXPECT_EQ(0, OnePixel(costs).select(0.12, true, 15, 30).disparity)
      << "the range must include both ends";
  EXPECT_EQ(0, OnePixel(costs).select(0.12, true, 19, 21).disparity)
      << "the range has no runner-up";
}

TEST(DisparitySelection, RejectsPixelsWithoutExpectedDisparities) {
  std::vector<int> costs(40, 200);
  costs[20] = 0;
  EXPECT_EQ(255, OnePixel(costs).select(0.12).ratio);
  EXPECT_EQ(0, OnePixel(costs).select(0.12, false, 1, 0).disparity);
  EXPECT_EQ(0, OnePixel(costs).select(0.12, false, 1, 0).ratio);
}

// Feature: left-right check, uniqueness, confidence threshold
TEST(DisparitySelection, RejectsADisparityThatTheRightPixelContradicts) {
  // Right pixel 30 corresponds to left pixel 50 at 20 px and to left pixel 50 + n at 20 + n px.
  std::vector<int> costs(40, 200);
  costs[20] = 50;
  for (const int away : {1, 2}) {
    OnePixel pixel(costs);
    pixel.costs[50 + away][20 + away] = 49;
    for (const int tolerance : {0, 1, 2, 3}) {
      EXPECT_EQ(tolerance >= away ? 20 * 256 : 0,
                pixel.select(0.12, false, 0, 39, tolerance).disparity)
          << away << " px away, tolerance " << tolerance;
    }
    EXPECT_EQ(20 * 256, pixel.select(0.12, false, 0, 39, -1).disparity) << "no check";
    pixel.costs[50 + away][20 + away] = 50;
    EXPECT_EQ(20 * 256, pixel.select(0.12, false, 0, 39, 0).disparity)
        << "the first of equal costs must win";
  }
}

// Feature: sub-pixel disparities
TEST(DisparitySelection, RefinesByTwoLinesOfEqualSlopeThroughThreeCosts) {
  for (const auto& [before, after] : {std::pair{150, 150}, {100, 200}, {51, 199}, {200, 50}}) {
    std::vector<int> costs(40, 250);
    costs[19] = before;
    costs[20] = 50;
    costs[21] = after;
    // The steeper side determines the slope; the other side lies on a line of the opposite slope.
    const double slope = std::max(before, after) - 50;
    EXPECT_NEAR(256 * (20 + (before - after) / (2 * slope)),
                OnePixel(costs).select(0.12, false, 0, 39, -1, true).disparity, 1)
        << before << ", 50, " << after;
  }
}

TEST(DisparitySelection, SelectsOnlyPossibleDisparitiesAtTheBorder) {
  // Disparities beyond the left border would all cost less.
  RowCosts costs(40, std::vector<int>(40));
  for (int x = 0; x < 40; ++x) {
    for (int d = 0; d < 40; ++d) costs[x][d] = d > x ? 0 : 200 - d;
  }
  Scratch scratch;
  const auto row = selected(costs, {40, 0, false, -1, true, 0}, all_expected(40, 40), scratch);
  for (int x = 0; x < 40; ++x) {
    EXPECT_EQ(x < 2 ? 0 : 256 * x, row[x].disparity)
        << "columns 0 and 1 have too few disparities to compare";
  }
}

}  // namespace
}  // namespace mtstereo::disparity_selection_test

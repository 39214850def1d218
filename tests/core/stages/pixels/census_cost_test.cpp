// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/census_cost.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/gray_balance.hpp"
#include "reference/prepare/census.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo::census_cost_test {
namespace {

using test::CensusPair;
using test::Pair;

/// The expected disparities of each pixel of a row.
struct Ranges {
  std::vector<std::uint16_t> low, high;
};

/// Ranges of every kind: narrow, wide and all.
Ranges random_ranges(int width, int disparities, Random& random) {
  Ranges ranges;
  for (int x = 0; x < width; ++x) {
    const int low = random.below(disparities);
    const bool all = random.below(4) == 0;
    ranges.low.push_back(static_cast<std::uint16_t>(all ? 0 : low));
    ranges.high.push_back(
        static_cast<std::uint16_t>(all ? disparities - 1 : random.between(low, disparities - 1)));
  }
  return ranges;
}

Ranges all_expected(int width, int disparities) {
  return {std::vector<std::uint16_t>(width, 0),
          std::vector<std::uint16_t>(width, static_cast<std::uint16_t>(disparities - 1))};
}

/// What earlier rows leave must not matter.
void poison(CensusCostScratch& scratch) {
  for (Buffer<std::uint8_t>* part :
       {&scratch.planes, &scratch.counts, &scratch.sums, &scratch.grays}) {
    std::fill_n(part->data(), part->size(), std::uint8_t{0x5A});
  }
}

/// The costs of the rows y0 .. y1 - 1; y0 is even. What follows the cells of a row must stay as it
/// was.
std::vector<reference::RowCosts> costs_of(const CostViews& views, const CensusCostOptions& options,
                                          int y0, int y1, RowDirection direction,
                                          const Ranges& ranges, CensusCostScratch& scratch,
                                          const SearchWindows& windows = {}) {
  const int width = views.left.bits.width();
  const int lanes = cost_lanes(options.disparities);
  const bool up = direction == RowDirection::kUp;
  const int pairs = (y1 - y0 + 1) / 2;
  scratch.resize(width, options);
  poison(scratch);
  std::vector<reference::RowCosts> costs(2 * pairs);
  start_census_costs(views, windows, options, up ? y0 + 2 * pairs - 2 : y0, direction, scratch);
  for (int i = 0; i < pairs; ++i) {
    const int y = y0 + 2 * (up ? pairs - 1 - i : i);
    const std::ptrdiff_t cells = row_cells(windows.row(y), lanes, width);
    std::vector<std::uint8_t> rows[2];
    for (std::vector<std::uint8_t>& row : rows) row.assign(cells + lanes, 0xA5);
    census_cost_rows(views, windows, options, y, ranges.low.data(), ranges.high.data(), scratch,
                     rows[0].data(), rows[1].data());
    for (int r = 0; r < 2; ++r) {
      costs[y - y0 + r] = test::costs_of(rows[r].data(), windows.row(y), width, lanes);
      EXPECT_EQ(lanes, std::count(rows[r].end() - lanes, rows[r].end(), 0xA5));
    }
  }
  return costs;
}

/// A balance of a view of full resolution that differs from tile to tile, even beyond gray values.
GrayBalance random_balance(int width, int height, Random& random) {
  GrayBalance balance;
  balance.resize((width + 1) / 2, (height + 1) / 2);
  for (int y = 0; y < balance.around.height(); ++y) {
    for (int x = 0; x < balance.around.width(); ++x) {
      balance.around.row(y)[x] = static_cast<std::int16_t>(random.between(-60, 60));
    }
  }
  balance.mapping.is_identity = random.below(2) == 0;
  for (std::uint8_t& gray : balance.mapping.left_of_right) {
    gray = static_cast<std::uint8_t>(random.below(256));
  }
  return balance;
}

/// Compares every cell of the rows y0 .. y1 - 1 in both orders, with and without the cost of gray
/// values; disparities from D on must never be the least.
void expect_reference(const Pair& views, const CensusCostOptions& options, int y0, int y1,
                      const Ranges& ranges, CensusCostScratch& scratch,
                      const SearchWindows& windows = {}, bool with_gray = false) {
  if (!with_gray) expect_reference(views, options, y0, y1, ranges, scratch, windows, true);
  const CensusPair pair(views.left.view(), views.right.view());
  Random random(options.disparities);
  const GrayBalance balance = random_balance(views.left.width, views.left.height, random);
  const GrayPair gray = {views.left.view(), views.right.view(), balance};
  const CostViews input = {pair.left, pair.right, with_gray ? &gray : nullptr};
  const auto down = costs_of(input, options, y0, y1, RowDirection::kDown, ranges, scratch, windows);
  const auto up = costs_of(input, options, y0, y1, RowDirection::kUp, ranges, scratch, windows);
  test::Plane<int> differences(balance.around.width(), balance.around.height());
  const auto around = test::copy_of(balance.around);
  std::copy(around.pixels.begin(), around.pixels.end(), differences.pixels.begin());
  const GrayPlane balanced = reference::balanced(views.left, differences, 32);
  GrayPlane mapped = views.right;
  for (std::uint8_t& gray : mapped.pixels) gray = balance.mapping.of(gray);
  const reference::CensusCosts plain{reference::census(views.left), reference::census(views.right),
                                     options, with_gray ? &balanced : nullptr, &mapped};
  const int lanes = cost_lanes(options.disparities);
  const int width = views.left.width;
  const reference::Windows matched = test::copy_of(windows, width, views.left.height);
  for (int y = y0; y < y1; ++y) {
    const reference::RowCosts columns = plain.columns(y);
    const auto expected = [&](int d, int x) {
      if (!matched.contain(x, y, d)) return reference::kOutside;
      return d < options.disparities ? plain.cost(columns, x, y, d, ranges.low[x], ranges.high[x])
                                     : kCensusNever;
    };
    for (const auto* costs : {&down, &up}) {
      EXPECT_TRUE(test::same_pixels(lanes, width, expected,
                                    [&](int d, int x) { return (*costs)[y - y0][x][d]; }))
          << "cells (disparity, column) of row " << y << " of " << views.left.height << ", D "
          << options.disparities << ", window " << options.kernel_size << ", penalty "
          << options.range_penalty << (with_gray ? ", gray values" : "")
          << (costs == &up ? ", upwards" : ", downwards");
    }
  }
}

Pair noise_pair(int width, int height, std::uint64_t seed) {
  return {test::noise(width, height, seed, 40), test::noise(width, height, seed + 1, 40)};
}

TEST(CensusCost, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    CensusCostScratch scratch;
    for (int width = 1; width <= 70; ++width) {
      Random random(width);
      const int height = random.between(1, 7);
      const int disparities = random.between(1, width);
      for (const int size : {1, 3, 5}) {
        expect_reference(noise_pair(width, height, 10 * width),
                         {disparities, size, random.below(33)}, 0, height,
                         random_ranges(width, disparities, random), scratch);
      }
    }
  });
}

TEST(CensusCost, EqualsReferenceForEveryNumberOfDisparities) {
  CensusCostScratch scratch;
  for (int disparities = 1; disparities <= 70; ++disparities) {
    Random random(disparities);
    expect_reference(noise_pair(72, 4, disparities), {disparities, 5, 2}, 0, 4,
                     random_ranges(72, disparities, random), scratch);
  }
  for (const int disparities : {200, 1023, 1984}) {
    Random random(disparities);
    expect_reference(noise_pair(disparities + 1, 2, disparities), {disparities, 3, 2}, 0, 2,
                     random_ranges(disparities + 1, disparities, random), scratch);
  }
}

TEST(CensusCost, EqualsReferenceWithEveryPenalty) {
  CensusCostScratch scratch;
  for (int penalty = 0; penalty <= 32; ++penalty) {
    for (const int size : {1, 3, 5}) {
      Random random(penalty);
      expect_reference(noise_pair(40, 3, penalty), {37, size, penalty}, 0, 3,
                       random_ranges(40, 37, random), scratch);
    }
  }
}

TEST(CensusCost, DoesNotDependOnTheFirstRow) {
  constexpr int kHeight = 11;
  const Pair views = noise_pair(35, kHeight, 1);
  Random random(2);
  const Ranges ranges = random_ranges(35, 30, random);
  CensusCostScratch scratch;
  for (const int size : {1, 3, 5}) {
    for (int y0 = 0; y0 < kHeight; y0 += 2) {
      expect_reference(views, {30, size, 3}, y0, kHeight, ranges, scratch);
    }
  }
}

TEST(CensusCost, EqualsReferenceInWindowsOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    CensusCostScratch scratch;
    for (int i = 0; i < 40; ++i) {
      Random random(i);
      const int width = random.between(1, 90), height = random.between(1, 50);
      const int disparities = random.between(1, 200);
      const int y0 = random.below(height) / 2 * 2;
      expect_reference(noise_pair(width, height, i), {disparities, 2 * random.below(3) + 1, 2}, y0,
                       height, random_ranges(width, disparities, random), scratch,
                       test::random_windows(width, height, cost_lanes(disparities), random));
    }
  });
}

TEST(CensusCost, IsZeroAtDisparityZeroForAnIdenticalPair) {
  const GrayPlane image = test::noise(50, 5, 3);
  const CensusPair pair(image.view(), image.view());
  CensusCostScratch scratch;
  const auto costs = costs_of({pair.left, pair.right}, {20, 5, 2}, 0, 4, RowDirection::kDown,
                              all_expected(50, 20), scratch);
  long more = 0;
  for (const reference::RowCosts& row : costs) {
    for (int x = 0; x < 50; ++x) {
      EXPECT_EQ(0, row[x][0]) << "column " << x;
      more += row[x][7] > 0;
    }
  }
  EXPECT_GT(more, 160) << "other disparities must have a cost";
}

TEST(CensusCost, CountsAllBitsOfAllRowsForInvertedViews) {
  // Words that occur in no image: in the left view all pixels of a window are darker than its
  // center, in the right view none.
  for (const int size : {1, 3, 5}) {
    CensusImage left, right;
    left.resize(20, 6);
    right.resize(20, 6);
    for (int y = 0; y < 6; ++y) {
      std::fill_n(left.bits.row(y), 20, std::uint32_t{0xFFFFFF});
      std::fill_n(right.bits.row(y), 20, std::uint32_t{0});
    }
    CensusCostScratch scratch;
    const CensusCostOptions options = {20, size, 16};
    scratch.resize(20, options);
    std::vector<std::uint16_t> low(20, 5), high(20, 8);
    std::vector<std::uint8_t> upper(20 * 32), lower(20 * 32);
    start_census_costs({left, right}, {}, options, 0, RowDirection::kDown, scratch);
    census_cost_rows({left, right}, {}, options, 0, low.data(), high.data(), scratch, upper.data(),
                     lower.data());
    for (int d = 0; d < 20; ++d) {
      const int bits = d >= 5 && d <= 8 ? 24 : 40;
      EXPECT_EQ(bits * cost_scale(options), upper[10 * 32 + d]) << "window " << size << ", d " << d;
      EXPECT_EQ(bits * cost_scale(options), lower[10 * 32 + d]) << "window " << size << ", d " << d;
    }
  }
}

TEST(CensusCost, CountsGrayValuesUpToAMost) {
  // Flat views: the census finds no difference.
  const GrayPlane left(20, 4, 100);
  GrayBalance balance;
  balance.resize(10, 2);
  balance.around.row(0)[0] = 7;
  for (const auto& [gray, cost] :
       {std::pair(93, 0), {94, 2}, {88, 10}, {83, 20}, {0, 20}, {255, 20}}) {
    const GrayPlane right(20, 4, static_cast<std::uint8_t>(gray));
    const CensusPair pair(left.view(), right.view());
    const GrayPair grays = {left.view(), right.view(), balance};
    CensusCostScratch scratch;
    const auto costs = costs_of({pair.left, pair.right, &grays}, {20, 3, 2}, 0, 4,
                                RowDirection::kDown, all_expected(20, 20), scratch);
    for (const reference::RowCosts& row : costs) EXPECT_EQ(cost, row[10][5]) << "gray " << gray;
  }
}

}  // namespace
}  // namespace mtstereo::census_cost_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/smoothness.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "reference/pixels/row_walk.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::smoothness_test {
namespace {

using Row = std::vector<std::uint8_t>;

Row large_steps(const SmoothnessOptions& options, const Row& gray, const Row& gray_before) {
  Row steps(gray.size() + 1, 77);
  find_large_steps(options, gray.data(), gray_before.data(), static_cast<int>(gray.size()),
                   steps.data());
  EXPECT_EQ(77, steps.back()) << "the byte after the row";
  steps.pop_back();
  return steps;
}

TEST(Smoothness, LargeStepsEqualReferenceForEveryChangeOnEveryInstructionSet) {
  Row all(256);
  for (int change = 0; change < 256; ++change) all[change] = static_cast<std::uint8_t>(change);
  const Row zero(256, 0), most(256, 255);
  test::for_each_simd_target([&] {
    for (const int large_step : {0, 1, 4, 20, 30, 149, 150, 250, 255, 300, 2550}) {
      for (const int small_step : {0, 1, 4, 20, 30, 250, 255, 300}) {
        for (const int edge : {4, 17, kUsualEdge}) {
          const SmoothnessOptions options = {small_step, large_step, edge};
          const Row up = large_steps(options, all, zero), down = large_steps(options, all, most);
          for (int change = 0; change < 256; ++change) {
            const int expected = reference::large_step(options, change);
            ASSERT_EQ(expected, up[change]) << small_step << ", " << large_step << ", " << change;
            ASSERT_EQ(expected, down[255 - change]) << small_step << ", " << large_step;
          }
        }
      }
    }
  });
}

TEST(Smoothness, EdgesAreSmallerInViewsOfLowContrast) {
  EXPECT_EQ(kUsualEdge, edge_for_range(255));
  EXPECT_EQ(kUsualEdge, edge_for_range(96));
  EXPECT_EQ(kUsualEdge / 2, edge_for_range(48));
  EXPECT_EQ(kEdgeParts / 2, edge_for_range(0));
}

TEST(Smoothness, LargeStepsEqualReferenceAtEveryWidth) {
  Random random(1);
  const SmoothnessOptions options = {4, 30};
  for (int width = 0; width < 70; ++width) {
    Row gray(width), before(width), expected;
    for (int x = 0; x < width; ++x) {
      gray[x] = static_cast<std::uint8_t>(random.below(256));
      before[x] = static_cast<std::uint8_t>(random.below(256));
      const int change = std::abs(gray[x] - before[x]);
      expected.push_back(static_cast<std::uint8_t>(reference::large_step(options, change)));
    }
    EXPECT_EQ(expected, large_steps(options, gray, before)) << width;
  }
}

TEST(Smoothness, LargeStepDecreasesWithTheGrayChangeDownToTheSmallStep) {
  EXPECT_EQ((Row{30, 15, 4, 4}), large_steps({4, 30}, {9, 9, 0, 255}, {9, 13, 255, 0}));
  EXPECT_EQ((Row{0, 0}), large_steps({4, 0}, {9, 9}, {9, 200})) << "without optimization";
}

}  // namespace
}  // namespace mtstereo::smoothness_test

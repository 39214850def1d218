// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/corner_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plane.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::corner_grid_test {
namespace {

std::vector<Corner> corners_of(const GrayPlane& view, float noise = 0) {
  CornerScratch scratch;
  std::vector<Corner> corners;
  find_corners(test::image_of(view), noise, scratch, corners);
  return corners;
}

/// The smaller eigenvalue at a pixel, pixel by pixel.
double strength(const GrayPlane& view, int x, int y) {
  double xx = 0, xy = 0, yy = 0;
  for (int j = y - 3; j <= y + 3; ++j) {
    for (int i = x - 3; i <= x + 3; ++i) {
      const double gx = view(i + 1, j) - view(i - 1, j), gy = view(i, j + 1) - view(i, j - 1);
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  return (xx + yy) / 2 - std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
}

TEST(CornerGrid, TakesTheStrongestPixelOfEachCellOnEveryInstructionSet) {
  const GrayPlane view = test::texture(211, 120, 3);
  test::for_each_simd_target([&] {
    const std::vector<Corner> corners = corners_of(view);
    ASSERT_GT(corners.size(), 200u);
    // 27 columns and 15 rows of cells.
    const int cell_width = 8, cell_height = 8;
    for (const Corner& corner : corners) {
      const int x0 = corner.x / cell_width * cell_width, y0 = corner.y / cell_height * cell_height;
      double strongest = 0;
      for (int y = std::max(y0, 9); y < std::min(y0 + cell_height, 120 - 9); ++y) {
        for (int x = std::max(x0, 9); x < std::min(x0 + cell_width, 211 - 9); ++x) {
          strongest = std::max(strongest, strength(view, x, y));
        }
      }
      EXPECT_NEAR(strongest, strength(view, corner.x, corner.y), 1e-4 * strongest);
    }
  });
}

TEST(CornerGrid, FindsTheCornersOfASquareOnly) {
  GrayPlane view(300, 200, 100);
  for (int y = 60; y < 140; ++y) {
    for (int x = 90; x < 210; ++x) view(x, y) = 150;
  }
  const std::vector<Corner> corners = corners_of(view);
  EXPECT_GE(corners.size(), 4u);
  for (const Corner& corner : corners) {
    EXPECT_LE(std::min(std::abs(corner.x - 90), std::abs(corner.x - 210)), 5);
    EXPECT_LE(std::min(std::abs(corner.y - 60), std::abs(corner.y - 140)), 5);
  }
}

TEST(CornerGrid, FindsNothingInFlatAndStripedViews) {
  EXPECT_TRUE(corners_of(GrayPlane(200, 100, 128)).empty());
  GrayPlane vertical(200, 100);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) vertical(x, y) = x / 6 % 2 == 0 ? 100 : 160;
  }
  EXPECT_TRUE(corners_of(vertical).empty());
}

TEST(CornerGrid, IgnoresWhatNoiseOfThisVarianceMakes) {
  test::Random random(1);
  GrayPlane view(400, 300);
  double variance = 0;
  for (std::uint8_t& pixel : view.pixels) {
    const int noise = random.between(-9, 9);
    variance += noise * noise;
    pixel = static_cast<std::uint8_t>(128 + noise);
  }
  variance /= static_cast<double>(view.pixels.size());
  EXPECT_GT(corners_of(view).size(), 300u);
  EXPECT_LT(corners_of(view, static_cast<float>(variance)).size(), 20u);
}

TEST(CornerGrid, KeepsAMarginAndItsLargestNumber) {
  for (const auto& [width, height] :
       {std::pair(640, 360), std::pair(640, 30), std::pair(24, 700), std::pair(20, 20)}) {
    const std::vector<Corner> corners = corners_of(test::texture(width, height, 1));
    EXPECT_LE(corners.size(), static_cast<std::size_t>(kMostCorners));
    for (const Corner& corner : corners) {
      EXPECT_TRUE(corner.x >= kCornerMargin && corner.x < width - kCornerMargin);
      EXPECT_TRUE(corner.y >= kCornerMargin && corner.y < height - kCornerMargin);
    }
  }
  EXPECT_TRUE(corners_of(test::texture(18, 100, 1)).empty());
}

}  // namespace
}  // namespace mtstereo::corner_grid_test

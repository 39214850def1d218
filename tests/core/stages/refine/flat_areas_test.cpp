// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/flat_areas.hpp"

#include <gtest/gtest.h>

#include "reference/refine/flat_planes.hpp"
#include "support/compare.hpp"
#include "support/flat_views.hpp"

namespace mtstereo::flat_areas_test {
namespace {

using reference::Pixels;

/// Finds the areas of a view, or of a view that is halved already, in bands of `band` rows; returns
/// the step.
int find_areas(const GrayPlane& view, float noise, int band, FlatAreas& areas) {
  areas.resize(view.width / 2, view.height / 2);
  const int height = areas.gray.height();
  GrayTotals totals;
  for (int y = 0; y < height; y += band) {
    totals.add(sum_grays(view.view(), y, std::min(y + band, height), areas));
  }
  const int step = flat_step(totals, areas.scale, noise);
  for (int y = 0; y < height; y += band) {
    find_runs(areas.gray, step, y, std::min(y + band, height), areas.runs);
  }
  join_bands(areas.gray, step, band, areas.runs);
  number_areas(areas);
  return step;
}

std::vector<Pixels> pixels_of(const FlatAreas& areas) {
  std::vector<Pixels> all(areas.count);
  for (int k = 0; k < areas.count; ++k) {
    for (std::uint32_t i = areas.first[k]; i < areas.first[k + 1]; ++i) {
      const FlatSpan span = areas.spans[i];
      for (int x = span.begin; x < span.end; ++x) all[k].emplace_back(x, span.y);
    }
  }
  return all;
}

TEST(FlatAreas, EqualReferenceAtEveryWidthAndInBands) {
  FlatAreas areas;
  for (int width = 2; width <= 90; ++width) {
    const GrayPlane view = test::flat_view(width, 2 + width * 7 % 83, width);
    const auto half = reference::reduced_sums(view, 2);
    const float noise = width % 3 == 0 ? 6.5F : 0.5F;
    areas.scale = width % 2 == 0 ? 2 : 4;  // of a view that was halved before
    const int step = reference::flat_step(half, areas.scale, noise);
    const std::vector<Pixels> expected = reference::flat_areas(half, areas.scale, step);
    for (const int band : {1, 5, 32, 1 << 20}) {
      EXPECT_EQ(step, find_areas(view, noise, band, areas)) << width;
      EXPECT_TRUE(same_image(half, copy_of(areas.gray))) << width;
      EXPECT_EQ(expected, pixels_of(areas)) << width << ", bands of " << band << " rows";
    }
  }
}

TEST(FlatAreas, KnowTheAreaOfEachRun) {
  FlatAreas areas;
  find_areas(test::flat_view(120, 90, 3), 0, 32, areas);
  ASSERT_GT(areas.count, 1);
  std::vector<std::uint32_t> runs(areas.count);
  for (int y = 0; y < areas.runs.height; ++y) {
    for (std::uint32_t run = areas.runs.first[y]; run < areas.runs.last[y]; ++run) {
      ASSERT_LE(areas.area[run], static_cast<std::uint32_t>(areas.count));
      if (areas.area[run] > 0) ++runs[areas.area[run] - 1];
    }
  }
  for (int k = 0; k < areas.count; ++k) {
    EXPECT_EQ(areas.first[k + 1] - areas.first[k], runs[k]) << k;
  }
}

TEST(FlatAreas, CountFromTheLeastSizeOn) {
  // Bars of 74 and of 75 pixels of the halved view, of 18 and of 19 of the quartered one.
  for (const auto& [pixels, scale] : {std::pair{74, 2}, {75, 2}, {18, 4}, {19, 4}}) {
    GrayPlane view(200, 6, 30);
    for (int x = 0; x < 2 * pixels; ++x) view(x, 2) = view(x, 3) = 200;
    for (int x = 0; x < 200; ++x) {
      // No area beside the bar: a checkerboard.
      for (const int y : {0, 1, 4, 5}) view(x, y) = x / 2 % 2 == 0 ? 0 : 100;
      if (x >= 2 * pixels) view(x, 2) = view(x, 3) = x / 2 % 2 == 0 ? 0 : 100;
    }
    FlatAreas areas;
    areas.scale = scale;
    find_areas(view, 0, 32, areas);
    EXPECT_EQ(pixels * scale * scale >= kLeastFlatArea ? 1 : 0, areas.count) << pixels;
  }
}

TEST(FlatAreas, ConnectByContrastAndNoise) {
  // Half of the pixels at either end: a deviation of 20 gray values and of 100.
  const auto totals = [](int low, int high) {
    FlatAreas areas;
    GrayPlane view(8, 8, static_cast<std::uint8_t>(low));
    for (int i = 0; i < 32; ++i) view.pixels[i] = static_cast<std::uint8_t>(high);
    areas.resize(4, 4);
    return sum_grays(view.view(), 0, 4, areas);
  };
  for (const auto& [scale, step] : {std::pair{2, kHalvedFlatStep}, {4, kQuarteredFlatStep}}) {
    EXPECT_EQ(step / 2, flat_step(totals(100, 140), scale, 0));
    EXPECT_EQ(step, flat_step(totals(20, 220), scale, 0));
    EXPECT_EQ(step, flat_step(totals(20, 220), scale, 3));
    EXPECT_EQ(20, flat_step(totals(20, 220), scale, 10));
    EXPECT_EQ(0, flat_step(totals(77, 77), scale, 0));
  }
}

}  // namespace
}  // namespace mtstereo::flat_areas_test

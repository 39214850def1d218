// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_chains.hpp"

#include <gtest/gtest.h>

#include "reference/refine/thin_chains.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::thin_chains_test {
namespace {

using test::disparity_noise;

constexpr int kWhole = 1 << 20;

/// A pair of views and a map of them.
struct Scene {
  Scene(int width, int height) : left(width, height), right(width, height), map(width, height) {}

  GrayPlane left, right;
  DisparityPlane map;
};

/// A textured background behind bars along the rows or the columns, which lean a little. Some
/// disparities are unknown, and the map has bars that are wider or narrower than in the views.
Scene bars(int width, int height, bool upright, std::uint64_t seed) {
  Random random(seed);
  Scene s(width, height);
  for (std::uint8_t& gray : s.left.pixels)
    gray = static_cast<std::uint8_t>(random.between(90, 130));
  s.right = s.left;
  for (std::int32_t& d : s.map.pixels) d = 300 + random.below(60);
  const int across = upright ? width : height, along = upright ? height : width;
  for (int place = random.below(8); place < across; place += random.between(8, 30)) {
    const int thickness = random.between(1, 11), fat = random.between(-1, 1);
    const int disparity = random.between(3 * 256, 9 * 256), lean = random.between(-3, 3);
    const int gray = random.between(0, 255), from = random.between(-10, along);
    const int to = from + random.between(5, along + 10);
    for (int k = std::max(from, 0); k < std::min(to, along); ++k) {
      for (int i = -1; i <= thickness; ++i) {
        const int at = place + i + lean * k / 8;
        if (at < 0 || at >= across) continue;
        const int x = upright ? at : k, y = upright ? k : at;
        if (i >= -fat && i < thickness + fat) s.map(x, y) = disparity + random.below(20);
        if (i < 0 || i == thickness) continue;
        s.left(x, y) = static_cast<std::uint8_t>(std::clamp(gray + random.between(-4, 4), 0, 255));
        if (x - disparity / 256 >= 0) s.right(x - disparity / 256, y) = s.left(x, y);
      }
    }
  }
  for (std::int32_t& d : s.map.pixels) {
    if (random.below(12) == 0) d = 0;
  }
  return s;
}

/// Marks the objects of one direction with bands of `band` lines from the last one to the first.
void mark(const Scene& scene, const Image<std::int32_t>& lines, Lines direction, int band,
          Image<std::int32_t>& found) {
  const int width = scene.map.width, height = scene.map.height;
  ThinRuns runs;
  ThinScratch scratch;
  runs.resize(width, height);
  scratch.resize(width, height);
  runs.start(direction, width, height);
  const auto in_bands = [&](auto&& body) {
    for (int i = (runs.lines - 1) / band; i >= 0; --i) {
      body(i * band, std::min<long>(static_cast<long>(i + 1) * band, runs.lines));
    }
  };
  const ThinViews views = {scene.left.view(), scene.right.view()};
  in_bands([&](int l0, int l1) { find_thin_runs(lines, l0, l0, l1, scratch, runs); });
  link_thin_runs(runs);
  in_bands([&](int l0, int l1) { rate_thin_runs(views, l0, l1, runs); });
  accept_chains(runs);
  in_bands([&](int l0, int l1) { mark_thin_pixels(runs, l0, l1, found); });
}

/// The map with the negative disparities of thin structures.
DisparityPlane marked(const Scene& scene, int band = kWhole) {
  const Image<std::int32_t> map = image_of(scene.map);
  Image<std::int32_t> found = image_of(scene.map);
  mark(scene, map, Lines::kRows, band, found);
  Image<std::int32_t> columns = image_of(DisparityPlane(scene.map.height, scene.map.width));
  transpose(map, 0, scene.map.width, columns);
  mark(scene, columns, Lines::kColumns, band, found);
  return copy_of(found);
}

long negative(const DisparityPlane& map) {
  return std::count_if(map.pixels.begin(), map.pixels.end(), [](std::int32_t d) { return d < 0; });
}

/// Compares with the scalar version and returns the number of pixels found.
long expect_reference(const Scene& scene, const std::vector<int>& bands = {1, 5, 32, kWhole}) {
  const DisparityPlane expected = reference::mark_thin(scene.left, scene.right, scene.map);
  for (const int band : bands) {
    EXPECT_TRUE(same_image(expected, marked(scene, band))) << "bands of " << band << " lines";
  }
  return negative(expected);
}

TEST(ThinChains, EqualReferenceForBarsInBothDirections) {
  long found = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const int width = 60 + static_cast<int>(seed * 7 % 90);
    found += expect_reference(bars(width, 40 + static_cast<int>(seed * 11 % 50), true, seed));
    found += expect_reference(bars(width, 70, false, seed));
  }
  EXPECT_GT(found, 2000) << "too few results to compare";
}

TEST(ThinChains, EqualReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      expect_reference(bars(width, 31, true, width), {kWhole});
    }
  });
}

TEST(ThinChains, EqualReferenceOnNoise) {
  for (int of_ten = 0; of_ten <= 10; of_ten += 2) {
    Scene scene = bars(90, 50, true, 100 + of_ten);
    scene.map = disparity_noise(90, 50, of_ten, 9 * 256, of_ten);
    expect_reference(scene);
    scene.map = test::patches(90, 50, of_ten / 2, of_ten);
    expect_reference(scene);
    scene.map = disparity_noise(90, 50, of_ten, test::kLargestDisparity, of_ten);
    expect_reference(scene);
  }
}

/// A bar of 3 px at 8 px of disparity in front of a background at 1 px, in rows y0 .. y1 - 1.
Scene post(int y0, int y1) {
  Scene s(80, 60);
  Random random(5);
  for (std::uint8_t& gray : s.left.pixels)
    gray = static_cast<std::uint8_t>(random.between(90, 130));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      s.map(x, y) = 256;
      s.right(x, y) = s.left.clamped(x + 1, y);
    }
    for (int x = 40; x < 43 && y >= y0 && y < y1; ++x) {
      s.map(x, y) = 8 * 256;
      s.left(x, y) = s.right(x - 8, y) = 220;
    }
  }
  return s;
}

TEST(ThinChains, KeepAPostButNoShortOne) {
  EXPECT_EQ(3 * 30, negative(marked(post(10, 40))));
  EXPECT_EQ(3 * kThinRowRules.runs, negative(marked(post(10, 10 + kThinRowRules.runs))));
  EXPECT_EQ(0, negative(marked(post(10, 9 + kThinRowRules.runs))));
}

TEST(ThinChains, BridgeSingleMissingRows) {
  Scene scene = post(10, 40);
  for (const int y : {15, 20, 25}) {
    for (int x = 40; x < 43; ++x) scene.map(x, y) = 0;
  }
  EXPECT_EQ(3 * 27, negative(marked(scene)));
}

TEST(ThinChains, KeepNoPostThatTheRightViewDoesNotShow) {
  Scene scene = post(10, 40);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) scene.right(x, y) = scene.left.clamped(x + 1, y);
  }
  EXPECT_EQ(0, negative(marked(scene)));
}

TEST(ThinChains, TrimWhatTheMatchingHasWidened) {
  Scene scene = post(10, 40);
  for (int y = 10; y < 40; ++y) scene.map(39, y) = scene.map(43, y) = 8 * 256;
  const DisparityPlane found = marked(scene);
  EXPECT_EQ(3 * 30, negative(found));
  EXPECT_LT(found(41, 20), 0);
}

TEST(ThinChains, TransposeAnyColumnsOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 40; ++width) {
      const int height = 1 + width * 7 % 37, x0 = width % 3, x1 = width - width % 2;
      const DisparityPlane map = disparity_noise(width, height, 10, 999, width);
      Image<std::int32_t> columns = image_of(DisparityPlane(height, width, -7));
      transpose(image_of(map), x0, x1, columns);
      for (int x = 0; x < width; ++x) {
        for (int y = 0; y < height; ++y) {
          EXPECT_EQ(x < x1 - x0 ? map(x0 + x, y) : -7, columns.row(x)[y]) << width << " columns";
        }
      }
    }
  });
}

}  // namespace
}  // namespace mtstereo::thin_chains_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/pair_watch.hpp"

#include <gtest/gtest.h>

#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::pair_watch_test {
namespace {

GrayPlane scene(int number) { return test::texture(120, 80, number); }

/// A view that shows nothing, with a little noise.
GrayPlane covered(int number) {
  GrayPlane view(120, 80);
  test::Random random(number);
  for (std::uint8_t& pixel : view.pixels) pixel = static_cast<std::uint8_t>(random.between(14, 20));
  return view;
}

TEST(PairWatch, ReportsABlankView) {
  PairWatch watch;
  watch.watch(scene(1).view(), covered(1).view());
  EXPECT_TRUE(watch.blank(1) && !watch.blank(0));
  watch.watch(GrayPlane(120, 80, 0).view(), scene(2).view());
  EXPECT_TRUE(watch.blank(0) && !watch.blank(1));
  watch.watch(scene(3).view(), scene(4).view());
  EXPECT_FALSE(watch.blank(0) || watch.blank(1));
}

TEST(PairWatch, DoesNotReportADarkScene) {
  PairWatch watch;
  watch.watch(covered(1).view(), covered(2).view());
  EXPECT_FALSE(watch.blank(0) || watch.blank(1));
}

TEST(PairWatch, ReportsAFrozenViewUntilItChanges) {
  for (int side = 0; side < 2; ++side) {
    PairWatch watch;
    for (int i = 0; i <= kFrozenPairs; ++i) {
      EXPECT_FALSE(watch.frozen(side)) << i;
      const GrayPlane still = scene(0), moving = scene(i + 1);
      watch.watch((side == 0 ? still : moving).view(), (side == 0 ? moving : still).view());
    }
    EXPECT_TRUE(watch.frozen(side));
    EXPECT_FALSE(watch.frozen(1 - side));
    watch.watch(scene(100).view(), scene(101).view());
    EXPECT_FALSE(watch.frozen(side));
  }
}

TEST(PairWatch, DoesNotReportAStillSceneNorSingleRepeatedFrames) {
  PairWatch watch;
  for (int i = 0; i < 3 * kFrozenPairs; ++i) watch.watch(scene(1).view(), scene(2).view());
  EXPECT_FALSE(watch.frozen(0) || watch.frozen(1));
  for (int i = 0; i < 3 * kFrozenPairs; ++i) {
    watch.watch(scene(i / 2).view(), scene(100 + i).view());
  }
  EXPECT_FALSE(watch.frozen(0) || watch.frozen(1));
}

TEST(PairWatch, ForgetsOnReset) {
  PairWatch watch;
  for (int i = 0; i <= kFrozenPairs; ++i) watch.watch(scene(0).view(), scene(i + 1).view());
  ASSERT_TRUE(watch.frozen(0));
  watch.reset();
  EXPECT_FALSE(watch.frozen(0));
}

TEST(PairWatch, AcceptsAnySizeAndStride) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 200), std::pair(2000, 2)}) {
    const test::PaddedImage<std::uint8_t> view(test::noise(width, height, 1), 7, 1);
    PairWatch watch;
    watch.watch(view.view(), view.upside_down());
    EXPECT_FALSE(watch.frozen(0));
  }
}

}  // namespace
}  // namespace mtstereo::pair_watch_test

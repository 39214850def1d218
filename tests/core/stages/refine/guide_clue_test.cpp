// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/guide_clue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/plane.hpp"

// The reference of all clues, with guides of every size, is in reliability_test.cpp.

namespace mtstereo::guide_clue_test {
namespace {

/// The bins of a map of one row.
std::vector<int> bins_of(const std::vector<int>& row, const RatedGuide& guide) {
  DisparityPlane plane(static_cast<int>(row.size()), 1);
  std::copy(row.begin(), row.end(), plane.pixels.begin());
  std::vector<std::uint8_t> bins(row.size() + kGuidePadding, 0xA5);
  std::vector<std::int32_t> expected(row.size() + kGuidePadding);
  find_guide_bins(guide, image_of(plane), 0, expected.data(), bins.data());
  return {bins.begin(), bins.end() - kGuidePadding};
}

/// A guide of one row in which all pixels are equal.
struct ConstantGuide {
  ConstantGuide(int of_disparity, int of_confidence)
      : disparity(image_of(DisparityPlane(3, 1, of_disparity))),
        confidence(image_of(GrayPlane(3, 1, static_cast<std::uint8_t>(of_confidence)))) {}
  RatedGuide guide() const { return {&disparity, &confidence}; }
  Image<std::int32_t> disparity;
  Image<std::uint8_t> confidence;
};

TEST(GuideClue, IsOneBinWithoutAGuide) {
  EXPECT_EQ((std::vector{0, 0, 0}), bins_of({256, 1, 9000}, {}));
}

TEST(GuideClue, CountsTheDistanceFromTwiceTheGuidesDisparity) {
  const ConstantGuide sure(5 * 256, 255);
  // 10 px is expected.
  const std::vector row = {2560, 2560 - 127, 2560 + 128, 2560 - 255, 2560 + 256, 2560 - 768};
  EXPECT_EQ((std::vector{28, 28, 29, 29, 30, 31}), bins_of(row, sure.guide()));
}

TEST(GuideClue, HasALevelForEach24StepsOfTheConfidence) {
  for (int confidence = 1; confidence <= 255; ++confidence) {
    const ConstantGuide pixel(256, confidence);
    const int level = confidence < 52 ? 0 : confidence >= 196 ? 7 : (confidence - 28) / 24;
    EXPECT_EQ((std::vector{4 * level}), bins_of({512}, pixel.guide())) << confidence;
  }
}

TEST(GuideClue, SaysTheSameAboutTwoPixels) {
  DisparityPlane map(2, 1);
  map(0, 0) = 256;
  map(1, 0) = 512;
  const Image<std::int32_t> disparity = image_of(map);
  const Image<std::uint8_t> confidence = image_of(GrayPlane(2, 1, 255));
  EXPECT_EQ((std::vector{28, 28, 28}), bins_of({512, 512, 1024}, {&disparity, &confidence}));
  EXPECT_EQ((std::vector{28, 28, 28, 28}),
            bins_of({512, 512, 1024, 1024}, {&disparity, &confidence}));
}

}  // namespace
}  // namespace mtstereo::guide_clue_test

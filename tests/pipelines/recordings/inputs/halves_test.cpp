// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of both views in one frame.
#include "recordings/inputs/halves.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "recordings/support/rig_views.hpp"

namespace mtstereo::run::halves_test {
namespace {

using testing::random_rig;
using testing::raw_views;
using testing::RawViews;

cv::Mat beside(const cv::Mat& first, const cv::Mat& second) {
  cv::Mat frame;
  cv::hconcat(first, second, frame);
  return frame;
}

TEST(Halves, OfStripsKeepARowAndAColumn) {
  for (const auto& [arrangement, size] : {std::pair(Arrangement::kSideBySide, cv::Size(4000, 1)),
                                          std::pair(Arrangement::kTopBottom, cv::Size(2000, 2))}) {
    const cv::Mat strip(size, CV_8U, cv::Scalar(9));
    EXPECT_EQ(cv::Size(2000, 1), half_of(strip, arrangement, 1, 480).size());
    EXPECT_FALSE(match_halves({strip}, arrangement, std::nullopt).confirmed);
  }
  const cv::Mat row(1, 200, CV_8U, cv::Scalar(9));
  EXPECT_FALSE(match_halves({row}, Arrangement::kTopBottom, std::nullopt).confirmed);
  EXPECT_FALSE(match_halves({row.t()}, Arrangement::kSideBySide, std::nullopt).confirmed);
}

// The rows of a raw rig differ, and the principal points can make all disparities negative.
TEST(Halves, OfRawViewsAreOrderedByTheirCalibration) {
  for (const double shift : {0.0, 0.12}) {
    StereoCalibration rig = random_rig(1);
    rig.right.center_x += shift * rig.right.width;
    const RawViews views = raw_views(rig, "garden");
    const auto order = [](const cv::Mat& frame, const std::optional<StereoCalibration>& by) {
      return match_halves({frame}, Arrangement::kSideBySide, by);
    };
    const cv::Mat good = beside(views.left, views.right), bad = beside(views.right, views.left);
    EXPECT_TRUE(order(good, rig).confirmed);
    EXPECT_FALSE(order(good, rig).swapped);
    EXPECT_TRUE(order(bad, rig).confirmed);
    EXPECT_TRUE(order(bad, rig).swapped);
    EXPECT_FALSE(order(good, std::nullopt).swapped);
    EXPECT_FALSE(order(bad, std::nullopt).swapped);
  }
}

TEST(Halves, OfDifferentScenesAreNotConfirmed) {
  const StereoCalibration rig = random_rig(1);
  const cv::Mat frame = beside(raw_views(rig, "garden").left, raw_views(rig, "room").right);
  EXPECT_FALSE(match_halves({frame}, Arrangement::kSideBySide, rig).confirmed);
  EXPECT_FALSE(match_halves({frame}, Arrangement::kSideBySide, std::nullopt).confirmed);
}

}  // namespace
}  // namespace mtstereo::run::halves_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/images.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval::images_test {
namespace {

using testing::TemporaryFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const cv::Vec3b kBlack(0, 0, 0);

TEST(Images, DisparityIsBlackOnlyWhereThereIsNone) {
  const cv::Mat map = (cv::Mat_<float>(1, 4) << kNan, 0, 32, 64);
  const cv::Mat color = color_disparity(map, 64);
  EXPECT_EQ(color.at<cv::Vec3b>(0, 0), kBlack);
  for (int x = 1; x < 4; ++x) EXPECT_NE(color.at<cv::Vec3b>(0, x), kBlack) << "at " << x;
  // Turbo runs from blue through green to red.
  EXPECT_GT(color.at<cv::Vec3b>(0, 3)[2], color.at<cv::Vec3b>(0, 3)[0]);
  EXPECT_GT(color.at<cv::Vec3b>(0, 1)[0], color.at<cv::Vec3b>(0, 3)[0]);
}

TEST(Images, DisparityColorDependsOnlyOnTheRange) {
  const cv::Mat one = color_disparity(cv::Mat((cv::Mat_<float>(1, 2) << 20, 64)), 64);
  const cv::Mat other = color_disparity(cv::Mat((cv::Mat_<float>(1, 2) << 20, 21)), 64);
  EXPECT_EQ(one.at<cv::Vec3b>(0, 0), other.at<cv::Vec3b>(0, 0));
}

TEST(Images, ErrorDistinguishesNoTruthFromNoEstimate) {
  const cv::Mat truth = (cv::Mat_<float>(1, 4) << kNan, 10, 10, 10);
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 10, kNan, 10, 90);
  const cv::Mat color = color_error(found, {truth, {}});
  const cv::Vec3b gray = color.at<cv::Vec3b>(0, 1);
  EXPECT_EQ(color.at<cv::Vec3b>(0, 0), kBlack);
  EXPECT_NE(gray, kBlack);
  EXPECT_EQ(gray[0], gray[1]);
  EXPECT_EQ(gray[1], gray[2]);
  EXPECT_GT(color.at<cv::Vec3b>(0, 3)[2], color.at<cv::Vec3b>(0, 3)[0]) << "a large error is red";
  EXPECT_NE(color.at<cv::Vec3b>(0, 2), color.at<cv::Vec3b>(0, 3));
}

TEST(Images, ErrorsOfEnlargedImagesHaveTheColorsOfTheOriginal) {
  const cv::Mat truth = (cv::Mat_<float>(1, 3) << 10, 10, 10);
  const cv::Mat found = (cv::Mat_<float>(1, 3) << 11, 13, 20);
  const cv::Mat original = color_error(found, {truth, {}});
  EXPECT_EQ(cv::norm(original, color_error(2 * found, {2 * truth, {}, 2}), cv::NORM_INF), 0);
}

TEST(Images, OverviewShowsTheLeftImageInItsCorner) {
  const cv::Mat left(3, 5, CV_8UC1, cv::Scalar(77));
  const cv::Mat map(3, 5, CV_32FC1, cv::Scalar(2));
  const cv::Mat image = overview({left, left, {map, {}}}, map, 16);
  EXPECT_EQ(image.size(), cv::Size(10, 6));
  EXPECT_EQ(image.at<cv::Vec3b>(2, 4), cv::Vec3b(77, 77, 77));
  EXPECT_EQ(image.at<cv::Vec3b>(0, 9), image.at<cv::Vec3b>(5, 0)) << "truth, estimate";
}

TEST(Images, AreWrittenIntoCreatedFolders) {
  const TemporaryFolder folder;
  write_image(folder / "a/b.c/0001.png", cv::Mat(2, 2, CV_8UC3, cv::Scalar(9, 8, 7)));
  const cv::Mat again = cv::imread((folder / "a/b.c/0001.png").string());
  ASSERT_FALSE(again.empty());
  EXPECT_EQ(again.at<cv::Vec3b>(0, 0), cv::Vec3b(9, 8, 7));
}

TEST(Images, UnwritableOnesAreNamed) {
  const TemporaryFolder folder;
  testing::write_file(folder / "file", "");
  EXPECT_INPUT_ERROR(write_image(folder / "file/a.png", cv::Mat(2, 2, CV_8UC3)), "file");
}

TEST(DisparityFiles, PfmHasInfinityForNone) {
  const TemporaryFolder folder;
  write_disparity(folder / "a.pfm", cv::Mat((cv::Mat_<float>(1, 2) << kNan, 3.25F)));
  const cv::Mat again = read_pfm(folder / "a.pfm");
  EXPECT_TRUE(std::isinf(again.at<float>(0, 0)));
  EXPECT_EQ(again.at<float>(0, 1), 3.25F);
}

}  // namespace
}  // namespace mtstereo::eval::images_test

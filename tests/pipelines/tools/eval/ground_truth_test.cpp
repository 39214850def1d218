// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/ground_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/images.hpp"

namespace mtstereo::eval::ground_truth_test {
namespace {

using testing::float_bytes;
using testing::TemporaryFolder;
using testing::write_file;
using testing::write_image;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// Compares maps; NaN equals NaN.
void expect_row(const cv::Mat& map, int y, const std::vector<float>& wanted) {
  ASSERT_EQ(map.cols, static_cast<int>(wanted.size()));
  for (int x = 0; x < map.cols; ++x) {
    const float found = map.at<float>(y, x);
    const float want = wanted[static_cast<std::size_t>(x)];
    if (std::isnan(want)) {
      EXPECT_TRUE(std::isnan(found)) << "at " << x << "," << y << ": " << found;
    } else {
      EXPECT_FLOAT_EQ(found, want) << "at " << x << "," << y;
    }
  }
}

class GroundTruthFiles : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

// Data sets without ground truth everywhere state 0 there, as in PNG files.
TEST_F(GroundTruthFiles, PfmHasNonFiniteAndNegativeValuesAndZeroAsUnknown) {
  write_file(folder_ / "a.pfm",
             "Pf\n6 1\n-1\n" + float_bytes({1, 0, -3, kInf, -kInf, kNan}, false));
  expect_row(read_pfm_disparity(folder_ / "a.pfm"), 0, {1, kNan, kNan, kNan, kNan, kNan});
}

TEST_F(GroundTruthFiles, PfmWithoutPositiveValuesIsNegated) {
  write_file(folder_ / "a.pfm", "Pf\n4 1\n-1\n" + float_bytes({-1, -2.5F, 0, kInf}, false));
  // +infinity is not finite, hence not a positive disparity.
  expect_row(read_pfm_disparity(folder_ / "a.pfm"), 0, {1, 2.5F, kNan, kNan});
}

TEST_F(GroundTruthFiles, PngWith16BitsIsIn256thsAndZeroIsUnknown) {
  write_image(folder_ / "a.png", (cv::Mat_<std::uint16_t>(1, 4) << 0, 256, 384, 65535));
  expect_row(read_png_disparity(folder_ / "a.png"), 0, {kNan, 1, 1.5F, 65535 / 256.0F});
}

TEST_F(GroundTruthFiles, PngWith8BitsIsInPixels) {
  write_image(folder_ / "a.png", (cv::Mat_<std::uint8_t>(1, 3) << 0, 1, 200));
  expect_row(read_png_disparity(folder_ / "a.png"), 0, {kNan, 1, 200});
}

TEST_F(GroundTruthFiles, PngInColorIsRejected) {
  write_image(folder_ / "a.png", cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3)));
  EXPECT_INPUT_ERROR(read_png_disparity(folder_ / "a.png"), "3 channels");
}

TEST_F(GroundTruthFiles, DmapIsBigEndianColumnByColumn) {
  // Two columns of three rows.
  write_file(folder_ / "a_dmap.bin", float_bytes({1, 2, 3, 4, 5, 6}, true));
  const cv::Mat map = read_dmap(folder_ / "a_dmap.bin", cv::Size(2, 3));
  expect_row(map, 0, {1, 4});
  expect_row(map, 1, {2, 5});
  expect_row(map, 2, {3, 6});
}

TEST_F(GroundTruthFiles, DmapHasZeroNegativeSkyAndNanAsUnknown) {
  write_file(folder_ / "a_dmap.bin", float_bytes({0, -1, 1e10F, kNan, kInf, 7}, true));
  expect_row(read_dmap(folder_ / "a_dmap.bin", cv::Size(6, 1)), 0,
             {kNan, kNan, kNan, kNan, kNan, 7});
}

TEST_F(GroundTruthFiles, DmapOfAnotherSizeIsRejected) {
  write_file(folder_ / "a_dmap.bin", float_bytes({1, 2, 3}, true));
  EXPECT_INPUT_ERROR(read_dmap(folder_ / "a_dmap.bin", cv::Size(2, 2)),
                     "a_dmap.bin: has 12 bytes; an image of 2x2 needs 16");
}

TEST_F(GroundTruthFiles, CameraCenterFollowsFromItsPose) {
  // Rotated by 90 degrees about y: world to camera x_c = R x_w + t, so the center is -R^T t.
  const double half = std::sqrt(0.5);
  write_file(folder_ / "cam.txt", "300 310 160 120 " + std::to_string(half) + " 0 " +
                                      std::to_string(half) + " 0 1 2 3\n");
  const Camera camera = read_camera(folder_ / "cam.txt");
  EXPECT_DOUBLE_EQ(camera.focal_length, 300);
  EXPECT_DOUBLE_EQ(camera.principal_x, 160);
  // R = [0 0 1; 0 1 0; -1 0 0], R^T t = (-3, 2, 1).
  EXPECT_NEAR(camera.center[0], 3, 1e-5);
  EXPECT_NEAR(camera.center[1], -2, 1e-5);
  EXPECT_NEAR(camera.center[2], -1, 1e-5);
}

TEST_F(GroundTruthFiles, CameraWithMissingOrInvalidNumbersIsRejected) {
  write_file(folder_ / "cam.txt", "300 300 160 120 1 0 0 0 0 0");
  EXPECT_INPUT_ERROR(read_camera(folder_ / "cam.txt"), "11 numbers");
  write_file(folder_ / "cam.txt", "0 300 160 120 1 0 0 0 0 0 0");
  EXPECT_INPUT_ERROR(read_camera(folder_ / "cam.txt"), "focal length");
  write_file(folder_ / "cam.txt", "300 300 160 120 0 0 0 0 0 0 0");
  EXPECT_INPUT_ERROR(read_camera(folder_ / "cam.txt"), "quaternion");
}

TEST(Depth, IsConvertedByFocalLengthAndBaseline) {
  Camera left{400, 320, {0, 0, 0}};
  Camera right{400, 320, {0.5, 0, 0}};
  const cv::Mat depth = (cv::Mat_<float>(1, 4) << 10, 40, kNan, 200);
  expect_row(depth_to_disparity(depth, left, right), 0, {20, 5, kNan, 1});
  right.principal_x = 322;  // 2 px to the right: 2 px less disparity
  expect_row(depth_to_disparity(depth, left, right), 0, {18, 3, kNan, kNan});
}

TEST(Depth, OfTwoCamerasAtOnePositionIsRejected) {
  const Camera camera{400, 320, {1, 2, 3}};
  EXPECT_INPUT_ERROR(depth_to_disparity(cv::Mat::ones(1, 1, CV_32F), camera, camera),
                     "same position");
}

TEST_F(GroundTruthFiles, ImageInColorBecomesLuma) {
  const cv::Mat blue_green_red = (cv::Mat_<cv::Vec3b>(1, 3) << cv::Vec3b(255, 0, 0),
                                  cv::Vec3b(0, 255, 0), cv::Vec3b(0, 0, 255));
  write_image(folder_ / "a.png", blue_green_red);
  const cv::Mat gray = read_gray(folder_ / "a.png");
  ASSERT_EQ(gray.type(), CV_8UC1);
  EXPECT_EQ(gray.at<std::uint8_t>(0, 0), 29);   // 0.114 * 255
  EXPECT_EQ(gray.at<std::uint8_t>(0, 1), 150);  // 0.587 * 255
  EXPECT_EQ(gray.at<std::uint8_t>(0, 2), 76);   // 0.299 * 255
}

TEST_F(GroundTruthFiles, ImageIgnoresAlpha) {
  write_image(folder_ / "a.png", cv::Mat(2, 2, CV_8UC4, cv::Scalar(100, 100, 100, 0)));
  EXPECT_EQ(read_gray(folder_ / "a.png").at<std::uint8_t>(1, 1), 100);
}

TEST_F(GroundTruthFiles, ImageWith16BitsIsScaled) {
  write_image(folder_ / "a.png", (cv::Mat_<std::uint16_t>(1, 3) << 0, 32896, 65535));
  const cv::Mat gray = read_gray(folder_ / "a.png");
  EXPECT_EQ(gray.at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(gray.at<std::uint8_t>(0, 1), 128);
  EXPECT_EQ(gray.at<std::uint8_t>(0, 2), 255);
}

TEST_F(GroundTruthFiles, CorruptEmptyOrMissingImageIsNamed) {
  write_image(folder_ / "good.png", cv::Mat(64, 64, CV_8UC1, cv::Scalar(7)));
  const std::string bytes = testing::read_file(folder_ / "good.png");
  write_file(folder_ / "cut.png", bytes.substr(0, bytes.size() / 2));
  write_file(folder_ / "text.png", "this is not an image");
  write_file(folder_ / "empty.png", "");
  EXPECT_INPUT_ERROR(read_gray(folder_ / "cut.png"), "cut.png: ");
  EXPECT_INPUT_ERROR(read_gray(folder_ / "text.png"), "text.png: is corrupt");
  EXPECT_INPUT_ERROR(read_gray(folder_ / "empty.png"), "empty.png: is empty");
  EXPECT_INPUT_ERROR(read_gray(folder_ / "none.png"), "none.png: no such file");
}

TEST_F(GroundTruthFiles, MaskHasOnlyPixelsVisibleInBothViews) {
  write_image(folder_ / "mask.png", (cv::Mat_<std::uint8_t>(1, 3) << 0, 128, 255));
  const cv::Mat mask = read_visible_mask(folder_ / "mask.png");
  EXPECT_EQ(mask.at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(mask.at<std::uint8_t>(0, 1), 0);
  EXPECT_EQ(mask.at<std::uint8_t>(0, 2), 255);
}

}  // namespace
}  // namespace mtstereo::eval::ground_truth_test

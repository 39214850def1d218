// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/preprocess.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "reference/preprocess.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/stages.hpp"

namespace mtstereo {
namespace {

using test::copy_of;
using test::GrayPlane;
using test::Plane;
using test::same_image;

cv::Mat mat_of(const GrayPlane& plane) {
  cv::Mat mat(plane.height, plane.width, CV_8UC1);
  for (int y = 0; y < plane.height; ++y) {
    std::copy_n(&plane(0, y), plane.width, mat.ptr<std::uint8_t>(y));
  }
  return mat;
}

template <typename T>
Plane<T> plane_of(const cv::Mat& mat) {
  Plane<T> plane(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y) std::copy_n(mat.ptr<T>(y), mat.cols, &plane(0, y));
  return plane;
}

/// Compares everything that the step makes of an image with the references.
void expect_reference(const GrayPlane& image, const PreprocessedView& view, int gray_levels) {
  const GrayPlane median = reference::median5(image);
  EXPECT_TRUE(same_image(median, view.median));
  EXPECT_TRUE(same_image(reference::levels(median, gray_levels), view.level));
  const reference::CostInput input = reference::cost_input(median);
  EXPECT_TRUE(same_image(input.gray, view.gray));
  EXPECT_TRUE(same_image(input.sobel_x, view.sobel_x));
  EXPECT_TRUE(same_image(input.sobel_y, view.sobel_y));
}

TEST(Preprocess, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    for (const int height : {1, 2, 3, 4, 5, 11}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height);
      const GrayPlane image = test::noise(width, height, 100 * width + height);
      expect_reference(image, test::preprocess(image.view(), 16), 16);
    }
  }
}

TEST(Preprocess, EqualsReferenceAtExtremeContrast) {
  for (const int gray_levels : {2, 3, 8, 255, 256}) {
    const GrayPlane image = test::black_and_white(67, 33, gray_levels);
    expect_reference(image, test::preprocess(image.view(), gray_levels), gray_levels);
  }
}

TEST(Preprocess, EqualsReferenceOnWideRows) {
  const GrayPlane image = test::texture(8192, 6, 1);
  expect_reference(image, test::preprocess(image.view(), 8), 8);
}

TEST(Preprocess, DoesNotDependOnBands) {
  const GrayPlane image = test::texture(61, 47, 2);
  for (const int band : {1, 2, 3, 5, 32, 46, 47}) {
    SCOPED_TRACE(testing::Message() << "bands of " << band << " rows");
    expect_reference(image, test::preprocess(image.view(), 16, band), 16);
  }
}

TEST(Preprocess, ReadsOnlyThePixelsOfAPaddedImage) {
  for (const int padding : {1, 3, 31, 64, 100}) {
    const GrayPlane image = test::texture(45, 17, padding);
    const test::PaddedImage<std::uint8_t> padded(image, padding, padding % 7);
    expect_reference(image, test::preprocess(padded.view(), 16, 4), 16);
    EXPECT_TRUE(padded.unchanged()) << "padding of " << padding << " bytes";
  }
}

TEST(Preprocess, MedianEqualsOpenCv) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {4, 5}, {129, 40}}) {
    const GrayPlane image = test::noise(width, height, 3);
    cv::Mat expected;
    cv::medianBlur(mat_of(image), expected, 5);
    EXPECT_TRUE(
        same_image(plane_of<std::uint8_t>(expected), test::preprocess(image.view(), 16, 7).median));
  }
}

TEST(Preprocess, WeightedSobelEqualsOpenCv) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {4, 5}, {129, 40}}) {
    const PreprocessedView view = test::preprocess(test::noise(width, height, 4).view(), 16, 7);
    cv::Mat sobel_x, sobel_y;
    cv::Sobel(mat_of(copy_of(view.median)), sobel_x, CV_16S, 1, 0);
    cv::Sobel(mat_of(copy_of(view.median)), sobel_y, CV_16S, 0, 1);
    Plane<std::int16_t> expected_x = plane_of<std::int16_t>(sobel_x);
    Plane<std::int16_t> expected_y = plane_of<std::int16_t>(sobel_y);
    for (std::int16_t& v : expected_x.pixels)
      v = static_cast<std::int16_t>(reference::weighted(v, 0.59));
    for (std::int16_t& v : expected_y.pixels)
      v = static_cast<std::int16_t>(reference::weighted(v, 0.11));
    EXPECT_TRUE(same_image(expected_x, view.sobel_x)) << width << "x" << height;
    EXPECT_TRUE(same_image(expected_y, view.sobel_y)) << width << "x" << height;
  }
}

TEST(LevelTable, EqualsReferenceForEveryStrengthAndNumberOfLevels) {
  for (int gray_levels = 2; gray_levels <= 256; ++gray_levels) {
    const LevelTable table = level_table(gray_levels);
    for (int strength = 0; strength <= kLargestEdge; ++strength) {
      ASSERT_EQ(reference::level(strength, gray_levels), table[strength])
          << "strength " << strength << " in " << gray_levels << " levels";
    }
  }
}

TEST(LevelTable, GivesFlatPlacesTheHighestLevelAndStrongEdgesTheLowest) {
  for (const int gray_levels : {2, 8, 16, 256}) {
    const LevelTable table = level_table(gray_levels);
    EXPECT_EQ(gray_levels - 1, table[0]);
    EXPECT_EQ(0, table[260]) << "the inverted mean strength is 125 there";
    EXPECT_EQ(0, table[kLargestEdge]);
    EXPECT_TRUE(std::is_sorted(table.rbegin(), table.rend()));
  }
}

TEST(CostWeights, SumToOne) {
  EXPECT_NEAR(1.0, (kCostWeights[0] + kCostWeights[1] + kCostWeights[2]) / (256.0 * kCostScale),
              1e-3);
}

}  // namespace
}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/preprocess.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "reference/prepare/preprocess.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

#ifdef MTSTEREO_TEST_OPENCV
#include <opencv2/imgproc.hpp>
#endif

namespace mtstereo::preprocess_test {
namespace {

using test::Plane;

/// Compares all results of pre-processing an image with the references.
void expect_reference(const GrayPlane& image, const PreprocessedView& view, int gray_levels) {
  const GrayPlane median = reference::median5(image);
  EXPECT_TRUE(same_image(median, view.median));
  EXPECT_TRUE(same_image(reference::levels(median, gray_levels), view.level));
  const reference::CostInput input = reference::cost_input(median);
  EXPECT_TRUE(same_image(input.gray, view.gray));
  EXPECT_TRUE(same_image(input.sobel_x, view.sobel_x));
  EXPECT_TRUE(same_image(input.sobel_y, view.sobel_y));
}

TEST(Preprocess, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 70; ++width) {
      for (const int height : {1, 2, 3, 4, 5, 11}) {
        SCOPED_TRACE(testing::Message() << width << "x" << height);
        const GrayPlane image = test::noise(width, height, 100 * width + height);
        expect_reference(image, test::preprocess(image.view(), 16), 16);
      }
    }
  });
}

TEST(Preprocess, EqualsReferenceAtExtremeContrast) {
  test::for_each_simd_target([] {
    for (const int gray_levels : {2, 3, 8, 255, 256}) {
      const GrayPlane image = test::black_and_white(67, 33, gray_levels);
      expect_reference(image, test::preprocess(image.view(), gray_levels), gray_levels);
    }
  });
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

#ifdef MTSTEREO_TEST_OPENCV

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

#endif

/// The levels of an image, which is used as the median.
GrayPlane levels_of(const GrayPlane& median, int gray_levels) {
  PreprocessedView view;
  view.resize(median.width, median.height);
  view.median = test::image_of(median);
  test::poison(view.level);
  SobelScratch scratch;
  level_rows(gray_levels, 0, median.height, scratch, view);
  return copy_of(view.level);
}

/// Squares of 3x3 pixels, side by side, whose middle pixels have all possible edge strengths. These
/// are even, since the corners count in both Sobel filters; the strongest are those of two bright
/// sides at a right angle.
GrayPlane all_strengths() {
  constexpr int kStrongest = 6 * 255;
  GrayPlane image(3 * (kStrongest / 2 + 1), 3);
  for (int half = 0; 2 * half <= kStrongest; ++half) {
    // The strength is twice the sum of these three pixels, which is `half`.
    const int x = 3 * half;
    const auto third = [&](int i) { return static_cast<std::uint8_t>((half + i) / 3); };
    image(x + 2, 1) = third(0);
    image(x + 2, 2) = third(1);
    image(x + 1, 2) = third(2);
  }
  return image;
}

TEST(Levels, EqualReferenceForEveryStrengthAndNumberOfLevels) {
  const GrayPlane image = all_strengths();
  const Plane<int> x = reference::sobel(image, reference::Direction::kHorizontal);
  const Plane<int> y = reference::sobel(image, reference::Direction::kVertical);
  for (int i = 0; i < image.width / 3; ++i) {
    ASSERT_EQ(2 * i, std::abs(x(3 * i + 1, 1)) + std::abs(y(3 * i + 1, 1)));
  }
  test::for_each_simd_target([&] {
    for (int gray_levels = 2; gray_levels <= 256; ++gray_levels) {
      ASSERT_TRUE(same_image(reference::levels(image, gray_levels), levels_of(image, gray_levels)))
          << gray_levels << " levels";
    }
  });
}

TEST(Levels, AreHighestInFlatAreasAndLowestAtStrongEdges) {
  const GrayPlane image = all_strengths();
  for (const int gray_levels : {2, 8, 16, 256}) {
    const GrayPlane levels = levels_of(image, gray_levels);
    EXPECT_EQ(gray_levels - 1, levels(1, 1));
    EXPECT_EQ(0, levels(3 * 130 + 1, 1)) << "the inverted mean strength is 125 there";
    EXPECT_EQ(0, levels(levels.width - 2, 1));
    for (int x = 4; x < levels.width; x += 3) EXPECT_LE(levels(x, 1), levels(x - 3, 1)) << x;
  }
}

TEST(Levels, NeedNoCostBuffers) {
  const GrayPlane image = test::texture(50, 9, 6);
  EXPECT_TRUE(same_image(reference::levels(image, 16), levels_of(image, 16)));
}

TEST(CostRows, ReadOnlyThePixelsOfAPaddedImage) {
  for (const int padding : {0, 1, 3, 31, 64, 100}) {
    const GrayPlane image = test::texture(45 + padding, 17, padding);
    const test::PaddedImage<std::uint8_t> padded(image, padding, padding % 7);
    PreprocessedView view;
    view.resize_costs(image.width, image.height);
    SobelScratch scratch;
    for (int y = 0; y < image.height; ++y) cost_rows(padded.view(), y, y + 1, scratch, view);
    const reference::CostInput input = reference::cost_input(image);
    EXPECT_TRUE(same_image(input.gray, view.gray));
    EXPECT_TRUE(same_image(input.sobel_x, view.sobel_x));
    EXPECT_TRUE(same_image(input.sobel_y, view.sobel_y));
    EXPECT_TRUE(padded.unchanged());
  }
}

TEST(CostWeights, SumToOne) {
  EXPECT_NEAR(1.0, (kCostWeights[0] + kCostWeights[1] + kCostWeights[2]) / (256.0 * kCostScale),
              1e-3);
}

}  // namespace
}  // namespace mtstereo::preprocess_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/cost_volume.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "reference/prepare/cost_volume.hpp"
#include "support/compare.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

#ifdef MTSTEREO_TEST_OPENCV
#include <opencv2/imgproc.hpp>
#endif

namespace mtstereo::cost_volume_test {
namespace {

/// The options of a volume.
struct Options {
  int disparities;
  int kernel_size;
  int shift;
};

/// The whole volume in blocks of `block` slices; 0: the number that the library uses.
CostVolume volume_of(const PreprocessedView& left, const PreprocessedView& right,
                     const Options& options, int block = 0) {
  const SmoothingKernel kernel = smoothing_kernel(options.kernel_size, options.shift);
  CostVolume volume;
  volume.resize(left.gray.width(), left.gray.height(), options.disparities, options.shift);
  CostScratch scratch;
  scratch.resize(volume, kernel);
  if (block == 0) block = slices_per_block(volume, kernel);
  for (int d = 0; d < options.disparities; d += block) {
    compute_cost_slices(left, right, kernel, d, std::min(d + block, options.disparities), scratch,
                        volume);
  }
  return volume;
}

/// Compares the volume of a pair with the reference at every pixel, on every SIMD target.
void expect_reference(const GrayPlane& left, const GrayPlane& right, const Options& options) {
  SCOPED_TRACE(testing::Message() << left.width << "x" << left.height << ", " << options.disparities
                                  << " disparities, kernel " << options.kernel_size << ", shift "
                                  << options.shift);
  const reference::Volume expected =
      reference::cost_volume(reference::cost_input(reference::median5(left)),
                             reference::cost_input(reference::median5(right)), options.disparities,
                             options.kernel_size, options.shift);
  const PreprocessedView left_view = test::preprocess(left.view(), 16);
  const PreprocessedView right_view = test::preprocess(right.view(), 16);
  test::for_each_simd_target([&] {
    const CostVolume volume = volume_of(left_view, right_view, options);
    for (int d = 0; d < options.disparities; ++d) {
      ASSERT_TRUE(test::same_pixels(
          left.width, left.height, [&](int x, int y) { return expected.at(x, y, d); },
          [&](int x, int y) { return static_cast<int>(volume.at(x, y, d)); }))
          << "at disparity " << d;
    }
  });
}

TEST(CostVolume, EqualsReferenceAtEveryWidthAndBothResolutions) {
  constexpr int kKernels[] = {21, 3, 41, 1, 7};
  for (int width = 1; width <= 70; ++width) {
    for (const int shift : {0, 1}) {
      const int height = 1 + (width + shift) % 7;
      const int disparities = std::min({width, 1 + width % 13});
      expect_reference(test::noise(width, height, width), test::noise(width, height, width + 1000),
                       {disparities, kKernels[(width + shift) % 5], shift});
    }
  }
}

TEST(CostVolume, EqualsReferenceWithEveryDisparityOfTheWidth) {
  for (const int width : {1, 2, 17, 33}) {
    for (const int shift : {0, 1}) {
      expect_reference(test::texture(width, 9, 5), test::texture(width, 9, 6), {width, 21, shift});
    }
  }
}

TEST(CostVolume, EqualsReferenceForEveryKernelSize) {
  for (int size = 1; size <= 41; size += 2) {
    for (const int shift : {0, 1}) {
      expect_reference(test::texture(37, 25, 7), test::texture(37, 25, 8), {2, size, shift});
    }
  }
}

TEST(CostVolume, EqualsReferenceAtExtremeCosts) {
  GrayPlane stripes(64, 16), inverse(64, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 64; ++x) {
      stripes(x, y) = x / 8 % 2 == 0 ? 0 : 255;
      inverse(x, y) = static_cast<std::uint8_t>(255 - stripes(x, y));
    }
  }
  for (const int size : {1, 21}) {
    for (const int shift : {0, 1}) {
      expect_reference(stripes, inverse, {9, size, shift});
      expect_reference(stripes, stripes, {9, size, shift});
    }
  }
}

TEST(CostVolume, EqualsReferenceOnWideRows) {
  for (const int shift : {0, 1}) {
    expect_reference(test::noise(8192, 3, 9), test::noise(8192, 3, 10), {2, 21, shift});
  }
}

TEST(CostVolume, DoesNotDependOnBlocks) {
  const test::Pair pair = test::slanted_pair(83, 31, 16, 11);
  const PreprocessedView left = test::preprocess(pair.left.view(), 16);
  const PreprocessedView right = test::preprocess(pair.right.view(), 16);
  const Options options{16, 21, 1};
  const CostVolume expected = volume_of(left, right, options, 1);
  for (const int block : {2, 3, 5, 8}) {
    const CostVolume volume = volume_of(left, right, options, block);
    for (int d = 0; d < options.disparities; ++d) {
      EXPECT_TRUE(test::same_pixels(
          83, 31, [&](int x, int y) { return expected.at(x, y, d); },
          [&](int x, int y) { return volume.at(x, y, d); }))
          << "blocks of " << block << ", disparity " << d;
    }
  }
}

#ifdef MTSTEREO_TEST_OPENCV

/// A slice by the paper's definition in floating point: the weighted mean of three absolute
/// differences, smoothed by OpenCV's Gaussian. Columns without a right pixel repeat the first
/// column that has one.
cv::Mat smoothed_slice(const GrayPlane& left, const GrayPlane& right, int d, int kernel_size) {
  const auto horizontal = reference::Direction::kHorizontal;
  const auto vertical = reference::Direction::kVertical;
  const auto left_x = reference::sobel(left, horizontal), left_y = reference::sobel(left, vertical);
  const auto right_x = reference::sobel(right, horizontal);
  const auto right_y = reference::sobel(right, vertical);
  cv::Mat slice(left.height, left.width, CV_32FC1);
  for (int y = 0; y < left.height; ++y) {
    for (int column = 0; column < left.width; ++column) {
      const int x = std::max(column, d);
      slice.at<float>(y, column) =
          static_cast<float>(0.30 * std::abs(left(x, y) - right(x - d, y)) +
                             0.59 * std::abs(left_x(x, y) - right_x(x - d, y)) +
                             0.11 * std::abs(left_y(x, y) - right_y(x - d, y)));
    }
  }
  cv::GaussianBlur(slice, slice, {kernel_size, kernel_size}, reference::kernel_sigma(kernel_size),
                   0, cv::BORDER_REPLICATE);
  return slice;
}

/// Largest and mean difference between a volume and the definition, averaged over each cell [gray
/// values].
struct Distance {
  double largest = 0;
  double mean = 0;
  double mean_cost = 0;  ///< of the definition
};

Distance distance_from_gaussian(const Options& options) {
  constexpr int kWidth = 91, kHeight = 61;
  const test::Pair pair = test::slanted_pair(kWidth, kHeight, 12, 12);
  const PreprocessedView left = test::preprocess(pair.left.view(), 16);
  const PreprocessedView right = test::preprocess(pair.right.view(), 16);
  const CostVolume volume = volume_of(left, right, options);
  const int side = 1 << options.shift;
  Distance distance;
  for (int d = 0; d < options.disparities; ++d) {
    const cv::Mat slice =
        smoothed_slice(copy_of(left.median), copy_of(right.median), d, options.kernel_size);
    for (int y = 0; y < kHeight; y += side) {
      for (int x = 0; x < kWidth; x += side) {
        const cv::Rect cell(x, y, std::min(side, kWidth - x), std::min(side, kHeight - y));
        const double expected = cv::mean(slice(cell))[0];
        const double error = std::abs(volume.at(x, y, d) / double{kCostScale} - expected);
        distance.largest = std::max(distance.largest, error);
        const double share = 1.0 / (1.0 * volume.columns * volume.rows * options.disparities);
        distance.mean += error * share;
        distance.mean_cost += expected * share;
      }
    }
  }
  return distance;
}

TEST(CostVolume, IsAGaussianOfTheCostsAtFullResolution) {
  // The errors of rounding to 1/16 gray value and to weights of 1/32768; they grow with the number
  // of weights.
  for (const int size : {3, 7, 21, 41}) {
    const Distance distance = distance_from_gaussian({12, size, 0});
    EXPECT_LT(distance.largest, 0.75) << "kernel " << size;
    EXPECT_LT(distance.mean, 0.15) << "kernel " << size;
  }
}

TEST(CostVolume, IsCloseToTheGaussianAtHalfResolution) {
  for (const int size : {11, 21, 41}) {
    const Distance distance = distance_from_gaussian({12, size, 1});
    EXPECT_LT(distance.mean, 0.02 * distance.mean_cost) << "kernel " << size;
    EXPECT_LT(distance.largest, 0.5 * distance.mean_cost) << "kernel " << size;
  }
}

#endif

TEST(SmoothingKernel, SumsToOneAndDecreasesFromTheCenter) {
  for (const int shift : {0, 1}) {
    for (int size = 1; size <= 41; size += 2) {
      const SmoothingKernel kernel = smoothing_kernel(size, shift);
      const int sum = 2 * std::accumulate(kernel.begin() + 1, kernel.end(), 0) + kernel[0];
      EXPECT_EQ(kernel.size() == 1 ? 32767 : 32768, sum) << "size " << size << ", shift " << shift;
      EXPECT_TRUE(std::is_sorted(kernel.rbegin(), kernel.rend())) << "size " << size;
      EXPECT_GE(kernel.back(), 0);
      EXPECT_EQ((size / 2 + shift) / (1 + shift) + 1, static_cast<int>(kernel.size()));
    }
  }
}

}  // namespace
}  // namespace mtstereo::cost_volume_test

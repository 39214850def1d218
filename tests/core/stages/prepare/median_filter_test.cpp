// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/median_filter.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "reference/prepare/preprocess.hpp"
#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

#ifdef MTSTEREO_TEST_OPENCV
#include <opencv2/imgproc.hpp>
#endif

namespace mtstereo::median_filter_test {
namespace {

GrayPlane median_of(GrayView image, int band = 1 << 20) {
  Image<std::uint8_t> median;
  median.resize(image.width, image.height);
  test::poison(median);
  MedianScratch scratch;
  for (int y = 0; y < image.height; y += band) {
    median_rows(image, y, std::min(y + band, image.height), scratch, median);
  }
  return test::copy_of(median);
}

/// Squares of 5x5 black and white pixels, side by side. The first column of each has any pattern.
/// The other columns are sorted and differ by the number of white pixels.
struct Squares {
  static constexpr int kSorted = kMedianSide + 1;
  static constexpr int kCount = 32 * kSorted * kSorted * kSorted * kSorted;

  Squares() : image(kMedianSide * kCount, kMedianSide) {
    for (int i = 0; i < kCount; ++i) {
      fill(kMedianSide * i, i % 32);
      int rest = i / 32;
      for (int k = 1; k < kMedianSide; ++k, rest /= kSorted) {
        fill(kMedianSide * i + k, (1 << rest % kSorted) - 1);
      }
      expected.push_back(white > 12 ? 255 : 0);
      white = 0;
    }
  }
  void fill(int x, int pattern) {
    for (int y = 0; y < kMedianSide; ++y) {
      const bool is_white = (pattern >> (kMedianSide - 1 - y) & 1) != 0;
      image(x, y) = is_white ? 255 : 0;
      white += is_white;
    }
  }

  GrayPlane image;
  std::vector<int> expected;  ///< medians of the squares
  int white = 0;
};

TEST(MedianFilter, IsRightForAllBlackAndWhiteSquaresAndThusForAllValues) {
  // The 0-1 principle: a network of exchanges that sorts all zeros and ones sorts all values.
  const Squares squares;
  test::for_each_simd_target([&] {
    const GrayPlane median = median_of(squares.image.view());
    EXPECT_TRUE(test::same_pixels(
        Squares::kCount, 1, [&](int i, int) { return squares.expected[i]; },
        [&](int i, int) { return static_cast<int>(median(kMedianSide * i + 2, 2)); }));
  });
}

TEST(MedianFilter, EqualsReferenceAtEverySizeOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 135; ++width) {
      for (const int height : {1, 2, 3, 4, 5, 9}) {
        const GrayPlane image = test::noise(width, height, 10 * width + height);
        EXPECT_TRUE(same_image(reference::median5(image), median_of(image.view())))
            << width << "x" << height;
      }
    }
  });
}

#ifdef MTSTEREO_TEST_OPENCV

GrayPlane median_by_opencv(GrayPlane image) {
  const cv::Mat in(image.height, image.width, CV_8UC1, image.pixels.data());
  cv::Mat out;
  cv::medianBlur(in, out, kMedianSide);
  GrayPlane median(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(out.ptr<std::uint8_t>(y), image.width, &median(0, y));
  }
  return median;
}

TEST(MedianFilter, EqualsOpenCv) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {4, 5}, {400, 90}}) {
    for (const int largest : {1, 3, 30, 255}) {
      const GrayPlane image = test::noise(width, height, largest, largest);
      EXPECT_TRUE(same_image(median_by_opencv(image), median_of(image.view(), 7)))
          << width << "x" << height << " of 0 .. " << largest;
    }
  }
}

#endif

TEST(MedianFilter, DoesNotDependOnBands) {
  const GrayPlane image = test::texture(61, 40, 2);
  const GrayPlane expected = reference::median5(image);
  for (int band = 1; band <= 41; ++band) {
    EXPECT_TRUE(same_image(expected, median_of(image.view(), band))) << "bands of " << band;
  }
}

TEST(MedianFilter, ReadsOnlyThePixelsOfAPaddedImage) {
  for (int padding = 0; padding < 70; padding += 3) {
    const GrayPlane image = test::noise(37 + padding, 8, padding);
    const test::PaddedImage<std::uint8_t> padded(image, padding, padding % 7);
    const GrayPlane expected = reference::median5(image);
    EXPECT_TRUE(same_image(expected, median_of(padded.view(), 3)));
    EXPECT_TRUE(padded.unchanged());
    GrayPlane turned(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
      std::copy_n(&expected(0, image.height - 1 - y), image.width, &turned(0, y));
    }
    EXPECT_TRUE(same_image(turned, median_of(padded.upside_down(), 3))) << "upside down";
  }
}

}  // namespace
}  // namespace mtstereo::median_filter_test

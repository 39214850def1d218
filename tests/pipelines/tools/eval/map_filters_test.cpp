// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/map_filters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace mtstereo::eval::map_filters_test {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

cv::Mat unknown(int width, int height) {
  return cv::Mat(height, width, CV_32FC1, cv::Scalar(kNoValue));
}

FilterSettings size_of(int speckle_size) {
  FilterSettings settings;
  settings.speckle_size = speckle_size;
  return settings;
}

int known_pixels(const cv::Mat& map) {
  return static_cast<int>(std::count_if(map.begin<float>(), map.end<float>(),
                                        [](float value) { return !std::isnan(value); }));
}

// Steps of 1/16 px with gaps; neighbors are often similar, so that there are components.
cv::Mat random_map(cv::RNG& random, int width, int height) {
  cv::Mat map(height, width, CV_32FC1);
  const int levels = random.uniform(1, 80);
  const int gaps = random.uniform(0, 101);
  for (float& value : cv::Mat_<float>(map)) {
    value = random.uniform(0, 100) < gaps ? kNoValue
                                          : static_cast<float>(random.uniform(0, levels)) / 16;
  }
  return map;
}

// The scalar reference: a flood fill from each pixel.
cv::Mat flood_fill_speckles(const cv::Mat& map, const FilterSettings& settings) {
  cv::Mat result = map.clone();
  cv::Mat seen = cv::Mat::zeros(map.size(), CV_8UC1);
  for (int i = 0; i < static_cast<int>(map.total()); ++i) {
    std::vector<cv::Point> component{{i % map.cols, i / map.cols}};
    if (std::isnan(map.at<float>(component[0])) || seen.at<std::uint8_t>(component[0])) continue;
    seen.at<std::uint8_t>(component[0]) = 1;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const cv::Point step : {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const cv::Point at = component[next] + step;
        if (!cv::Rect({}, map.size()).contains(at) || seen.at<std::uint8_t>(at)) continue;
        const float difference = std::abs(map.at<float>(at) - map.at<float>(component[next]));
        if (!(difference <= settings.speckle_tolerance)) continue;
        seen.at<std::uint8_t>(at) = 1;
        component.push_back(at);
      }
    }
    if (static_cast<int>(component.size()) >= settings.speckle_size) continue;
    for (const cv::Point at : component) result.at<float>(at) = kNoValue;
  }
  return result;
}

// The scalar reference: counts in the window of each pixel.
int brute_force_confidence(const cv::Mat& map, cv::Point at, const FilterSettings& settings) {
  if (std::isnan(map.at<float>(at))) return 0;
  const int radius = settings.support_radius;
  int window = 0, agreeing = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const cv::Point other = at + cv::Point(dx, dy);
      if (!cv::Rect({}, map.size()).contains(other)) continue;
      ++window;
      const double tolerance = settings.support_tolerance +
                               settings.support_slope * std::max(std::abs(dx), std::abs(dy));
      agreeing += std::abs(map.at<float>(other) - map.at<float>(at)) <= tolerance;
    }
  }
  return std::max(static_cast<int>(std::lround(255.0 * agreeing / window)), 1);
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return std::equal(a.begin<float>(), a.end<float>(), b.begin<float>(),
                    [](float u, float v) { return u == v || (std::isnan(u) && std::isnan(v)); });
}

TEST(RemoveSpeckles, KeepsComponentsOfAtLeastTheSize) {
  cv::Mat map = unknown(60, 40);
  map(cv::Rect(1, 1, 20, 10)).setTo(7);   // 200
  map(cv::Rect(30, 1, 20, 10)).setTo(9);  // 199
  map.at<float>(1, 30) = kNoValue;
  const cv::Mat result = remove_speckles(map, size_of(200));
  EXPECT_EQ(known_pixels(result), 200);
  EXPECT_EQ(result.at<float>(1, 1), 7);
  EXPECT_TRUE(std::isnan(result.at<float>(5, 40)));
}

TEST(RemoveSpeckles, DoesNotChangeItsInput) {
  cv::Mat map = unknown(10, 10);
  map.at<float>(5, 5) = 3;
  EXPECT_EQ(known_pixels(remove_speckles(map, size_of(200))), 0);
  EXPECT_EQ(known_pixels(map), 1);
}

TEST(RemoveSpeckles, ConnectsDisparitiesWithinTheTolerance) {
  const FilterSettings settings = size_of(4);
  for (const float step : {1.0F, 1.0625F}) {
    const cv::Mat map = (cv::Mat_<float>(1, 4) << 5, 5 + step, 5 + 2 * step, 5 + 3 * step);
    EXPECT_EQ(known_pixels(remove_speckles(map, settings)), step <= 1 ? 4 : 0) << step;
  }
}

TEST(RemoveSpeckles, DoesNotConnectDiagonally) {
  cv::Mat map = unknown(3, 3);
  for (int i = 0; i < 3; ++i) map.at<float>(i, i) = 5;
  EXPECT_EQ(known_pixels(remove_speckles(map, size_of(2))), 0);
}

TEST(RemoveSpeckles, RemovesNothingAtSizesUpTo1) {
  cv::Mat map = unknown(3, 3);
  map.at<float>(1, 1) = 5;
  for (const int size : {0, 1}) {
    EXPECT_EQ(known_pixels(remove_speckles(map, size_of(size))), 1) << size;
  }
}

TEST(RemoveSpeckles, MatchesAFloodFill) {
  cv::RNG random(3);
  for (int i = 0; i < 200; ++i) {
    const cv::Mat map = random_map(random, random.uniform(1, 40), random.uniform(1, 30));
    const FilterSettings settings = size_of(random.uniform(0, 60));
    EXPECT_TRUE(same(remove_speckles(map, settings), flood_fill_speckles(map, settings)))
        << "map " << i;
  }
}

TEST(SupportConfidence, IsFullOnAPlaneUpToTheImageBorder) {
  const cv::Mat map(12, 15, CV_32FC1, cv::Scalar(7));
  EXPECT_EQ(cv::countNonZero(support_confidence(map, {}) != 255), 0) << "corners too";
}

TEST(SupportConfidence, IsTheFractionOfTheWindow) {
  cv::Mat map = unknown(21, 21);
  map.at<float>(10, 10) = 7;  // the only one of 81
  map.at<float>(0, 0) = 7;    // the only one of the 25 inside the image
  const cv::Mat confidence = support_confidence(map, {});
  EXPECT_EQ(confidence.at<std::uint8_t>(10, 10), 3);
  EXPECT_EQ(confidence.at<std::uint8_t>(0, 0), 10);
  EXPECT_EQ(cv::countNonZero(confidence), 2);
}

TEST(SupportConfidence, AllowsLargerDifferencesAtLargerDistances) {
  FilterSettings settings;
  settings.support_radius = 2;
  const auto agree = [&](int distance, float difference) {
    cv::Mat map = unknown(5, 1);
    map.at<float>(0, 2) = 9;
    map.at<float>(0, 2 + distance) = 9 + difference;
    return support_confidence(map, settings).at<std::uint8_t>(0, 2) == 102;  // 2 of 5
  };
  EXPECT_TRUE(agree(1, 1.375F));
  EXPECT_FALSE(agree(1, 1.4375F));
  EXPECT_TRUE(agree(2, -1.8125F));
  EXPECT_FALSE(agree(2, -1.875F));
}

TEST(SupportConfidence, MatchesTheReferenceForEveryWindow) {
  cv::RNG random(4);
  for (int i = 0; i < 100; ++i) {
    const cv::Mat map = random_map(random, random.uniform(1, 30), random.uniform(1, 30));
    FilterSettings settings;
    settings.support_radius = random.uniform(0, 7);
    const cv::Mat confidence = support_confidence(map, settings);
    ASSERT_EQ(confidence.size(), map.size());
    for (int y = 0; y < map.rows; ++y) {
      for (int x = 0; x < map.cols; ++x) {
        ASSERT_EQ(int{confidence.at<std::uint8_t>(y, x)},
                  brute_force_confidence(map, {x, y}, settings))
            << "map " << i << " at " << x << "," << y;
      }
    }
  }
}

TEST(SupportConfidence, IsAtLeast1ForEveryDisparity) {
  FilterSettings settings;
  settings.support_radius = 20;
  cv::Mat map = unknown(41, 41);
  map.at<float>(20, 20) = 7;  // 1 of 1681 would round to 0
  EXPECT_EQ(support_confidence(map, settings).at<std::uint8_t>(20, 20), 1);
}

TEST(FilterSettings, AreThoseOfTheLibrary) {
  Parameters parameters;
  EXPECT_EQ(filter_settings(parameters).speckle_size, parameters.integer(Parameter::kSpeckleSize));
  ASSERT_TRUE(parameters.set(Parameter::kSpeckleSize, 77).ok());
  EXPECT_EQ(filter_settings(parameters).speckle_size, 77);
}

TEST(FilterSettings, AreReportedCompletely) {
  const std::string text = text_of(size_of(12345));
  for (const char* part : {"12345 px", "1 px", "9x9", "0.41 px"}) {
    EXPECT_THAT(text, ::testing::HasSubstr(part));
  }
}

}  // namespace
}  // namespace mtstereo::eval::map_filters_test

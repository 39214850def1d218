// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/map_filters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <vector>

#include "tools/eval/curve.hpp"

namespace mtstereo::eval {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kOnePixel = cv::StereoMatcher::DISP_SCALE;
constexpr std::int16_t kRemoved = -kOnePixel;

// OpenCV's fixed-point disparities, the input of filterSpeckles().
cv::Mat to_fixed_point(const cv::Mat& disparity) {
  cv::Mat result(disparity.size(), CV_16SC1);
  std::transform(disparity.begin<float>(), disparity.end<float>(), result.begin<std::int16_t>(),
                 [](float value) {
                   return std::isnan(value) ? kRemoved
                                            : cv::saturate_cast<std::int16_t>(value * kOnePixel);
                 });
  return result;
}

// The number of rows or columns of the window around `at` inside 0 .. size - 1.
int window_side(int at, int size, int radius) {
  return std::min(at + radius, size - 1) - std::max(at - radius, 0) + 1;
}

// For each pixel of row y, the number of window pixels that agree with it; `padded` has a border of
// `radius` NaNs.
void count_agreeing(const cv::Mat& padded, int y, const FilterSettings& settings,
                    std::vector<std::int32_t>& counts) {
  const int radius = settings.support_radius;
  const auto width = static_cast<int>(counts.size());
  const float* center = padded.ptr<float>(y + radius) + radius;
  std::fill(counts.begin(), counts.end(), 0);
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const float* other = padded.ptr<float>(y + radius + dy) + radius + dx;
      const auto tolerance =
          static_cast<float>(settings.support_tolerance +
                             settings.support_slope * std::max(std::abs(dx), std::abs(dy)));
      // A NaN on either side agrees with nothing.
      for (int x = 0; x < width; ++x) {
        counts[static_cast<std::size_t>(x)] += std::abs(other[x] - center[x]) <= tolerance ? 1 : 0;
      }
    }
  }
}

}  // namespace

FilterSettings filter_settings(const Parameters& parameters) {
  FilterSettings settings;
  settings.speckle_size = parameters.integer(Parameter::kSpeckleSize);
  return settings;
}

std::string text_of(const FilterSettings& settings) {
  const int side = 2 * settings.support_radius + 1;
  std::ostringstream text;
  text << std::setprecision(2);
  text << "components of fewer than " << std::to_string(settings.speckle_size)
       << " px removed (4 neighbors, " << settings.speckle_tolerance
       << " px), confidence = share of agreeing pixels in " << side << "x" << side << " ("
       << settings.support_tolerance << " px + " << settings.support_slope
       << " px per px of distance)";
  return text.str();
}

cv::Mat remove_speckles(const cv::Mat& disparity, const FilterSettings& settings) {
  cv::Mat fixed_point = to_fixed_point(disparity);
  // filterSpeckles() also removes components of exactly the given size.
  cv::filterSpeckles(fixed_point, kRemoved, settings.speckle_size - 1,
                     settings.speckle_tolerance * kOnePixel);
  cv::Mat result = disparity.clone();
  result.setTo(kNaN, fixed_point == kRemoved);
  return result;
}

cv::Mat support_confidence(const cv::Mat& disparity, const FilterSettings& settings) {
  const int radius = settings.support_radius;
  cv::Mat padded;
  cv::copyMakeBorder(disparity, padded, radius, radius, radius, radius, cv::BORDER_CONSTANT,
                     cv::Scalar(kNaN));
  cv::Mat result(disparity.size(), CV_8UC1);
  std::vector<std::int32_t> counts(static_cast<std::size_t>(disparity.cols));
  for (int y = 0; y < disparity.rows; ++y) {
    count_agreeing(padded, y, settings, counts);
    const int rows = window_side(y, disparity.rows, radius);
    auto* target = result.ptr<std::uint8_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      const int window = rows * window_side(x, disparity.cols, radius);
      const int agreeing = counts[static_cast<std::size_t>(x)];
      const long share = std::lround(static_cast<double>(kMostConfidence) * agreeing / window);
      target[x] = agreeing == 0 ? 0 : static_cast<std::uint8_t>(std::max(share, 1L));
    }
  }
  return result;
}

}  // namespace mtstereo::eval

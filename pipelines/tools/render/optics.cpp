// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/optics.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace mtstereo::render {
namespace {

constexpr double kStep = 0.5;  // between two blurred images; those between are interpolated [px]

cv::Mat blurred(const cv::Mat& light, double deviation) {
  if (deviation == 0) return light;
  cv::Mat result;
  cv::GaussianBlur(light, result, cv::Size(), deviation, deviation, cv::BORDER_REPLICATE);
  return result;
}

// Sets the pixels whose blur lies between those of the two images. The variance of a mixture of two
// Gaussians is the mean of their variances, so that this is what is interpolated.
void mix(const cv::Mat& sharper, double least, const cv::Mat& softer, double most, double center,
         double rim, cv::Mat& result) {
  const int channels = result.channels();
  for (int y = 0; y < result.rows; ++y) {
    const auto *a = sharper.ptr<float>(y), *b = softer.ptr<float>(y);
    auto* out = result.ptr<float>(y);
    for (int x = 0; x < result.cols; ++x) {
      const double deviation = center + rim * rim_share(result.size(), x, y);
      if (deviation < least) continue;
      const double share = (deviation * deviation - least * least) / (most * most - least * least);
      const auto weight = static_cast<float>(std::min(share, 1.0));
      for (int i = x * channels; i < (x + 1) * channels; ++i)
        out[i] = a[i] + weight * (b[i] - a[i]);
    }
  }
}

}  // namespace

double rim_share(const cv::Size& size, int x, int y) {
  const double center_x = (size.width - 1) / 2.0, center_y = (size.height - 1) / 2.0;
  const double from_center = std::hypot(x - center_x, y - center_y);
  const double corner = std::max(std::hypot(center_x, center_y), 1.0);
  return std::pow(from_center / corner, 2);
}

cv::Mat after_lens(const cv::Mat& light, double center, double rim) {
  cv::Mat sharper = blurred(light, center);
  if (rim == 0) return sharper;
  cv::Mat result(light.size(), light.type());
  const int steps = static_cast<int>(std::ceil(rim / kStep));
  double least = center;
  for (int step = 1; step <= steps; ++step) {
    const double most = center + rim * step / steps;
    const cv::Mat softer = blurred(light, most);
    // Later steps replace what lies farther out.
    mix(sharper, least, softer, most, center, rim, result);
    sharper = softer, least = most;
  }
  return result;
}

}  // namespace mtstereo::render

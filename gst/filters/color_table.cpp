// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/color_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace mtstereo::plugin {
namespace {

constexpr int kColors = 256;

/// The color map Turbo.
std::array<Rgb, kColors> turbo() {
  cv::Mat ramp(1, kColors, CV_8UC1);
  for (int i = 0; i < kColors; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat image;
  cv::applyColorMap(ramp, image, cv::COLORMAP_TURBO);
  std::array<Rgb, kColors> colors;
  for (int i = 0; i < kColors; ++i) {
    const auto& bgr = image.at<cv::Vec3b>(0, i);
    colors[static_cast<std::size_t>(i)] = {bgr[2], bgr[1], bgr[0]};
  }
  return colors;
}

/// The position of a depth between far (0) and near (1); beyond them less or more.
double position(const DepthColors& colors, double depth) {
  switch (colors.scale) {
    case ColorScale::kInverse:
      return (1 / depth - 1 / colors.far) / (1 / colors.near - 1 / colors.far);
    case ColorScale::kLinear:
      return (colors.far - depth) / (colors.far - colors.near);
    case ColorScale::kLog:
      return std::log(colors.far / depth) / std::log(colors.far / colors.near);
  }
  return 0;
}

}  // namespace

std::vector<Rgb> color_table(int max_disparity, int disparity_scale) {
  const std::array<Rgb, kColors> colors = turbo();
  std::vector<Rgb> table(65536);
  const double step = (kColors - 1) / (static_cast<double>(max_disparity) * disparity_scale);
  for (std::size_t value = 1; value < table.size(); ++value) {
    const int color =
        std::min(kColors - 1, static_cast<int>(std::lround(static_cast<double>(value) * step)));
    table[value] = colors[static_cast<std::size_t>(color)];
  }
  return table;
}

std::vector<Rgb> depth_color_table(const DepthColors& colors) {
  const std::array<Rgb, kColors> map = turbo();
  std::vector<Rgb> table(65536);
  for (std::size_t value = 1; value < table.size(); ++value) {
    const double share =
        std::clamp(position(colors, static_cast<double>(value) * colors.unit), 0.0, 1.0);
    table[value] = map[static_cast<std::size_t>(std::lround(share * (kColors - 1)))];
  }
  return table;
}

}  // namespace mtstereo::plugin

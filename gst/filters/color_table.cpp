// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/color_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace mtstereo::plugin {

std::vector<Rgb> color_table(int max_disparity, int disparity_scale) {
  constexpr int kColors = 256;
  cv::Mat ramp(1, kColors, CV_8UC1);
  for (int i = 0; i < kColors; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::Mat turbo;
  cv::applyColorMap(ramp, turbo, cv::COLORMAP_TURBO);

  std::vector<Rgb> table(65536);
  const double step = (kColors - 1) / (static_cast<double>(max_disparity) * disparity_scale);
  for (std::size_t value = 1; value < table.size(); ++value) {
    const int color =
        std::min(kColors - 1, static_cast<int>(std::lround(static_cast<double>(value) * step)));
    const auto& bgr = turbo.at<cv::Vec3b>(0, color);
    table[value] = {bgr[2], bgr[1], bgr[0]};
  }
  return table;
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "drawings.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace mtstereo::figures {
namespace {

cv::Mat to_color(const cv::Mat& image) {
  if (image.channels() == 3) return image;
  cv::Mat color;
  cv::cvtColor(image, color, cv::COLOR_GRAY2BGR);
  return color;
}

/// Colors that differ from one index to the next.
cv::Vec3b color_of(int index) {
  const auto channel = [&](int factor) {
    return static_cast<std::uint8_t>(70 + static_cast<unsigned>(index * factor + factor) % 186);
  };
  return {channel(67), channel(131), channel(193)};
}

}  // namespace

cv::Mat draw_levels(GrayView levels, int gray_levels) {
  cv::Mat image(levels.height, levels.width, CV_8UC1);
  for (int y = 0; y < levels.height; ++y) {
    for (int x = 0; x < levels.width; ++x) {
      image.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(levels.row(y)[x] * 255 / (gray_levels - 1));
    }
  }
  return image;
}

cv::Mat draw_tree(const MaxTrees& trees, int y, int bar_height) {
  const std::ptrdiff_t row = trees.first[y];
  const int count = trees.count[y];
  std::vector<int> depth(count, 0);
  std::vector<bool> leaf(count, true);
  for (int node = 0; node < count; ++node) {
    for (std::uint16_t up = trees.parent[row + node]; up != kNoNode; up = trees.parent[row + up]) {
      ++depth[node];
      leaf[up] = false;
    }
  }
  const int deepest = *std::max_element(depth.begin(), depth.end());
  cv::Mat image((deepest + 1) * bar_height, trees.width, CV_8UC3, cv::Scalar::all(255));
  for (int node = 0; node < count; ++node) {
    const double shade = 220 - 160.0 * depth[node] / std::max(deepest, 1);
    const cv::Scalar color = leaf[node] ? cv::Scalar(40, 40, 210) : cv::Scalar(shade, shade, shade);
    const cv::Rect bar(trees.begin[row + node], depth[node] * bar_height,
                       trees.end[row + node] - trees.begin[row + node] + 1, bar_height - 1);
    cv::rectangle(image, bar, color, cv::FILLED);
  }
  return image;
}

cv::Mat draw_nodes(const NodeLevel& level, const cv::Mat& gray) {
  cv::Mat image = to_color(gray) * 0.4;
  for (int y = 0; y < level.height; ++y) {
    for (int i = 0; i < level.count[y]; ++i) {
      const int begin = level.begin[level.first[y] + i];
      const int end = level.end[level.first[y] + i];
      // Colored by where a node begins, so that neighbors of a shape look alike.
      for (int x = begin; x <= end; ++x) image.at<cv::Vec3b>(y, x) = color_of(begin / 4);
    }
  }
  return image;
}

cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right) {
  const cv::Mat gap(left.rows, 6, CV_8UC3, cv::Scalar::all(255));
  cv::Mat image;
  cv::hconcat(std::vector<cv::Mat>{to_color(left), gap, to_color(right)}, image);
  return image;
}

}  // namespace mtstereo::figures

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/preprocess.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgproc.hpp>

namespace mtstereo {
namespace {

/// Mirrors an index that is at most one outside of 0 .. size - 1.
int mirror(int i, int size) {
  if (size == 1) return 0;
  if (i < 0) return 1;
  return i < size ? i : size - 2;
}

std::int16_t weighted(int value, int weight) {
  return static_cast<std::int16_t>((value * weight + 128) >> 8);
}

}  // namespace

void PreprocessedView::resize(int width, int height) {
  median.resize(width, height);
  level.resize(width, height);
  gray.resize(width, height);
  sobel_x.resize(width, height);
  sobel_y.resize(width, height);
}

LevelTable level_table(int gray_levels) {
  LevelTable table{};
  for (int edge = 0; edge <= kLargestEdge; ++edge) {
    const double inverted = 255 - edge / 2.0;
    const double stretched = std::clamp((inverted - 125) * 255 / 130, 0.0, 255.0);
    table[edge] = static_cast<std::uint8_t>(stretched * gray_levels / 256);
  }
  return table;
}

void median_rows(GrayView image, int y0, int y1, Image<std::uint8_t>& scratch,
                 Image<std::uint8_t>& median) {
  constexpr int kRadius = 2;
  const int top = std::max(y0 - kRadius, 0);
  const int bottom = std::min(y1 + kRadius, image.height);
  scratch.resize(image.width, bottom - top);
  // OpenCV takes no pointer to const; it only reads its input. A single row may have any stride.
  const cv::Mat in(bottom - top, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.row(top)),
                   image.height == 1 ? image.width : image.stride);
  cv::Mat out(bottom - top, image.width, CV_8UC1, scratch.row(0), scratch.stride());
  cv::medianBlur(in, out, 2 * kRadius + 1);
  for (int y = y0; y < y1; ++y) std::memcpy(median.row(y), scratch.row(y - top), image.width);
}

namespace {

/// Two rows of sums that a Sobel is made of, with one element before and one behind for the
/// mirrored border.
struct SobelSums {
  std::int16_t* smooth;      ///< vertical 1 2 1
  std::int16_t* difference;  ///< vertical -1 0 1

  int dx(int x) const { return smooth[x + 1] - smooth[x - 1]; }
  int dy(int x) const { return difference[x - 1] + 2 * difference[x] + difference[x + 1]; }
};

void sum_columns(GrayView image, int y, SobelSums sums) {
  const int width = image.width;
  const std::uint8_t* above = image.row(mirror(y - 1, image.height));
  const std::uint8_t* here = image.row(y);
  const std::uint8_t* below = image.row(mirror(y + 1, image.height));
  for (int x = 0; x < width; ++x) {
    sums.smooth[x] = static_cast<std::int16_t>(above[x] + 2 * here[x] + below[x]);
    sums.difference[x] = static_cast<std::int16_t>(below[x] - above[x]);
  }
  for (std::int16_t* row : {sums.smooth, sums.difference}) {
    row[-1] = row[mirror(-1, width)];
    row[width] = row[mirror(width, width)];
  }
}

void write_cost_row(GrayView image, int y, SobelSums sums, PreprocessedView& view) {
  const std::uint8_t* here = image.row(y);
  std::int16_t* gray = view.gray.row(y);
  std::int16_t* sobel_x = view.sobel_x.row(y);
  std::int16_t* sobel_y = view.sobel_y.row(y);
  for (int x = 0; x < image.width; ++x) {
    gray[x] = weighted(here[x], kCostWeights[0]);
    sobel_x[x] = weighted(sums.dx(x), kCostWeights[1]);
    sobel_y[x] = weighted(sums.dy(x), kCostWeights[2]);
  }
}

void write_level_row(const LevelTable& levels, int y, SobelSums sums, PreprocessedView& view) {
  std::uint8_t* level = view.level.row(y);
  const int width = view.level.width();
  for (int x = 0; x < width; ++x) {
    // The edge strength waits in `smooth`'s left neighbor, which is no longer needed.
    sums.smooth[x - 1] = static_cast<std::int16_t>(std::abs(sums.dx(x)) + std::abs(sums.dy(x)));
  }
  for (int x = 0; x < width; ++x) level[x] = levels[sums.smooth[x - 1]];
}

}  // namespace

void gradient_rows(const LevelTable& levels, GrayView cost_image, int y0, int y1,
                   Buffer<std::int16_t>& scratch, PreprocessedView& view) {
  const GrayView median = view.median.view();
  const int width = median.width;
  scratch.resize(2 * (width + 2));
  const SobelSums sums = {scratch.data() + 1, scratch.data() + width + 2 + 1};
  for (int y = y0; y < y1; ++y) {
    sum_columns(cost_image, y, sums);
    write_cost_row(cost_image, y, sums, view);
    if (cost_image.data != median.data) sum_columns(median, y, sums);
    write_level_row(levels, y, sums, view);
  }
}

}  // namespace mtstereo

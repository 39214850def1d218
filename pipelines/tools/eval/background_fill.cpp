// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/background_fill.hpp"

#include <algorithm>
#include <cmath>

namespace mtstereo::eval {
namespace {

// Fills one row. Returns false if it has no disparity.
bool fill_row(float* row, int width) {
  int last = -1;  // the last column with a disparity
  for (int x = 0; x < width; ++x) {
    if (std::isnan(row[x])) continue;
    const float side = last < 0 ? row[x] : std::min(row[last], row[x]);
    std::fill(row + last + 1, row + x, side);
    last = x;
  }
  if (last < 0) return false;
  std::fill(row + last + 1, row + width, row[last]);
  return true;
}

}  // namespace

cv::Mat fill_background(const cv::Mat& disparity) {
  cv::Mat filled = disparity.clone();
  int first = -1, last = -1;  // the rows with a disparity
  for (int y = 0; y < filled.rows; ++y) {
    if (!fill_row(filled.ptr<float>(y), filled.cols)) continue;
    if (first < 0) first = y;
    last = y;
  }
  if (first < 0) return filled;
  for (int y = 0; y < first; ++y) filled.row(first).copyTo(filled.row(y));
  for (int y = last + 1; y < filled.rows; ++y) filled.row(last).copyTo(filled.row(y));
  return filled;
}

}  // namespace mtstereo::eval

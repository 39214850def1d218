// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/inputs/mosaic.hpp"

#include <algorithm>
#include <array>

namespace mtstereo::run {

bool is_mosaic(const cv::Mat& frame) {
  // The means of the pixels at even and odd places in even and odd rows. On public views they
  // differ by at most 0.4 %, on mosaics of public views by at least 5 %.
  constexpr double kDifference = 0.02;
  constexpr double kVisible = 1;  // gray value
  std::array<double, 4> sums{};
  const int rows = frame.rows / 2 * 2, columns = frame.cols / 2 * 2;
  for (int y = 0; y < rows; ++y) {
    const auto* row = frame.ptr<unsigned char>(y);
    for (int x = 0; x < columns; ++x) sums[2 * (y % 2) + x % 2] += row[x];
  }
  const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
  const double pixels = std::max(1.0, rows / 2.0 * columns / 2.0);
  return *most - *least > std::max(kDifference * *most, kVisible * pixels);
}

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/left_strip.hpp"

#include <algorithm>

namespace mtstereo {
namespace {

void correct_row(int strip, int width, std::int32_t* disparity, std::uint8_t* confidence) {
  const auto believed = [&](int x) { return confidence[x] >= kBelievedStrip; };
  int x = strip;
  while (x < width && !believed(x)) ++x;
  std::int32_t surface = x < width ? disparity[x] : kNoDisparity;  // the next one to the right
  const auto doubted = [&](int i) { return !believed(i) && disparity[i] < surface / 2; };
  for (x = strip - 1; x >= 0; --x) {
    if (believed(x)) surface = disparity[x];
    if (surface == kNoDisparity || !doubted(x)) continue;
    const int end = x + 1;
    while (x > 0 && doubted(x - 1)) --x;
    const std::int32_t right = disparity[end];
    std::fill(disparity + x, disparity + end, x > 0 ? std::min(disparity[x - 1], right) : right);
    std::fill(confidence + x, confidence + end, std::uint8_t{1});
  }
}

}  // namespace

void correct_left_strip(int strip, int y0, int y1, Image<std::int32_t>& map,
                        Image<std::uint8_t>& confidence) {
  const int columns = std::clamp(strip, 0, map.width());
  for (int y = y0; y < y1; ++y) correct_row(columns, map.width(), map.row(y), confidence.row(y));
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "reference/pixels/gray_balance.hpp"

namespace mtstereo::reference {

/// The gray value of the left view for each of the right one.
using Grays = std::array<int, 256>;

inline Grays same_grays() {
  Grays grays;
  std::iota(grays.begin(), grays.end(), 0);
  return grays;
}

/// The mapping by the matched pixels of every 8th row: the median differences of 16 gray values
/// each, with straight lines in between; none up to a mean difference of 3, all of it from 6 on.
inline Grays map_grays(const test::GrayPlane& left, const test::GrayPlane& right,
                       const test::DisparityPlane& map) {
  struct Bin {
    std::vector<int> differences;
    long right = 0;
  };
  std::vector<Bin> bins(16);
  for (int y = 0; y < map.height; y += 8) {
    for (int x = 0; x < map.width; ++x) {
      const double partner = std::floor(x - map(x, y) / 256.0 + 0.5);
      if (map(x, y) == 0 || partner < 0) continue;
      const int seen = right(static_cast<int>(partner), y);
      bins[seen / 16].differences.push_back(left(x, y) - seen);
      bins[seen / 16].right += seen;
    }
  }
  std::erase_if(bins, [](const Bin& bin) { return bin.differences.size() < 16; });
  float pixels = 0, difference = 0;
  std::vector<std::pair<float, float>> points;  // mean gray value of the right view, difference
  for (const Bin& bin : bins) {
    const auto count = static_cast<float>(bin.differences.size());
    const auto median = static_cast<float>(middle_of(bin.differences));
    pixels += count;
    difference += count * std::abs(median);
    points.emplace_back(static_cast<float>(bin.right) / count, median);
  }
  Grays grays = same_grays();
  if (pixels < 256) return grays;
  const float mean = difference / pixels;
  const float share = std::clamp((mean - 3) / 3, 0.0F, 1.0F);
  for (int& gray : grays) {
    const auto value = static_cast<float>(gray);
    const auto after = std::find_if(points.begin(), points.end(),
                                    [&](const auto& point) { return point.first >= value; });
    float at = after == points.end() ? points.back().second : after->second;
    if (after != points.end() && after != points.begin()) {
      const auto& [from, first] = *(after - 1);
      at = first + (value - from) / (after->first - from) * (after->second - first);
    }
    gray = static_cast<int>(std::clamp(std::lround(value + share * at), 0L, 255L));
  }
  return grays;
}

inline test::GrayPlane mapped(const test::GrayPlane& right, const Grays& grays) {
  test::GrayPlane out = right;
  for (std::uint8_t& gray : out.pixels) gray = static_cast<std::uint8_t>(grays[gray]);
  return out;
}

}  // namespace mtstereo::reference

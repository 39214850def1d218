// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "reference/refine/gap_filling.hpp"

namespace mtstereo::reference {

/// The gray value of the left view for each of the right one.
using Grays = std::array<int, 256>;

inline Grays same_grays() {
  Grays grays;
  std::iota(grays.begin(), grays.end(), 0);
  return grays;
}

/// The mapping by the matched pixels of every 16th row: the mean differences of 16 gray values
/// each, with straight lines in between; none up to a mean difference of 3, all of it from 6 on.
inline Grays map_grays(const GrayPlane& left, const GrayPlane& right, const ConfidentMap& in) {
  struct Sum {
    long pixels = 0, left = 0, right = 0;
  };
  std::vector<Sum> sums(16);
  for (int y = 0; y < in.map.height; y += 16) {
    for (int x = 0; x < in.map.width; ++x) {
      if (in.confidence(x, y) <= 15) continue;
      const double partner = std::floor(x - in.map(x, y) / 256.0 + 0.5);
      if (partner < 0 || partner >= right.width) continue;
      const int seen = right(static_cast<int>(partner), y);
      Sum& sum = sums[seen / 16];
      sum = {sum.pixels + 1, sum.left + left(x, y), sum.right + seen};
    }
  }
  std::erase_if(sums, [](const Sum& sum) { return sum.pixels < 16; });
  long pixels = 0, difference = 0;
  std::vector<std::pair<float, float>> points;  // mean gray value of the right view, difference
  for (const Sum& sum : sums) {
    pixels += sum.pixels;
    difference += std::abs(sum.left - sum.right);
    const auto count = static_cast<float>(sum.pixels);
    points.emplace_back(sum.right / count, (sum.left - sum.right) / count);
  }
  Grays grays = same_grays();
  if (pixels < 256) return grays;
  const float mean = static_cast<float>(difference) / static_cast<float>(pixels);
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

}  // namespace mtstereo::reference

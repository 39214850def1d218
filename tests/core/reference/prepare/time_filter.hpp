// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/plane.hpp"

namespace mtstereo::reference {

/// The means of a view over time. Blocks are 8x8 pixels.
struct PastView {
  test::Plane<int> mean;  ///< [1/16 gray values]
  GrayPlane filtered;     ///< the same in gray values
  GrayPlane trust;        ///< per block: that it has not, 0 .. 128
  GrayPlane frames;       ///< per block: in its means [1/16]
};

/// The means of both views.
struct PastViews {
  std::array<PastView, 2> views;
  bool averaged = false;  ///< those of the present pair are averages
  bool followed = false;  ///< along the motion of the camera
};

/// The sum of the differences of each block from the last filtered view, and that of their
/// magnitudes, as of 64 pixels.
struct Changes {
  test::Plane<int> sum, magnitude;
};

inline Changes changes(const GrayPlane& view, const GrayPlane& filtered) {
  const int columns = (view.width + 7) / 8, rows = (view.height + 7) / 8;
  Changes found{{columns, rows}, {columns, rows}};
  test::Plane<int> pixels(columns, rows);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int difference = view(x, y) - filtered(x, y);
      found.sum(x / 8, y / 8) += difference;
      found.magnitude(x / 8, y / 8) += std::abs(difference);
      ++pixels(x / 8, y / 8);
    }
  }
  for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
    found.sum.pixels[i] = found.sum.pixels[i] * 64 / pixels.pixels[i];
    found.magnitude.pixels[i] = found.magnitude.pixels[i] * 64 / pixels.pixels[i];
  }
  return found;
}

/// Decides which blocks are still, and returns their share.
inline double rate_changes(const GrayPlane& view, float noise, PastView& past) {
  const Changes found = changes(view, past.filtered);
  std::vector<int> sorted;
  for (const int sum : found.sum.pixels) sorted.push_back(std::abs(sum));
  std::sort(sorted.begin(), sorted.end());
  const float median = static_cast<float>(sorted[sorted.size() / 2]);
  const float deviation =
      std::clamp(1.48F * median, 4.0F, std::max(1.2F * 1.414F * 8 * noise + 8, 4.0F));
  const long limit = static_cast<long>(6 * deviation);
  past.trust = GrayPlane(past.frames.width, past.frames.height);
  double count = 0;
  for (std::size_t i = 0; i < found.sum.pixels.size(); ++i) {
    const float frames = past.frames.pixels[i] / 16.0F;
    const float most = 64 * (1.04F * (noise * std::sqrt(1 + 1 / frames)) + 0.5F);
    if (static_cast<float>(found.magnitude.pixels[i]) > most) continue;
    const long sum = std::min<long>(std::abs(found.sum.pixels[i]), limit);
    const int rest = static_cast<int>(128 * (limit * limit - sum * sum) / (limit * limit));
    past.trust.pixels[i] = static_cast<std::uint8_t>(rest * rest / 128);
    ++count;
  }
  return count / static_cast<double>(found.sum.pixels.size());
}

/// Adds a view to the means, or begins anew with it.
inline void average(const GrayPlane& view, bool anew, PastView& past) {
  const int columns = (view.width + 7) / 8, rows = (view.height + 7) / 8;
  const GrayPlane before = past.frames;
  past.frames = GrayPlane(columns, rows, 16);
  if (anew) {
    past.mean = test::Plane<int>(view.width, view.height);
    past.filtered = GrayPlane(view.width, view.height);
  }
  for (int v = 0; v < rows && !anew; ++v) {
    for (int u = 0; u < columns; ++u) {
      int trust = 128;
      for (int j = v - 1; j <= v + 1; ++j) {
        for (int i = u - 1; i <= u + 1; ++i) trust = std::min<int>(trust, past.trust.clamped(i, j));
      }
      const int kept = std::min<int>(before(u, v), 7 * 16);
      past.frames(u, v) = static_cast<std::uint8_t>(16 + kept * trust / 128);
    }
  }
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int weight = 16384 * 16 / past.frames(x / 8, y / 8);
      int& mean = past.mean(x, y);
      mean += static_cast<int>(std::floor((16 * view(x, y) - mean) * weight / 16384.0 + 0.5));
      past.filtered(x, y) = static_cast<std::uint8_t>((mean + 8) / 16);
    }
  }
}

}  // namespace mtstereo::reference

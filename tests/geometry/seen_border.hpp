// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::test {

/// The part of the rectified pixels on the border of the image that the camera sees.
inline double seen_border(const StereoCalibration& rig, const Rectification& r,
                          Rectifier::Side side) {
  const auto rectifier = Rectifier::create(rig, r, side);
  EXPECT_TRUE(rectifier.ok());
  const CameraCalibration& camera = side == Rectifier::Side::kLeft ? rig.left : rig.right;
  int seen = 0;
  int all = 0;
  for (int y = 0; y < r.height; ++y) {
    for (int x = 0; x < r.width; x += y == 0 || y == r.height - 1 ? 1 : r.width - 1) {
      const auto [u, v] = rectifier->source_of(x, y);
      ++all;
      if (u > -0.5 && v > -0.5 && u < camera.width - 0.5 && v < camera.height - 0.5) ++seen;
    }
  }
  return static_cast<double>(seen) / all;
}

}  // namespace mtstereo::test

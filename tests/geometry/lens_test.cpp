// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/lens.hpp"

#include <gtest/gtest.h>

#include "opencv_camera.hpp"
#include "rigs.hpp"

namespace mtstereo::test {
namespace {

TEST(Lens, ProjectsLikeOpenCv) {
  for (const StereoCalibration& rig : all_rigs()) {
    const Lens lens(rig.left);
    for (double x = -0.7; x <= 0.7; x += 0.1) {
      for (double y = -0.5; y <= 0.5; y += 0.1) {
        const Vector3 point = {2 * x, 2 * y, 2};
        const cv::Point2d expected = opencv_projection(rig.left, point);
        const auto actual = lens.project(point);
        ASSERT_NEAR(actual[0], expected.x, 1e-9) << x << " " << y;
        ASSERT_NEAR(actual[1], expected.y, 1e-9) << x << " " << y;
      }
    }
  }
}

TEST(Lens, DirectionsAreTheInverseOfPositions) {
  for (const StereoCalibration& rig : all_rigs()) {
    const Lens lens(rig.left);
    for (double u = 0; u < rig.left.width; u += 31.5) {
      for (double v = 0; v < rig.left.height; v += 23.5) {
        const Vector3 direction = lens.direction(u, v);
        EXPECT_NEAR(std::hypot(direction[0], direction[1], direction[2]), 1, 1e-12);
        const auto back = lens.project(direction);
        ASSERT_NEAR(back[0], u, 1e-6) << rig.left.coefficients.size() << ": " << u << " " << v;
        ASSERT_NEAR(back[1], v, 1e-6) << rig.left.coefficients.size() << ": " << u << " " << v;
      }
    }
  }
}

TEST(Lens, FisheyeSeesToTheSide) {
  // Equidistant: the distance to the center is the focal length times the angle, here 100 degrees.
  const CameraCalibration fisheye = camera(1000, 1000, 200, LensModel::kFisheye, {0, 0, 0, 0});
  const double angle = 100 * std::numbers::pi / 180;
  const auto at = Lens(fisheye).project({std::sin(angle), 0, std::cos(angle)});
  EXPECT_NEAR(at[0], fisheye.center_x + 200 * angle, 1e-9);
  EXPECT_NEAR(at[1], fisheye.center_y, 1e-9);
  const Vector3 direction = Lens(fisheye).direction(at[0], at[1]);
  EXPECT_NEAR(direction[2], std::cos(angle), 1e-9);
}

TEST(Lens, DirectionsBehindAPolynomialLensHaveNoPosition) {
  const Lens lens(plumb_bob_rig().left);
  EXPECT_TRUE(std::isnan(lens.project({0.1, 0.1, -1})[0]));
  EXPECT_TRUE(std::isnan(lens.project({1, 0, 0})[0]));
}

TEST(Lens, DirectionsWhereThePolynomialTurnsBackHaveNoPosition) {
  // r (1 - 0.4 r^2) has its largest value at r = 0.913.
  const CameraCalibration strong = camera(640, 480, 400, LensModel::kPlumbBob, {-0.4, 0, 0, 0, 0});
  const Lens lens(strong);
  EXPECT_FALSE(std::isnan(lens.project({0.9, 0, 1})[0]));
  EXPECT_TRUE(std::isnan(lens.project({0.95, 0, 1})[0]));
  EXPECT_TRUE(std::isnan(lens.project({1.5, 0, 1})[0]));
  // No direction leads to this position.
  EXPECT_TRUE(std::isnan(lens.direction(strong.center_x + 400 * 0.7, strong.center_y)[0]));
}

}  // namespace
}  // namespace mtstereo::test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometry/lens.hpp"

#include <gtest/gtest.h>

#include "opencv_camera.hpp"
#include "rigs.hpp"

namespace mtstereo::test::lens_test {
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

/// gamma of Mei's model for the focal lengths of the middle.
CameraCalibration omnidirectional(double gamma_x, double gamma_y, double center_x, double center_y,
                                  std::vector<double> coefficients) {
  CameraCalibration result =
      camera(752, 480, 1, LensModel::kOmnidirectional, std::move(coefficients));
  result.focal_x = gamma_x / (1 + result.coefficients[0]);
  result.focal_y = gamma_y / (1 + result.coefficients[0]);
  result.center_x = center_x;
  result.center_y = center_y;
  return result;
}

TEST(Lens, OmnidirectionalProjectsAsOmnidirOfOpenCv) {
  // The positions are those of cv::omnidir::projectPoints().
  const struct {
    CameraCalibration camera;
    std::array<std::array<double, 2>, 5> positions;
  } cases[] = {
      {omnidirectional(2138.76, 2131.58, 361.2, 248.28,
                       {3.6313, 1.17577, 15.4913, -0.000812, 0.000673}),
       {{{361.2, 248.28},
         {452.06427482, 202.99810832},
         {155.85653138, 411.99481628},
         {472.22453441, 580.0848554},
         {-23.34955543, 324.88767381}}}},
      {omnidirectional(834.06, 831.41, 374.32, 254.22,
                       {0.81262, -0.34248, 0.17109, -0.00066653, 0.00072311}),
       {{{374.32, 254.22},
         {464.90977987, 209.06524771},
         {169.59269268, 417.47370026},
         {485.13524889, 585.13740339},
         {-9.01851645, 330.53188696}}}},
  };
  constexpr Vector3 kPoints[] = {
      {0, 0, 1}, {0.2, -0.1, 1}, {-0.5, 0.4, 1}, {0.3, 0.9, 1}, {-1, 0.2, 0.9}};
  for (const auto& [camera, positions] : cases) {
    const Lens lens(camera);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto at = lens.project(kPoints[i]);
      EXPECT_NEAR(at[0], positions[i][0], 1e-7);
      EXPECT_NEAR(at[1], positions[i][1], 1e-7);
      const Vector3 back = lens.direction(at[0], at[1]);
      const double scale = kPoints[i][2] / back[2];
      EXPECT_NEAR(back[0] * scale, kPoints[i][0], 1e-9);
      EXPECT_NEAR(back[1] * scale, kPoints[i][1], 1e-9);
    }
  }
}

TEST(Lens, OmnidirectionalSeesToTheSideUpToItsOutline) {
  const auto at = [](double xi, double angle) {
    const double radians = angle * std::numbers::pi / 180;
    const Lens lens(omnidirectional(300, 300, 376, 240, {xi, 0, 0, 0, 0}));
    const auto position = lens.project({std::sin(radians), 0, std::cos(radians)});
    if (std::isnan(position[0])) return -1.0;
    const Vector3 back = lens.direction(position[0], position[1]);
    return std::atan2(back[0], back[2]) * 180 / std::numbers::pi;
  };
  EXPECT_NEAR(at(0.8, 100), 100, 1e-6);
  // The plane of xi is reached at acos(-0.8) = 143 degrees; the model ends a little before.
  EXPECT_EQ(at(0.8, 144), -1);
  // From outside of the sphere, its outline is at acos(-1 / 2) = 120 degrees.
  EXPECT_NEAR(at(2, 119), 119, 1e-6);
  EXPECT_EQ(at(2, 121), -1);
  EXPECT_NEAR(Lens(omnidirectional(300, 300, 376, 240, {2, 0, 0, 0, 0})).widest_angle(),
              120 * std::numbers::pi / 180, 1e-3);
  EXPECT_NEAR(at(0, 60), 60, 1e-9);
  EXPECT_EQ(at(0, 91), -1);
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
}  // namespace mtstereo::test::lens_test

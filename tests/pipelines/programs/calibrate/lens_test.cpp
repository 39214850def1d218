// SPDX-License-Identifier: LGPL-2.1-or-later

// Lens models against OpenCV's, and their inverse.

#include "programs/calibrate/lens.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "support.hpp"

namespace mtstereo::calibrate::lens_test {
namespace {

using testing::fisheye_rig;
using testing::plumb_bob_rig;

cv::Point2d projected_by_opencv(const Camera& camera, const Eigen::Vector3d& point) {
  const auto& v = camera.values;
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << v[0], 0, v[2], 0, v[1], v[3], 0, 0, 1);
  const std::vector<double> coefficients(v.begin() + kPinholeParameters,
                                         v.begin() + parameter_count(camera.model));
  const std::vector<cv::Point3d> points{{point.x(), point.y(), point.z()}};
  std::vector<cv::Point2d> pixels;
  if (camera.model == Model::kFisheye) {
    cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), matrix, coefficients);
  } else {
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix, coefficients, pixels);
  }
  return pixels.front();
}

Camera rational_camera() {
  Camera camera = ideal_camera(Model::kRational, 640, 480, 380);
  const double coefficients[] = {0.6, 0.05, 0.001, -0.0005, 0.001, 0.9, 0.15, 0.005};
  std::copy(std::begin(coefficients), std::end(coefficients), camera.values.begin() + 4);
  return camera;
}

TEST(Lens, ProjectsAsOpenCvDoes) {
  for (const Camera& camera : {plumb_bob_rig().left, fisheye_rig().right, rational_camera()}) {
    for (const double x : {-0.5, 0.0, 0.3}) {
      for (const double y : {-0.4, 0.0, 0.2}) {
        const Eigen::Vector3d point(x, y, 1.1);
        const auto pixel = camera.project(point);
        ASSERT_TRUE(pixel);
        const cv::Point2d expected = projected_by_opencv(camera, point);
        EXPECT_NEAR(pixel->x(), expected.x, 1e-6) << model_name(camera.model);
        EXPECT_NEAR(pixel->y(), expected.y, 1e-6) << model_name(camera.model);
      }
    }
  }
}

TEST(Lens, HasTheDerivativesOfItsImages) {
  constexpr double kStep = 1e-6;
  for (const Camera& camera : {plumb_bob_rig().left, fisheye_rig().right, rational_camera()}) {
    for (const double x : {-0.5, 0.0, 0.3}) {
      const Eigen::Vector3d point(x, 0.4 * x, 1.1);
      const auto image = camera.linearize(point);
      ASSERT_TRUE(image);
      EXPECT_EQ(image->pixel, *camera.project(point));
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
        const Eigen::Vector2d change =
            *camera.project(point + step) - *camera.project(point - step);
        EXPECT_LT((change / (2 * kStep) - image->by_point.col(i)).norm(), 1e-4)
            << model_name(camera.model) << " at " << x << ", coordinate " << i;
      }
      for (int i = 0; i < parameter_count(camera.model); ++i) {
        Camera more = camera, less = camera;
        more.values[i] += kStep, less.values[i] -= kStep;
        const Eigen::Vector2d change = *more.project(point) - *less.project(point);
        EXPECT_LT((change / (2 * kStep) - image->by_values.col(i)).norm(), 1e-4)
            << model_name(camera.model) << " at " << x << ", parameter " << i;
      }
    }
  }
}

TEST(Lens, RaysGoThroughTheirPixels) {
  for (const Camera& camera : {plumb_bob_rig().left, fisheye_rig().left, rational_camera()}) {
    for (int y = 0; y < 480; y += 40) {
      for (int x = 0; x < 640; x += 40) {
        const auto ray = camera.ray({x, y});
        ASSERT_TRUE(ray) << model_name(camera.model) << " " << x << " " << y;
        EXPECT_NEAR(ray->norm(), 1, 1e-9);
        const auto pixel = camera.project(*ray);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x(), x, 1e-3);
        EXPECT_NEAR(pixel->y(), y, 1e-3);
      }
    }
  }
}

TEST(Lens, PointsBehindAPinholeHaveNoImage) {
  const Camera camera = plumb_bob_rig().left;
  EXPECT_FALSE(camera.project({0, 0, -1}));
  EXPECT_FALSE(camera.project({0.1, 0, 0}));
  EXPECT_TRUE(fisheye_rig().left.project({1, 0, -0.1}));
  EXPECT_FALSE(fisheye_rig().left.project({0, 0, -1}));
}

TEST(Lens, PixelsBeyondTheFoldHaveNoRay) {
  Camera camera = ideal_camera(Model::kPlumbBob, 640, 480, 300);
  camera.values[4] = -0.4;  // x (1 - 0.4 x^2) is never more than 0.61
  EXPECT_TRUE(camera.ray({320 + 0.5 * 300, 240}));
  EXPECT_FALSE(camera.ray({320 + 0.9 * 300, 240}));
  camera = ideal_camera(Model::kFisheye, 640, 480, 300);
  camera.values[4] = -0.2;  // the same, never more than 0.86
  EXPECT_TRUE(camera.ray({320 + 0.7 * 300, 240}));
  EXPECT_FALSE(camera.ray({320 + 1.0 * 300, 240}));
}

TEST(Lens, CalibrationHasTheParameters) {
  const Rig rig = fisheye_rig();
  const StereoCalibration calibration = calibration_of(rig);
  EXPECT_EQ(calibration.left.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.left.coefficients.size(), 4U);
  EXPECT_EQ(calibration.right.focal_x, rig.right.values[0]);
  EXPECT_EQ(calibration.translation[0], -0.12);
  EXPECT_EQ(calibration.rotation[1], rig.right_from_left.rotation(0, 1));
  EXPECT_EQ(calibration_of(plumb_bob_rig()).left.coefficients.size(), 5U);
}

}  // namespace
}  // namespace mtstereo::calibrate::lens_test

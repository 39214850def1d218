// SPDX-License-Identifier: LGPL-2.1-or-later
// The mapping between pixels and rays, compared with that of OpenCV.
#include "tools/render/lens.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/render/raw.hpp"

namespace mtstereo::render::lens_test {
namespace {

CameraCalibration camera(LensModel lens, std::vector<double> coefficients) {
  CameraCalibration c;
  c.width = 640, c.height = 480;
  c.focal_x = 420, c.focal_y = 431;
  c.center_x = 325.3, c.center_y = 233.8;
  c.lens = lens;
  c.coefficients = std::move(coefficients);
  return c;
}

CameraCalibration fisheye() { return camera(LensModel::kFisheye, {-0.02, 0.005, -0.002, 0.0002}); }

std::vector<CameraCalibration> cameras() {
  std::vector<CameraCalibration> all = {
      camera(LensModel::kNone, {}),
      camera(LensModel::kPlumbBob, {-0.28, 0.07, 0.001, -0.0006}),
      camera(LensModel::kPlumbBob, {0.12, -0.05, 0.0008, 0.0011, 0.02}),
      camera(LensModel::kPlumbBob, {5.1, 2.4, 0.0003, -0.0002, 0.11, 5.4, 3.9, 0.71}),
      camera(LensModel::kPlumbBob,
             {-0.2, 0.05, 0.001, 0.001, 0, 0.01, 0.002, 0.001, 0.002, -0.001, -0.0015, 0.0007}),
      camera(LensModel::kPlumbBob, {-0.2, 0.05, 0.001, 0.001, 0, 0.01, 0.002, 0.001, 0.002, -0.001,
                                    -0.0015, 0.0007, 0.03, -0.05}),
      fisheye(),
  };
  all.back().focal_x = all.back().focal_y = 300;  // 120 degrees across
  Settings s;
  s.width = 640, s.height = 480, s.focal = 540, s.baseline = 0.1;
  for (const std::string& name : rig_names()) {
    all.push_back(built_in_rig(name, s).left);
    all.push_back(built_in_rig(name, s).right);
  }
  return all;
}

cv::Point2d project_by_opencv(const CameraCalibration& c, const Eigen::Vector3d& point) {
  const cv::Matx33d k(c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1);
  const std::vector<cv::Point3d> points = {{point.x(), point.y(), point.z()}};
  const cv::Vec3d zero(0, 0, 0);
  std::vector<cv::Point2d> pixels;
  if (c.lens == LensModel::kFisheye) {
    cv::fisheye::projectPoints(points, pixels, zero, zero, k, c.coefficients);
  } else {
    cv::projectPoints(points, zero, zero, k, c.coefficients, pixels);
  }
  return pixels[0];
}

class Lenses : public ::testing::TestWithParam<CameraCalibration> {};

TEST_P(Lenses, RayOfAPixelIsSeenByOpenCvAtThatPixel) {
  const Lens lens(GetParam(), "the camera");
  for (double y = -0.5; y <= 480; y += 20.17) {
    for (double x = -0.5; x <= 640; x += 20.31) {
      const Eigen::Vector3d ray = lens.ray(x, y);
      EXPECT_EQ(ray.z(), 1);
      const cv::Point2d seen = project_by_opencv(GetParam(), 3.7 * ray);
      ASSERT_NEAR(seen.x, x, 1e-9) << "at " << x << ", " << y;
      ASSERT_NEAR(seen.y, y, 1e-9) << "at " << x << ", " << y;
      ASSERT_TRUE(lens.sees(ray) || x < 0 || y < 0 || x > 639 || y > 479);
    }
  }
}

TEST_P(Lenses, PixelOfAPointIsThatOfOpenCv) {
  const Lens lens(GetParam(), "the camera");
  for (double y = -0.4; y <= 0.4; y += 0.057) {
    for (double x = -0.6; x <= 0.6; x += 0.057) {
      const Eigen::Vector3d point(2.5 * x, 2.5 * y, 2.5);
      const cv::Point2d seen = lens.pixel(point), expected = project_by_opencv(GetParam(), point);
      ASSERT_NEAR(seen.x, expected.x, 1e-9);
      ASSERT_NEAR(seen.y, expected.y, 1e-9);
    }
  }
}

TEST_P(Lenses, MagnificationIsTheAreaOfPixels) {
  const Lens lens(GetParam(), "the camera");
  constexpr double kStep = 1e-4;
  for (const cv::Point2d at : {cv::Point2d(20, 30), cv::Point2d(333, 222), cv::Point2d(600, 400)}) {
    const Eigen::Vector3d ray = lens.ray(at.x, at.y);
    const Eigen::Vector3d right = lens.ray(at.x + kStep, at.y),
                          below = lens.ray(at.x, at.y + kStep);
    const double area = (right - ray).cross(below - ray).norm() / (kStep * kStep);
    // The tilt of a sensor is not part of it.
    const bool tilted = GetParam().coefficients.size() == 14;
    EXPECT_NEAR(lens.magnification(ray) * area, 1, tilted ? 0.2 : 2e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lenses, ::testing::ValuesIn(cameras()),
                         [](const auto& info) { return "Camera" + std::to_string(info.index); });

TEST(Lens, DoesNotSeePointsOutsideOfItsField) {
  const Lens lens(camera(LensModel::kPlumbBob, {-0.1, 0, 0, 0}), "the camera");
  EXPECT_TRUE(lens.sees({0, 0, 1}));
  EXPECT_FALSE(lens.sees({0, 0, -1}));
  EXPECT_FALSE(lens.sees({1.2, 0, 1}));
  // The polynomial maps this direction into the image.
  const Eigen::Vector3d far(3, 0, 1);
  const cv::Point2d at = lens.pixel(far);
  ASSERT_TRUE(at.x > 0 && at.x < 639 && at.y > 0 && at.y < 479) << at;
  EXPECT_FALSE(lens.sees(far));
}

TEST(Lens, MarginIsInsideOfTheImage) {
  const Lens lens(camera(LensModel::kNone, {}), "the camera");
  EXPECT_TRUE(lens.sees(lens.ray(4, 200), 3));
  EXPECT_FALSE(lens.sees(lens.ray(2, 200), 3));
}

TEST(Lens, FisheyeReachesSixtyDegreesFromTheAxis) {
  Settings s;
  s.width = 640, s.height = 480, s.baseline = 0.1;
  const CameraCalibration c = built_in_rig("fisheye", s).left;
  const Eigen::Vector3d ray = Lens(c, "the camera").ray(c.center_x - 320, c.center_y);
  EXPECT_NEAR(std::atan(ray.head<2>().norm()) * 180 / M_PI, 60, 1e-6);
}

struct Bad {
  const char* says;
  void (*spoil)(CameraCalibration&);
};

TEST(Lens, RefusesInvalidCamerasByName) {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  const Bad cases[] = {
      {"width", [](CameraCalibration& c) { c.width = 0; }},
      {"height", [](CameraCalibration& c) { c.height = -1; }},
      {"focal length", [](CameraCalibration& c) { c.focal_x = 0; }},
      {"focal length", [](CameraCalibration& c) { c.focal_y = kNotANumber; }},
      {"principal point", [](CameraCalibration& c) { c.center_x = kNotANumber; }},
      {"4, 5, 8, 12 or 14",
       [](CameraCalibration& c) {
         c.coefficients = {0.1, 0.2};
       }},
      {"finite", [](CameraCalibration& c) { c.coefficients[1] = kNotANumber; }},
      {"cannot be inverted",
       [](CameraCalibration& c) {
         c.coefficients = {-0.9, 0, 0, 0};
       }},
      {"cannot be inverted",
       [](CameraCalibration& c) { c.coefficients = {0, 0, 0, 0, 0, 2.5, 0, 0}; }},
      {"tilted",
       [](CameraCalibration& c) {
         c.coefficients = std::vector<double>(14, 0.0);
         c.coefficients[12] = 1.5707963;
       }},
      {"85 degrees",
       [](CameraCalibration& c) { c = camera(LensModel::kNone, {}), c.focal_x = 20; }},
      {"85 degrees", [](CameraCalibration& c) { c = fisheye(), c.focal_x = 100; }},
      {"cannot be inverted",
       [](CameraCalibration& c) {
         c = fisheye(), c.coefficients = {-0.6, 0, 0, 0};
       }},
      {"4 distortion", [](CameraCalibration& c) { c = fisheye(), c.coefficients = {0.1}; }},
      {"no distortion", [](CameraCalibration& c) { c.lens = LensModel::kNone; }},
  };
  for (const Bad& bad : cases) {
    CameraCalibration c = camera(LensModel::kPlumbBob, {-0.2, 0.05, 0, 0});
    bad.spoil(c);
    try {
      const Lens lens(c, "the right camera");
      ADD_FAILURE() << "accepted: " << bad.says;
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(bad.says), std::string::npos) << text;
      EXPECT_EQ(text.find("the right camera: "), 0U) << text;
    }
  }
}

}  // namespace
}  // namespace mtstereo::render::lens_test

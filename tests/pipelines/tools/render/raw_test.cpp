// SPDX-License-Identifier: LGPL-2.1-or-later
// Raw cameras: their views, corrected by OpenCV, are those of ideal cameras, and the ground truth
// of any rectification is exact.
#include "tools/render/raw.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "support/error_of.hpp"
#include "support/wall_scene.hpp"
#include "tools/render/lens.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::render::raw_test {
namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Settings camera(int width = 240, int height = 160) {
  Settings s;
  s.width = width, s.height = height, s.noise = 0, s.samples = 2;
  s.focal = 0.85 * width, s.baseline = 0.1;
  return s;
}

// A rectification by hand: x along the baseline, z in between.
Rectification rectification_for(const StereoCalibration& c, double focal) {
  const RowMajor rotation = Eigen::Map<const RowMajor>(c.rotation.data());
  const Eigen::Vector3d place =
      -rotation.transpose() * Eigen::Map<const Eigen::Vector3d>(c.translation.data());
  RowMajor axes;
  axes.row(0) = place.normalized();
  axes.row(1) = Eigen::Vector3d::UnitZ().cross(place).normalized();
  axes.row(2) = axes.row(0).cross(axes.row(1));
  Rectification r;
  r.width = c.left.width + 10, r.height = c.left.height - 7;
  Eigen::Map<RowMajor>(r.left_rotation.data()) = axes;
  Eigen::Map<RowMajor>(r.right_rotation.data()) = axes * rotation.transpose();
  r.focal_length = focal;
  r.left_center_x = r.width / 2.0 + 3, r.right_center_x = r.width / 2.0 - 5;
  r.center_y = r.height / 2.0 - 2;
  r.baseline = place.norm();
  return r;
}

cv::Mat undistorted(const cv::Mat& raw, const CameraCalibration& c, const cv::Matx33d& rotation,
                    double center_x, const Rectification& r) {
  const cv::Matx33d k(c.focal_x, 0, c.center_x, 0, c.focal_y, c.center_y, 0, 0, 1);
  const cv::Matx33d p(r.focal_length, 0, center_x, 0, r.focal_length, r.center_y, 0, 0, 1);
  const cv::Size size(r.width, r.height);
  cv::Mat map_x, map_y, image;
  if (c.lens == LensModel::kFisheye) {
    cv::fisheye::initUndistortRectifyMap(k, c.coefficients, rotation, p, size, CV_32FC1, map_x,
                                         map_y);
  } else {
    cv::initUndistortRectifyMap(k, c.coefficients, rotation, p, size, CV_32FC1, map_x, map_y);
  }
  cv::remap(raw, image, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_CONSTANT, 0);
  return image;
}

// Mean |a - b| away from the border of what the raw camera sees.
double difference(const cv::Mat& corrected, const cv::Mat& ideal) {
  cv::Mat seen;
  cv::erode(corrected > 0, seen, cv::Mat(), cv::Point(-1, -1), 3, cv::BORDER_CONSTANT, 0);
  EXPECT_GT(cv::countNonZero(seen), ideal.rows * ideal.cols / 2);
  cv::Mat error;
  cv::absdiff(corrected, ideal, error);
  return cv::mean(error, seen)[0];
}

class BuiltIn : public ::testing::TestWithParam<std::string> {};

TEST_P(BuiltIn, CorrectedViewsAreThoseOfIdealCameras) {
  const Scene scene = test::wall_scene(2, 25);
  const Settings s = camera();
  const RawRig rig(built_in_rig(GetParam(), s));
  const Rectification r = rectification_for(rig.calibration, rig.calibration.left.focal_x);
  const RawFrame raw = render_raw(scene, 0, s, rig);
  const StereoFrame ideal = render_rectified(scene, 0, s, r);
  const cv::Matx33d left(r.left_rotation.data()), right(r.right_rotation.data());
  const double center = r.left_center_x;
  const cv::Mat corrected = undistorted(raw.left, rig.calibration.left, left, center, r);
  const double exact = difference(corrected, ideal.left);
  EXPECT_LT(exact, 3);
  EXPECT_LT(difference(undistorted(raw.right, rig.calibration.right, right, r.right_center_x, r),
                       ideal.right),
            3);
  // Half a pixel is visible.
  const cv::Mat shifted = undistorted(raw.left, rig.calibration.left, left, center + 0.5, r);
  EXPECT_GT(difference(shifted, ideal.left), 1.5 * exact);
}

TEST_P(BuiltIn, TruthLeadsFromOneRawViewToTheOther) {
  const Scene scene = make_scene("room", 1);
  const Settings s = camera(120, 80);
  const RawRig rig(built_in_rig(GetParam(), s));
  const Rectification r = rectification_for(rig.calibration, s.focal);
  const Truth truth = render_truth(scene, 0, s, r);
  const Camera left = rectified_left_camera(r), right = rectified_right_camera(r);
  int checked = 0;
  for (int y = 0; y < r.height; y += 9) {
    for (int x = 0; x < r.width; x += 9) {
      const double depth = truth.depth.at<float>(y, x), d = truth.disparity.at<float>(y, x);
      if (!std::isfinite(depth)) continue;
      const Eigen::Vector3d point = left.pose * Eigen::Vector3d(depth * left.direction(x, y));
      EXPECT_NEAR(right.pixel_of(point).x, x - d, 1e-3);
      EXPECT_NEAR(right.pixel_of(point).y, y, 1e-6);
      EXPECT_NEAR(depth, r.focal_length * r.baseline / (d + r.principal_offset()), 1e-5 * depth);
      const cv::Point2d raw = rig.right.pixel_of(point);
      const Eigen::Vector3d ray = rig.right.pose.linear() * rig.right.direction(raw.x, raw.y);
      const Eigen::Vector3d expected = point - rig.right.pose.translation();
      const bool in_view = rig.right.lens->sees(rig.right.pose.linear().transpose() * expected);
      if (!in_view) continue;
      EXPECT_LT(ray.normalized().cross(expected.normalized()).norm(), 1e-9);
      ++checked;
    }
  }
  EXPECT_GT(checked, 40);
}

INSTANTIATE_TEST_SUITE_P(Rigs, BuiltIn, ::testing::ValuesIn(rig_names()),
                         [](const auto& info) { return info.param; });

TEST(Raw, RectifiedPairOfTheSettingsIsThatOfRender) {
  const Scene scene = make_scene("garden", 1);
  const Settings s = camera(96, 64);
  const StereoFrame a = render(scene, 0.5, s);
  const StereoFrame b = render_rectified(scene, 0.5, s, rectification_of(s));
  EXPECT_EQ(cv::norm(a.left, b.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.right, b.right, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(a.truth != b.truth), 0);
  EXPECT_EQ(cv::norm(a.occluded, b.occluded, cv::NORM_INF), 0);
}

TEST(Raw, CalibrationOfARigThatIsOutOfLineShowsTheSameViews) {
  const Scene scene = test::wall_scene(2);
  Settings s = camera(96, 64);
  s.rig.roll = 1, s.rig.pitch = -0.7, s.rig.yaw = 0.6, s.rig.focal_ratio = 1.02;
  s.rig.row_offset = 2.5;
  const StereoFrame a = render(scene, 0, s);
  const RawFrame b = render_raw(scene, 0, s, RawRig(calibration_of(s)));
  cv::Mat left, right;
  cv::absdiff(a.left, b.left, left);
  cv::absdiff(a.right, b.right, right);
  // The filter of the texture takes oblique rays into account with a lens only.
  EXPECT_LT(cv::mean(left)[0], 1);
  EXPECT_LT(cv::mean(right)[0], 1);
  cv::absdiff(a.left, b.right, right);
  EXPECT_GT(cv::mean(right)[0], 5);
}

TEST(Raw, ResultDoesNotDependOnTheNumberOfThreads) {
  const Scene scene = make_scene("street", 1);
  Settings s = camera(96, 64);
  s.noise = 2, s.blur = 0.8;
  const RawRig rig(built_in_rig("wide", s));
  s.threads = 1;
  const RawFrame one = render_raw(scene, 0.3, s, rig);
  s.threads = 3;
  const RawFrame three = render_raw(scene, 0.3, s, rig);
  EXPECT_EQ(cv::norm(one.left, three.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.right, three.right, cv::NORM_INF), 0);
}

TEST(Raw, ViewsHaveTheirOwnSizes) {
  const Settings s = camera(96, 64);
  StereoCalibration c = built_in_rig("wide", s);
  c.right.width = 80, c.right.height = 70;
  const RawFrame f = render_raw(make_scene("room", 1), 0, s, RawRig(c));
  EXPECT_EQ(f.left.size(), cv::Size(96, 64));
  EXPECT_EQ(f.right.size(), cv::Size(80, 70));
}

TEST(Raw, BlurSoftensTheViews) {
  const Scene scene = test::wall_scene(2);
  Settings s = camera(96, 64);
  const auto detail = [](const cv::Mat& image) {
    cv::Mat edges;
    cv::Laplacian(image, edges, CV_32F);
    return cv::norm(edges, cv::NORM_L1);
  };
  const double sharp = detail(render(scene, 0, s).left);
  s.blur = 1.5;
  EXPECT_LT(detail(render(scene, 0, s).left), 0.5 * sharp);
}

TEST(Raw, RefusesWhatIsNoRig) {
  const StereoCalibration good = built_in_rig("wide", camera());
  const auto message = [](const StereoCalibration& c) {
    return test::error_of<std::invalid_argument>([&] { RawRig rig(c); });
  };
  EXPECT_EQ(message(good), "");
  StereoCalibration bad = good;
  bad.rotation[0] = 2;
  EXPECT_NE(message(bad).find("rotation"), std::string::npos);
  bad = good;
  bad.translation = {};
  EXPECT_NE(message(bad).find("translation"), std::string::npos);
  bad = good;
  bad.right.coefficients[0] = -1.5;
  EXPECT_NE(message(bad).find("the right camera"), std::string::npos);
  EXPECT_THROW(built_in_rig("narrow", camera()), std::invalid_argument);
}

}  // namespace
}  // namespace mtstereo::render::raw_test

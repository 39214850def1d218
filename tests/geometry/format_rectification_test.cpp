// SPDX-License-Identifier: LGPL-2.1-or-later
// From a file of each format to rectified pixels: the same positions, to 0.02 px, as the maps that
// OpenCV makes from the numbers of the file, which are typed here again.
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibration_support.hpp"
#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::test::format_rectification_test {
namespace {

/// One camera in the words of OpenCV.
struct OpenCvCamera {
  cv::Matx33d k;
  std::vector<double> d;
  cv::Matx33d r{};  ///< R1 or R2
  cv::Matx34d p{};  ///< P1 or P2
  bool fisheye = false;
};

/// OpenCV's maps of one camera.
struct Maps {
  cv::Mat x, y;
};

Maps opencv_maps(const OpenCvCamera& camera, cv::Size rectified) {
  Maps maps;
  const cv::Mat k(camera.k);
  const cv::Mat r(camera.r);
  const cv::Mat p(camera.p);
  if (camera.fisheye) {
    cv::fisheye::initUndistortRectifyMap(k, camera.d, r, p, rectified, CV_32FC1, maps.x, maps.y);
  } else {
    cv::initUndistortRectifyMap(k, camera.d, r, p.colRange(0, 3), rectified, CV_32FC1, maps.x,
                                maps.y);
  }
  return maps;
}

/// The largest distance of the positions of one camera, over a grid that includes the corners.
double largest_distance(const StereoCalibration& calibration, const Rectification& rectification,
                        Rectifier::Side side, const OpenCvCamera& camera) {
  const Result<Rectifier> rectifier = Rectifier::create(calibration, rectification, side);
  if (!rectifier) {
    ADD_FAILURE() << rectifier.error().message;
    return INFINITY;
  }
  const cv::Size size(rectification.width, rectification.height);
  const Maps maps = opencv_maps(camera, size);
  constexpr int kSteps = 30;
  double largest = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const cv::Point at((size.width - 1) * i / kSteps, (size.height - 1) * j / kSteps);
      const std::array<double, 2> source = rectifier->source_of(at.x, at.y);
      const double distance = std::hypot(source[0] - static_cast<double>(maps.x.at<float>(at)),
                                         source[1] - static_cast<double>(maps.y.at<float>(at)));
      largest = std::isfinite(distance) ? std::max(largest, distance) : INFINITY;
    }
  }
  return largest;
}

void expect_same_positions(const StereoCalibration& calibration, const OpenCvCamera& left,
                           const OpenCvCamera& right) {
  const Result<Rectification> views = rectify(calibration);
  ASSERT_TRUE(views.ok()) << views.error().message;
  constexpr double kTolerance = 0.02;
  EXPECT_LT(largest_distance(calibration, *views, Rectifier::Side::kLeft, left), kTolerance);
  EXPECT_LT(largest_distance(calibration, *views, Rectifier::Side::kRight, right), kTolerance);
}

cv::Matx33d intrinsics(double fx, double fy, double cx, double cy) {
  return {fx, 0, cx, 0, fy, cy, 0, 0, 1};
}
cv::Matx34d projection(double f, double cx, double cy, double offset) {
  return {f, 0, cx, offset, 0, f, cy, 0, 0, 0, 1, 0};
}
cv::Matx33d rotation(double x, double y, double z) {
  cv::Matx33d matrix;
  cv::Rodrigues(cv::Vec3d(x, y, z), matrix);
  return matrix;
}

/// Adds what cv::stereoRectify() computes for a file without a rectification.
void rectify_by_opencv(OpenCvCamera& left, OpenCvCamera& right, cv::Size size, const cv::Matx33d& r,
                       const cv::Vec3d& t) {
  cv::Mat q;
  cv::stereoRectify(left.k, left.d, right.k, right.d, size, r, t, left.r, right.r, left.p, right.p,
                    q, cv::CALIB_ZERO_DISPARITY, 0, size);
}

OpenCvCamera left_of_pair() {
  return {intrinsics(536.07345, 536.01636, 342.37038, 235.53687),
          {-0.26509028, -0.046743552, 0.0018330091, -0.00031471690, 0.25231221},
          {0.999888338, -0.013308664, 0.006796449, 0.013336404, 0.999902853, -0.004052757,
           -0.006741852, 0.004142945, 0.999968691},
          projection(530.25, 330.125, 240.5, 0)};
}
OpenCvCamera right_of_pair() {
  return {intrinsics(539.21984, 538.90551, 327.10352, 248.51093),
          {-0.27764973, 0.072441105, -0.00098250361, 0.00035210427, -0.014807703},
          {0.999776963, -0.009213776, 0.019003413, 0.009135819, 0.999949510, 0.004185010,
           -0.019041013, -0.004010465, 0.999810660},
          projection(530.25, 330.125, 240.5, -64.455658)};
}

TEST(FormatRectification, OfOpenCv) {
  const std::string path = stored("intrinsics.yml") + "," + stored("extrinsics.yml");
  expect_same_positions(read_valid(path, 640, 480), left_of_pair(), right_of_pair());
}

TEST(FormatRectification, OfOpenCvWithoutStatedRectification) {
  const CalibrationFolder folder;
  const std::string extrinsics = stored_text("extrinsics.yml");
  const std::string path = stored("intrinsics.yml") + "," +
                           folder.write("e.yml", extrinsics.substr(0, extrinsics.find("R1:")));
  OpenCvCamera left = left_of_pair();
  OpenCvCamera right = right_of_pair();
  rectify_by_opencv(left, right, {640, 480}, rotation(0.0081, -0.0123, 0.0042),
                    {-0.12153, 0.00112, -0.00231});
  expect_same_positions(read_valid(path, 640, 480), left, right);
}

TEST(FormatRectification, OfCameraInfo) {
  const std::string path = stored("camera_info_left.yaml") + "," + stored("camera_info_right.yaml");
  expect_same_positions(read_valid(path), left_of_pair(), right_of_pair());
}

TEST(FormatRectification, OfKalibrWithFisheyeLenses) {
  const StereoCalibration calibration = read_valid(stored("camchain.yaml"));
  const Result<Rectification> views = rectify(calibration);
  ASSERT_TRUE(views.ok()) << views.error().message;
  OpenCvCamera left = {intrinsics(304.82145, 304.71032, 418.66517, 239.12264),
                       {-0.012563, 0.019874, -0.021035, 0.0081526},
                       cv::Matx33d(views->left_rotation.data()),
                       projection(views->focal_length, views->left_center_x, views->center_y, 0),
                       true};
  OpenCvCamera right = {intrinsics(305.10267, 305.01853, 421.30941, 241.87726),
                        {-0.011207, 0.017431, -0.018904, 0.0072817},
                        cv::Matx33d(views->right_rotation.data()),
                        projection(views->focal_length, views->right_center_x, views->center_y, 0),
                        true};
  expect_same_positions(calibration, left, right);
  // OpenCV's choice of the projection of fisheye lenses is another one; the rows must be those of
  // its R and T.
  const cv::Matx33d r = rotation(-0.0026, 0.0117, 0.0063);
  const cv::Vec3d t(-0.100987, -0.000912, 0.001274);
  EXPECT_LT(cv::norm(cv::Mat(right.r * r - left.r), cv::NORM_INF), 1e-9);
  const cv::Vec3d baseline = right.r * t;
  EXPECT_NEAR(baseline[0], -cv::norm(t), 1e-9);
  EXPECT_NEAR(std::hypot(baseline[1], baseline[2]), 0, 1e-9);
}

TEST(FormatRectification, OfKittiOdometryLeavesThePixels) {
  OpenCvCamera camera = {intrinsics(718.856, 718.856, 607.1928, 185.2157),
                         {},
                         cv::Matx33d::eye(),
                         projection(718.856, 607.1928, 185.2157, 0)};
  expect_same_positions(read_valid(stored("kitti_calib.txt"), 1241, 376), camera, camera);
}

TEST(FormatRectification, OfMiddleburyLeavesThePixels) {
  const OpenCvCamera left = {intrinsics(3979.911, 3979.911, 1244.772, 1019.507),
                             {},
                             cv::Matx33d::eye(),
                             projection(3979.911, 1244.772, 1019.507, 0)};
  const OpenCvCamera right = {intrinsics(3979.911, 3979.911, 1369.115, 1019.507),
                              {},
                              cv::Matx33d::eye(),
                              projection(3979.911, 1369.115, 1019.507, -768126.8)};
  expect_same_positions(read_valid(stored("middlebury_calib.txt")), left, right);
}

TEST(FormatRectification, OfDepthAi) {
  OpenCvCamera left = {intrinsics(799.74, 799.383, 662.934, 402.242),
                       {7.2356, -102.4821, 0.00038, -0.00112, 314.9071, 7.1123, -101.8832, 312.7216,
                        0.0004, -0.0002, 0.0011, 0.0003, 0.0061, -0.0043}};
  OpenCvCamera right = {intrinsics(801.326, 801.115, 652.743, 396.871),
                        {5.8211, -84.9033, -0.00071, 0.00064, 281.3422, 5.7416, -84.2119, 279.8815,
                         -0.0003, 0.0005, -0.0006, 0.0002, -0.0027, 0.0035}};
  rectify_by_opencv(left, right, {1280, 800}, rotation(0.0023, -0.0056, 0.0012),
                    {-0.07513, 0.000214, -0.000352});
  expect_same_positions(read_valid(stored("depthai.json")), left, right);
}

TEST(FormatRectification, OfZed) {
  OpenCvCamera left = {intrinsics(700.455, 700.455, 646.99, 368.523),
                       {-0.171409, 0.0236517, 0.000107811, -0.000230552, 0.00112}};
  OpenCvCamera right = {intrinsics(701.14, 701.14, 640.835, 372.438),
                        {-0.169814, 0.0224703, -8.7304e-05, 0.000151907, 0.00203}};
  // As in Stereolabs' zed-open-capture, which passes the values of the file with T = (B, TY, TZ);
  // the direction of T does not change R1 and R2.
  rectify_by_opencv(left, right, {1280, 720}, rotation(0.0035241, 0.0101827, -0.0013416),
                    {119.933, -0.0845, 0.3127});
  expect_same_positions(read_valid(stored("SN12345.conf"), 1280, 720), left, right);
}

}  // namespace
}  // namespace mtstereo::test::format_rectification_test

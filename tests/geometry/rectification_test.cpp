// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/rectification.hpp"

#include <gtest/gtest.h>

#include "geometry/lens.hpp"
#include "opencv_camera.hpp"
#include "rigs.hpp"
#include "seen_border.hpp"
#include "support/random.hpp"

namespace mtstereo::test::rectification_test {
namespace {

Rectification rectified(const StereoCalibration& rig, const RectificationOptions& options = {}) {
  const Result<Rectification> result = rectify(rig, options);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? *result : Rectification{};
}

std::string refusal(const StereoCalibration& rig, const RectificationOptions& options = {}) {
  const Result<Rectification> result = rectify(rig, options);
  if (result.ok()) return "";
  return result.error().message;
}

/// The column and the row of a point that is given in the coordinates of a camera.
std::array<double, 2> rectified_position(const Rectification& r, const Matrix3& rotation,
                                         double center_x, const Vector3& point) {
  const Vector3 p = product(rotation, point);
  return {r.focal_length * p[0] / p[2] + center_x, r.focal_length * p[1] / p[2] + r.center_y};
}

// Feature: rectification
TEST(Rectify, RowsAndDepthsOfRandomPointsAreExact) {
  Random random(1);
  for (const StereoCalibration& rig : all_rigs()) {
    for (const bool zero_disparity : {true, false}) {
      const Rectification r = rectified(rig, {.zero_disparity = zero_disparity});
      for (int i = 0; i < 200; ++i) {
        const double depth = 0.5 + 10 * random.share();
        const Vector3 left = {(random.share() - 0.5) * depth, (random.share() - 0.5) * depth,
                              depth};
        const auto in_left = rectified_position(r, r.left_rotation, r.left_center_x, left);
        const auto in_right =
            rectified_position(r, r.right_rotation, r.right_center_x, in_right_camera(rig, left));
        ASSERT_NEAR(in_left[1], in_right[1], 1e-6);
        const double z = product(r.left_rotation, left)[2];
        const double disparity = in_left[0] - in_right[0] + r.principal_offset();
        ASSERT_NEAR(r.focal_length * r.baseline / disparity, z, 1e-9 * z);
      }
      if (zero_disparity) {
        EXPECT_EQ(r.principal_offset(), 0);
      }
    }
  }
}

class WithOpenCv : public testing::TestWithParam<double> {};

TEST_P(WithOpenCv, PolynomialLensesGetTheResultOfStereoRectify) {
  for (const StereoCalibration& rig : {pinhole_rig(), plumb_bob_rig(), tilted_rig()}) {
    for (const bool zero_disparity : {true, false}) {
      const Rectification r =
          rectified(rig, {.alpha = GetParam(), .zero_disparity = zero_disparity});
      cv::Mat left_turn;
      cv::Mat right_turn;
      cv::Mat left;
      cv::Mat right;
      cv::Mat q;
      cv::stereoRectify(camera_matrix(rig.left), coefficients_of(rig.left),
                        camera_matrix(rig.right), coefficients_of(rig.right),
                        cv::Size(rig.left.width, rig.left.height), matrix_of(rig.rotation),
                        cv::Mat(3, 1, CV_64F, const_cast<double*>(rig.translation.data())),
                        left_turn, right_turn, left, right, q,
                        zero_disparity ? cv::CALIB_ZERO_DISPARITY : 0, GetParam());
      EXPECT_LT(cv::norm(left_turn, matrix_of(r.left_rotation)), 1e-9);
      EXPECT_LT(cv::norm(right_turn, matrix_of(r.right_rotation)), 1e-9);
      EXPECT_NEAR(r.focal_length, left.at<double>(0, 0), 1e-9);
      EXPECT_NEAR(r.left_center_x, left.at<double>(0, 2), 1e-9);
      EXPECT_NEAR(r.right_center_x, right.at<double>(0, 2), 1e-9);
      EXPECT_NEAR(r.center_y, left.at<double>(1, 2), 1e-9);
      EXPECT_NEAR(-r.baseline * r.focal_length, right.at<double>(0, 3), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Alphas, WithOpenCv, testing::Values(0, 0.4, 1, kKeepScale));

TEST(Rectify, CropsFisheyeViewsToWhatBothCamerasSee) {
  const StereoCalibration rig = fisheye_rig();
  for (const bool zero_disparity : {true, false}) {
    const Rectification r = rectified(rig, {.alpha = 0, .zero_disparity = zero_disparity});
    EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kLeft), 1);
    EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kRight), 1);
    // At least 100 of 120 degrees remain.
    EXPECT_GT(2 * std::atan(r.width / 2.0 / r.focal_length) * 180 / std::numbers::pi, 100);
  }
}

TEST(Rectify, KeepsAllPixelsOfFisheyeViewsWithAlpha1) {
  const StereoCalibration rig = fisheye_rig();
  const Rectification r = rectified(rig, {.alpha = 1});
  for (const auto& [camera, rotation, center] :
       {std::tuple(&rig.left, &r.left_rotation, r.left_center_x),
        std::tuple(&rig.right, &r.right_rotation, r.right_center_x)}) {
    const Lens lens(*camera);
    for (double u = 0; u < camera->width; u += camera->width - 1) {
      for (double v = 0; v < camera->height; v += 1) {
        const auto at = rectified_position(r, *rotation, center, lens.direction(u, v));
        ASSERT_GE(at[0], -0.01);
        ASSERT_LE(at[0], r.width - 0.99);
        ASSERT_GE(at[1], -0.01);
        ASSERT_LE(at[1], r.height - 0.99);
      }
    }
  }
}

TEST(Rectify, AlphaBetweenIsBetween) {
  const StereoCalibration rig = fisheye_rig();
  const double crop = rectified(rig, {.alpha = 0}).focal_length;
  const double half = rectified(rig, {.alpha = 0.5}).focal_length;
  const double all = rectified(rig, {.alpha = 1}).focal_length;
  EXPECT_GT(crop, half);
  EXPECT_GT(half, all);
}

TEST(Rectify, KeepsTheFocalLengthOnRequest) {
  const StereoCalibration rig = fisheye_rig();
  const Rectification r = rectified(rig, {.alpha = kKeepScale});
  EXPECT_NEAR(r.focal_length, (rig.left.focal_y + rig.right.focal_y) / 2, 1e-9);
  const Rectification half = rectified(rig, {.alpha = kKeepScale, .width = 320, .height = 240});
  EXPECT_NEAR(half.focal_length, r.focal_length / 2, 1e-9);
}

TEST(Rectify, OutputSizeScalesTheFocalLength) {
  for (const StereoCalibration& rig : all_rigs()) {
    const Rectification whole = rectified(rig);
    const Rectification half =
        rectified(rig, {.width = rig.left.width / 2, .height = rig.left.height / 2});
    EXPECT_EQ(half.width, rig.left.width / 2);
    EXPECT_EQ(half.height, rig.left.height / 2);
    EXPECT_NEAR(half.focal_length / whole.focal_length, 0.5, 0.01);
  }
}

TEST(Rectify, ViewsOfDifferentSizesAndLensesShareTheirRows) {
  StereoCalibration rig = fisheye_rig(640, 480);
  rig.right = plumb_bob_rig(320, 240).right;
  const Rectification r = rectified(rig);
  EXPECT_EQ(r.width, 640);
  EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kLeft), 1);
  EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kRight), 1);
}

TEST(Rectify, WideLensesThatOpenCvDoesNotInvertAreFramedToo) {
  // Five iterations of OpenCV leave an error in the corners: hundreds of pixels, and tens.
  const std::vector<std::pair<double, std::vector<double>>> lenses = {
      {520, {0, 0, 0, 0, 0, 0.3, 0, 0}}, {310, {-0.3, 0.1, 0, 0, 0}}};
  for (const auto& [focal, coefficients] : lenses) {
    StereoCalibration rig = plumb_bob_rig();
    for (CameraCalibration* camera : {&rig.left, &rig.right}) {
      camera->focal_x = camera->focal_y = focal;
      camera->coefficients = coefficients;
    }
    const Rectification r = rectified(rig);
    EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kLeft), 1) << focal;
    EXPECT_EQ(seen_border(rig, r, Rectifier::Side::kRight), 1) << focal;
  }
}

TEST(Rectify, TakesTheRectificationOfTheFileUnlessOptionsAreSet) {
  StereoCalibration rig = plumb_bob_rig();
  rig.rectification = rectified(rig);
  rig.rectification->focal_length += 7;
  EXPECT_EQ(rectified(rig), *rig.rectification);
  EXPECT_NE(rectified(rig, {.from_file = false}), *rig.rectification);
  EXPECT_NE(rectified(rig, {.alpha = 0.2}), *rig.rectification);
  EXPECT_NE(rectified(rig, {.width = 320}).width, rig.left.width);
}

TEST(Rectify, RefusesCamerasThatAreNotSideBySide) {
  StereoCalibration rig = plumb_bob_rig();
  rig.translation = {-0.01, 0, -0.2};
  EXPECT_NE(refusal(rig).find("in front of"), std::string::npos) << refusal(rig);
  rig.translation = {-0.01, 0.2, 0};
  EXPECT_NE(refusal(rig).find("above"), std::string::npos) << refusal(rig);
  rig.translation = {0.1, 0, 0};
  EXPECT_NE(refusal(rig).find("swapped"), std::string::npos) << refusal(rig);
  rig.translation = {0, 0, 0};
  EXPECT_NE(refusal(rig).find("baseline of zero"), std::string::npos) << refusal(rig);
}

TEST(Rectify, RefusesViewsThatShareNothing) {
  for (StereoCalibration rig : {fisheye_rig(), plumb_bob_rig(), pinhole_rig()}) {
    rig.rotation = rotation_of(0, 140, 0);
    for (const double alpha : {0.0, 1.0, kKeepScale}) {
      EXPECT_NE(refusal(rig, {.alpha = alpha}), "") << alpha;
    }
    // Half of it for each camera.
    rig.rotation = rotation_of(174, 0, 0);
    EXPECT_NE(refusal(rig).find("degrees"), std::string::npos) << refusal(rig);
  }
}

TEST(Rectify, RefusesWrongValues) {
  const auto after = [](void (*change)(StereoCalibration&)) {
    StereoCalibration rig = plumb_bob_rig();
    change(rig);
    return refusal(rig);
  };
  EXPECT_NE(after([](auto& rig) { rig.left.width = 0; }), "");
  EXPECT_NE(after([](auto& rig) { rig.right.height = 1 << 20; }), "");
  EXPECT_NE(after([](auto& rig) { rig.left.focal_x = 0; }), "");
  EXPECT_NE(after([](auto& rig) { rig.right.focal_y = std::nan(""); }), "");
  EXPECT_NE(after([](auto& rig) {
              rig.left.coefficients.pop_back();
              rig.left.coefficients.pop_back();
            }),
            "");
  EXPECT_NE(after([](auto& rig) { rig.left.coefficients[1] = std::nan(""); }), "");
  EXPECT_NE(after([](auto& rig) { rig.rotation[0] = -rig.rotation[0]; }), "");
  EXPECT_NE(after([](auto& rig) { rig.translation[1] = std::nan(""); }), "");
  for (const RectificationOptions& options :
       {RectificationOptions{.alpha = 1.5}, RectificationOptions{.alpha = -0.5},
        RectificationOptions{.alpha = std::nan("")}, RectificationOptions{.width = -1},
        RectificationOptions{.height = 16385}}) {
    const Result<Rectification> result = rectify(plumb_bob_rig(), options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidParameter);
  }
}

}  // namespace
}  // namespace mtstereo::test::rectification_test

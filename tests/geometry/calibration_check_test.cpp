// SPDX-License-Identifier: LGPL-2.1-or-later
// check_calibration() and scale_calibration().
#include <limits>

#include "calibration_support.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo::test::calibration_check_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The message for a calibration after a change.
template <typename Change>
std::string refused(Change change) {
  StereoCalibration calibration = plumb_bob_pair();
  change(calibration);
  const Status status = check_calibration(calibration);
  if (status.ok()) return "accepted";
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidCalibration);
  return status.error().message;
}

TEST(CheckCalibration, AcceptsThePairOfTheTests) {
  EXPECT_TRUE(check_calibration(plumb_bob_pair()).ok());
}

TEST(CheckCalibration, AcceptsAnUnknownSizeOfBothCamerasOnly) {
  StereoCalibration calibration = plumb_bob_pair();
  calibration.left.width = calibration.left.height = 0;
  EXPECT_FALSE(check_calibration(calibration).ok());
  calibration.right.width = calibration.right.height = 0;
  EXPECT_TRUE(check_calibration(calibration).ok());
  calibration.right.width = calibration.left.width = 640;
  EXPECT_FALSE(check_calibration(calibration).ok());
}

TEST(CheckCalibration, RefusesCamerasThatCannotBe) {
  EXPECT_THAT(refused([](auto& c) { c.left.width = -640; }), HasSubstr("the left camera has the"));
  EXPECT_THAT(refused([](auto& c) { c.left.height = kLargestImageSide + 1; }),
              HasSubstr("the left camera has the size 640x16385"));
  EXPECT_THAT(refused([](auto& c) { c.right.focal_x = 0; }),
              HasSubstr("the right camera has the focal lengths 0 and"));
  EXPECT_THAT(refused([](auto& c) { c.left.focal_y = kNan; }), HasSubstr("focal lengths"));
  EXPECT_THAT(refused([](auto& c) { c.left.focal_x = c.left.focal_y = 4; }),
              HasSubstr("the focal length 4 px for an image of 640x480 px, which no lens has"));
  EXPECT_EQ(refused([](auto& c) { c.left.focal_x = c.left.focal_y = 30; }), "accepted");
  EXPECT_THAT(refused([](auto& c) { c.left.center_y = kNan; }), HasSubstr("not finite"));
  EXPECT_THAT(refused([](auto& c) { c.left.center_x = 1100; }),
              HasSubstr("K belongs to another image size"));
  EXPECT_THAT(refused([](auto& c) { c.left.coefficients.resize(3); }),
              HasSubstr("has 3 coefficients, 4, 5, 8, 12 or 14 are needed"));
  EXPECT_THAT(refused([](auto& c) { c.right.lens = LensModel::kFisheye; }),
              HasSubstr("has 5 coefficients, 4 are needed"));
  EXPECT_THAT(refused([](auto& c) { c.right.lens = LensModel::kNone; }), HasSubstr("5 coeff"));
  EXPECT_THAT(refused([](auto& c) { c.right.coefficients[2] = kNan; }), HasSubstr("not finite"));
}

TEST(CheckCalibration, RefusesPositionsThatCannotBe) {
  EXPECT_THAT(refused([](auto& c) { c.rotation[0] = 1.01; }), HasSubstr("is not a rotation"));
  EXPECT_THAT(refused([](auto& c) { c.rotation[4] = kNan; }), HasSubstr("not finite"));
  EXPECT_THAT(refused([](auto& c) {
                for (std::size_t i = 0; i < 3; ++i) c.rotation[i] = -c.rotation[i];
              }),
              HasSubstr("it mirrors"));
  // Upside down: 180 degrees around the axis of the lens.
  EXPECT_THAT(refused([](auto& c) { c.rotation = {-1, 0, 0, 0, -1, 0, 0, 0, 1}; }),
              HasSubstr("turned by more than 90 degrees"));
  EXPECT_THAT(refused([](auto& c) { c.translation = {}; }), HasSubstr("a baseline of 0 m"));
  EXPECT_THAT(refused([](auto& c) { c.translation[0] = 0.1; }), HasSubstr("the views are swapped"));
  EXPECT_THAT(refused([](auto& c) { c.translation[0] = -60; }),
              HasSubstr("more than 10 m: the length is most likely in millimeters"));
  EXPECT_THAT(refused([](auto& c) { c.translation = {-0.01, 0.1, 0}; }), HasSubstr("vertical"));
  EXPECT_THAT(refused([](auto& c) { c.translation[2] = kNan; }), HasSubstr("not finite"));
}

TEST(CheckCalibration, RefusesARectificationThatDoesNotBelongToTheCameras) {
  EXPECT_THAT(refused([](auto& c) { c.rectification->focal_length = -1; }), HasSubstr("focal"));
  EXPECT_THAT(refused([](auto& c) { c.rectification->width = -1; }), HasSubstr("size"));
  EXPECT_THAT(refused([](auto& c) { c.rectification->center_y = kNan; }), HasSubstr("not finite"));
  EXPECT_THAT(refused([](auto& c) { c.rectification->baseline = 121.557; }),
              HasSubstr("T states 0.12155"));
  EXPECT_THAT(refused([](auto& c) { c.rectification->baseline = kNan; }), HasSubstr("baseline"));
  EXPECT_THAT(refused([](auto& c) {
                std::swap(c.rectification->left_rotation, c.rectification->right_rotation);
              }),
              HasSubstr("R2 R must be R1"));
  EXPECT_THAT(refused([](auto& c) { c.rectification->left_rotation[0] = 2; }),
              HasSubstr("not a rotation"));
}

TEST(ScaleCalibration, KeepsThePositionsOfPixelCorners) {
  const StereoCalibration pair = plumb_bob_pair();
  const Result<StereoCalibration> half = scale_calibration(pair, 320, 240);
  ASSERT_TRUE(half.ok()) << half.error().message;
  EXPECT_EQ(half->left.width, 320);
  EXPECT_EQ(half->right.height, 240);
  EXPECT_DOUBLE_EQ(half->left.focal_x, pair.left.focal_x / 2);
  // The corner at -0.5 stays, so the center of the first pixel moves by a quarter of a new pixel.
  EXPECT_DOUBLE_EQ(half->left.center_x, pair.left.center_x / 2 - 0.25);
  EXPECT_DOUBLE_EQ(half->right.center_y, pair.right.center_y / 2 - 0.25);
  EXPECT_EQ(half->left.coefficients, pair.left.coefficients);
  EXPECT_EQ(half->translation, pair.translation);
  EXPECT_DOUBLE_EQ(half->rectification->focal_length, 265.125);
  EXPECT_DOUBLE_EQ(half->rectification->center_y, 120);
  EXPECT_EQ(half->rectification->width, 320);
  EXPECT_DOUBLE_EQ(half->rectification->baseline, pair.rectification->baseline);

  const Result<StereoCalibration> again = scale_calibration(*half, 640, 480);
  ASSERT_TRUE(again.ok());
  expect_near(*again, pair, 1e-12);
}

TEST(ScaleCalibration, ToItsOwnSizeChangesNothing) {
  const StereoCalibration pair = plumb_bob_pair();
  const Result<StereoCalibration> same = scale_calibration(pair, 640, 480);
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->left, pair.left);
  EXPECT_EQ(same->right, pair.right);
  EXPECT_EQ(same->rectification, pair.rectification);
}

TEST(ScaleCalibration, AdoptsTheSizeIfTheFileHasNone) {
  StereoCalibration pair = plumb_bob_pair();
  for (int* side : {&pair.left.width, &pair.left.height, &pair.right.width, &pair.right.height,
                    &pair.rectification->width, &pair.rectification->height}) {
    *side = 0;
  }
  const Result<StereoCalibration> sized = scale_calibration(pair, 640, 480);
  ASSERT_TRUE(sized.ok()) << sized.error().message;
  expect_near(*sized, plumb_bob_pair(), 0);
  // K does not fit a much smaller image.
  const Result<StereoCalibration> small = scale_calibration(pair, 160, 120);
  ASSERT_FALSE(small.ok());
  EXPECT_THAT(small.error().message, HasSubstr("K belongs to another image size"));
}

TEST(ScaleCalibration, AcceptsRoundedSizesAndRefusesOtherAspectRatios) {
  StereoCalibration pair = plumb_bob_pair();
  EXPECT_TRUE(scale_calibration(pair, 213, 160).ok());
  EXPECT_TRUE(scale_calibration(pair, 1281, 960).ok());
  const Result<StereoCalibration> wide = scale_calibration(pair, 640, 360);
  ASSERT_FALSE(wide.ok());
  EXPECT_EQ(wide.error().code, ErrorCode::kInvalidCalibration);
  EXPECT_THAT(
      wide.error().message,
      HasSubstr("for images of 640x480 px, the video has 640x360 px: the aspect ratios differ"));
  EXPECT_FALSE(scale_calibration(pair, 640, 482).ok());
  EXPECT_FALSE(scale_calibration(pair, 0, 0).ok());
  EXPECT_FALSE(scale_calibration(pair, -640, -480).ok());
  EXPECT_FALSE(scale_calibration(pair, 1 << 20, 3 << 18).ok());
  pair.translation = {};
  EXPECT_FALSE(scale_calibration(pair, 320, 240).ok());
}

}  // namespace
}  // namespace mtstereo::test::calibration_check_test

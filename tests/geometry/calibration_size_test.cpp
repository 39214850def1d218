// SPDX-License-Identifier: LGPL-2.1-or-later
// The sizes in which cameras give video, and what of the image they show.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_size_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The calibration as a program uses it for video of a size.
StereoCalibration for_video(const std::string& path, int width, int height) {
  const StereoCalibration calibration = read_valid(path, width, height);
  const Result<StereoCalibration> scaled = scale_calibration(calibration, width, height);
  if (!scaled) {
    ADD_FAILURE() << scaled.error().message;
    return {};
  }
  return *scaled;
}

TEST(DepthAiSize, OfVideoWithoutRowsIsACrop) {
  const std::string path = stored("depthai.json");
  const CameraCalibration whole = for_video(path, 1280, 800).left;
  EXPECT_DOUBLE_EQ(whole.center_y, 402.242);
  // 40 rows less at the top, 40 at the bottom.
  const CameraCalibration cropped = for_video(path, 1280, 720).left;
  EXPECT_EQ(cropped.height, 720);
  EXPECT_DOUBLE_EQ(cropped.focal_y, whole.focal_y);
  EXPECT_DOUBLE_EQ(cropped.center_x, whole.center_x);
  EXPECT_DOUBLE_EQ(cropped.center_y, 402.242 - 40);
  EXPECT_DOUBLE_EQ(for_video(path, 1280, 720).right.center_y, 396.871 - 40);
  const CameraCalibration half = for_video(path, 640, 400).left;
  EXPECT_DOUBLE_EQ(half.focal_x, whole.focal_x / 2);
  EXPECT_DOUBLE_EQ(half.center_y, (402.242 + 0.5) / 2 - 0.5);
  const CameraCalibration both = for_video(path, 640, 360).left;
  EXPECT_DOUBLE_EQ(both.focal_x, whole.focal_x / 2);
  EXPECT_DOUBLE_EQ(both.center_y, (402.242 - 40 + 0.5) / 2 - 0.5);
}

TEST(DepthAiSize, OfALargerSensorIsACropToo) {
  const CalibrationFolder folder;
  std::string text = stored_text("depthai.json");
  for (int i = 0; i < 2; ++i) {
    text = replaced(text, "\"width\": 1280", "\"width\": 1920");
    text = replaced(text, "\"height\": 800", "\"height\": 1200");
  }
  const StereoCalibration calibration = for_video(folder.write("b.json", text), 1920, 1080);
  EXPECT_DOUBLE_EQ(calibration.left.center_y, 402.242 - 60);
  EXPECT_EQ(calibration.right.height, 1080);
}

TEST(DepthAiSize, OfAnotherAspectRatioIsRefused) {
  const Result<StereoCalibration> calibration = read_calibration(stored("depthai.json"), 640, 480);
  ASSERT_TRUE(calibration.ok());
  const Result<StereoCalibration> scaled = scale_calibration(*calibration, 640, 480);
  ASSERT_FALSE(scaled.ok());
  EXPECT_THAT(scaled.error().message, HasSubstr("the aspect ratios differ"));
}

std::string refused_size(int width, int height) {
  const Result<StereoCalibration> calibration = read_calibration(stored("camchain.yaml"), 0, 0);
  EXPECT_TRUE(calibration.ok());
  const CameraCalibration& left = calibration->left;
  const Result<StereoCalibration> scaled =
      scale_calibration(*calibration, left.width * width / 4, left.height * height / 4);
  return scaled.ok() ? "" : scaled.error().message;
}

TEST(Size, OfAnotherAspectRatioIsThatOfACrop) {
  EXPECT_THAT(refused_size(4, 3), HasSubstr("differ, so the camera crops; calibrate with"));
}

TEST(Size, OfHalfOrTwiceTheAspectRatioMayBeThatOfBothViews) {
  for (const auto& [width, height] : {std::pair(8, 4), {4, 2}}) {
    EXPECT_THAT(refused_size(width, height),
                AllOf(HasSubstr("both views side by side (split it first"),
                      HasSubstr("squeezed to half of their height"), HasSubstr("camera crops")));
  }
  for (const auto& [width, height] : {std::pair(4, 8), {2, 4}}) {
    EXPECT_THAT(refused_size(width, height), AllOf(HasSubstr("both views one above the other"),
                                                   HasSubstr("squeezed to half of their width")));
  }
}

TEST(Size, OfTheTurnedImageIsThatOfTurnedVideo) {
  const Result<StereoCalibration> calibration = read_calibration(stored("camchain.yaml"), 0, 0);
  ASSERT_TRUE(calibration.ok());
  const CameraCalibration& left = calibration->left;
  const auto turned = scale_calibration(*calibration, left.height, left.width);
  ASSERT_FALSE(turned.ok());
  EXPECT_THAT(turned.error().message,
              AllOf(HasSubstr("turned by 90 degrees"), HasSubstr("videoflip"), HasSubstr("crops")));
}

TEST(ZedSize, OfBothViewsSideBySideIsNamed) {
  EXPECT_THAT(read_refused(stored("SN12345.conf"), 2560, 720),
              AllOf(HasSubstr("no calibration for video of 2560x720, which has both views side by"),
                    HasSubstr("separate them first"), HasSubstr("HD (1280x720)")));
}

/// The message of a camera of 640x480 with this region and binning.
std::string camera_info(const CalibrationFolder& folder, const std::string& name,
                        const std::string& fourth, const std::string& rest) {
  return folder.write(
      name,
      "height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd: [0.1, 0.0, 0.0, 0.0, 0.0]\n"
      "k: [420.0, 0, 321.0, 0, 422.0, 241.0, 0, 0, 1]\nr: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
      "p: [410.0, 0, 323.0, " +
          fourth + ", 0, 410.0, 243.0, 0, 0, 0, 1, 0]\n" + rest);
}

class CameraInfoSize : public ::testing::Test {
 protected:
  StereoCalibration read(const std::string& left, const std::string& right) {
    return read_valid(camera_info(folder_, "left", "0.0", left) + "," +
                      camera_info(folder_, "right", "-49.2", right));
  }
  std::string refused(const std::string& left, const std::string& right) {
    return read_refused(camera_info(folder_, "left", "0.0", left) + "," +
                        camera_info(folder_, "right", "-49.2", right));
  }
  CalibrationFolder folder_;
};

TEST_F(CameraInfoSize, OfBinnedVideoIsSmaller) {
  const std::string binning = "binning_x: 2\nbinning_y: 2\n";
  const StereoCalibration calibration = read(binning, binning);
  EXPECT_EQ(calibration.left.width, 320);
  EXPECT_EQ(calibration.left.height, 240);
  EXPECT_DOUBLE_EQ(calibration.left.focal_y, 211);
  EXPECT_DOUBLE_EQ(calibration.left.center_x, 160.25);
  EXPECT_DOUBLE_EQ(calibration.rectification->focal_length, 205);
  EXPECT_DOUBLE_EQ(calibration.rectification->center_y, 121.25);
  EXPECT_NEAR(calibration.rectification->baseline, 0.12, 1e-12);
  EXPECT_NEAR(calibration.baseline(), 0.12, 1e-12);
}

TEST_F(CameraInfoSize, OfARegionMovesThePrincipalPoint) {
  const std::string left = "roi: {x_offset: 40, y_offset: 60, height: 360, width: 560}\n";
  const std::string right = "roi: {x_offset: 40, y_offset: 64, height: 360, width: 560}\n";
  const StereoCalibration calibration = read(left, right);
  EXPECT_EQ(calibration.left.width, 560);
  EXPECT_EQ(calibration.right.height, 360);
  EXPECT_DOUBLE_EQ(calibration.left.center_x, 281);
  EXPECT_DOUBLE_EQ(calibration.left.center_y, 181);
  EXPECT_DOUBLE_EQ(calibration.right.center_y, 177);
  // Both rectified views have the same rows.
  EXPECT_DOUBLE_EQ(calibration.rectification->center_y, 183);
  EXPECT_DOUBLE_EQ(calibration.rectification->left_center_x, 283);
  EXPECT_EQ(calibration.rectification->width, 560);
}

TEST_F(CameraInfoSize, OfABinnedRegionIsBoth) {
  const std::string both =
      "binning_x: 2\nbinning_y: 2\n"
      "roi: {x_offset: 40, y_offset: 60, height: 360, width: 560, do_rectify: true}\n";
  const StereoCalibration calibration = read(both, both);
  EXPECT_EQ(calibration.left.width, 280);
  EXPECT_DOUBLE_EQ(calibration.left.center_x, (281 + 0.5) / 2 - 0.5);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 210);
  const std::string none = "binning_x: 0\nroi: {x_offset: 0, y_offset: 0, height: 0, width: 0}\n";
  EXPECT_EQ(read(none, none).left.width, 640);
}

TEST_F(CameraInfoSize, ThatContradictsIsRefused) {
  EXPECT_THAT(refused("binning_x: 2\nbinning_y: 1\n", ""),
              HasSubstr("binning_x is 2 and binning_y 1; they must be equal"));
  EXPECT_THAT(refused("binning_x: 2\nbinning_y: 2\n", ""), HasSubstr("they must be equal"));
  EXPECT_THAT(refused("roi: {x_offset: -3}\n", ""),
              HasSubstr("roi.x_offset is -3, an integer from 0"));
  EXPECT_THAT(refused("roi: {x_offset: 3000}\n", ""),
              HasSubstr("(-2679, 241) outside of its image"));
}

}  // namespace
}  // namespace mtstereo::test::calibration_size_test

// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of rectified cameras: the intrinsics and the baseline.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_rectified_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Middlebury, BaselineIsInMillimetersAndTheOffsetIsKept) {
  const StereoCalibration calibration = read_valid(stored("middlebury_calib.txt"));
  EXPECT_EQ(calibration.format, "Middlebury");
  const CameraCalibration left = {2964, 1988, 3979.911, 3979.911, 1244.772, 1019.507, {}, {}};
  const CameraCalibration right = {2964, 1988, 3979.911, 3979.911, 1369.115, 1019.507, {}, {}};
  expect_near(calibration.left, left, 0);
  expect_near(calibration.right, right, 0);
  expect_near(calibration.translation, Vector3{-0.193001, 0, 0}, 1e-12);
  EXPECT_EQ(calibration.rotation, kIdentity);
  ASSERT_TRUE(calibration.rectification.has_value());
  EXPECT_NEAR(calibration.rectification->principal_offset(), 124.343, 1e-9);
  EXPECT_NEAR(calibration.rectification->baseline, 0.193001, 1e-12);
  EXPECT_EQ(calibration.rectification->height, 1988);
}

// Two cameras of Kalibr without distortion.
std::string parallel_chain(const std::string& right) {
  const std::string lens = "  camera_model: pinhole\n  distortion_model: none\n";
  return "cam0:\n" + lens + "  intrinsics: [500.0, 500.0, 310.0, 240.0]\n" +
         "  resolution: [640, 480]\ncam1:\n" + lens + "  intrinsics: " + right +
         "\n  resolution: [640, 480]\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.12]\n" +
         "  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n";
}

// Their views need no rectification: another one would contradict them.
TEST(ParallelCameras, WithoutDistortionAreARectifiedPair) {
  const CalibrationFolder folder;
  const auto read = [&](const std::string& text) { return read_valid(folder.write("c", text)); };
  const std::string same = parallel_chain("[500.0, 500.0, 310.0, 240.0]");
  const StereoCalibration pair = read(same);
  ASSERT_TRUE(pair.rectification.has_value());
  EXPECT_EQ(pair.rectification->left_rotation, kIdentity);
  EXPECT_EQ(pair.rectification->width, 640);
  EXPECT_DOUBLE_EQ(pair.rectification->focal_length, 500);
  EXPECT_DOUBLE_EQ(pair.rectification->left_center_x, 310);
  EXPECT_DOUBLE_EQ(pair.rectification->center_y, 240);
  EXPECT_EQ(pair.rectification->principal_offset(), 0);
  EXPECT_DOUBLE_EQ(pair.rectification->baseline, 0.12);
  for (const char* other : {"[501.0, 501.0, 310.0, 240.0]", "[500.0, 505.0, 310.0, 240.0]",
                            "[500.0, 500.0, 310.0, 241.0]", "[500.0, 500.0, 312.5, 240.0]"}) {
    EXPECT_FALSE(read(parallel_chain(other)).rectification) << other;
  }
  const std::string wide =
      replaced(parallel_chain("[500.0, 505.0, 310.0, 240.0]"), "500.0, 500.0", "500.0, 505.0");
  EXPECT_FALSE(read(wide).rectification) << "its pixels are not square";
  const std::string turned =
      replaced(replaced(same, "0.0, 1.0, 0.0, 0.0]", "0.0, 0.9998, -0.02, 0.0]"),
               "0.0, 0.0, 1.0, 0.0]", "0.0, 0.02, 0.9998, 0.0]");
  EXPECT_FALSE(read(turned).rectification);
  const std::string higher = replaced(same, "0.0, 1.0, 0.0, 0.0]", "0.0, 1.0, 0.0, 0.01]");
  EXPECT_FALSE(read(higher).rectification);
  const std::string lens = replaced(same, "distortion_model: none",
                                    "distortion_model: radtan\n  distortion_coeffs: [0, 0, 0, 0]");
  EXPECT_FALSE(read(lens).rectification);
}

TEST(FoundationStereo, StatesKAndTheBaselineInTwoLines) {
  const CalibrationFolder folder;
  const auto write = [&](const std::string& text) { return folder.write("K.txt", text); };
  const std::string k = "500.5 0.0 321.25 0.0 500.5 240.75 0.0 0.0 1.0\n";
  const StereoCalibration calibration = read_valid(write(k + "0.063\n"), 640, 480);
  EXPECT_EQ(calibration.format, "FoundationStereo");
  EXPECT_DOUBLE_EQ(calibration.right.focal_x, 500.5);
  EXPECT_DOUBLE_EQ(calibration.left.center_y, 240.75);
  EXPECT_DOUBLE_EQ(calibration.baseline(), 0.063);
  EXPECT_EQ(calibration.rectification->width, 640);
  EXPECT_THAT(read_refused(write(k)),
              HasSubstr("baseline in the second are needed; lines of numbers: 1"));
  EXPECT_THAT(read_refused(write(k + "0.063 1\n")), HasSubstr("line 2 has 2 values, 1 are needed"));
  EXPECT_THAT(read_refused(write(k + "63\n")), HasSubstr("line 2 states a baseline of 63 m"));
  EXPECT_THAT(read_valid(write(k + "6.3\n")).remarks,
              ElementsAre(HasSubstr("Otherwise write it in meters")));
  EXPECT_THAT(read_refused(write("0" + k + k)), HasSubstr("line 2 has 9 values"));
  EXPECT_THAT(read_refused(write(replaced(k, "240.75 0.0", "240.75 0.5") + "0.063\n")),
              HasSubstr("line 1 is not a camera matrix"));
}

TEST(RectifiedView, StatesTheIntrinsicsAndTheBaseline) {
  const CalibrationFolder folder;
  const auto write = [&](const std::string& text) { return folder.write("camera.yaml", text); };
  const std::string k = "fx: 500.5\nfy: 500.5\ncx: 321.25\ncy: 240.75\n";
  const std::string inner = "camera:\n  fx: 500.5\n  cx: 321.25\n  cy: 240.75\n";
  const std::string matrix = "K: [500.5, 0, 321.25, 0, 500.5, 240.75, 0, 0, 1]\n";
  for (const std::string& text :
       {k + "baseline: 0.063\n", k + "bl: 0.063\n", k + "baseline_mm: 63\nd: [0, 0, 0, 0, 0]\n",
        inner + "baseline: 0.063\n", matrix + "image: left.png\nBaseline: 0.063\n",
        k + "baseline: 6.3\nunit: cm\n", k + "baseline: 63\nbaseline_unit: mm\n",
        std::string("fx: 500.5\nppx: 321.25\nppy: 240.75\nbaseline_meters: 0.063\n"),
        std::string("left: {fx: 500.5, cx: 321.25, cy: 240.75}\nright: {fx: 500.5, cx: 321.25, cy: "
                    "240.75}\n"
                    "baseline: 0.063\n"),
        std::string(R"({"fx": 500.5, "cx": 321.25, "cy": 240.75, "baseline_m": 0.063})"),
        std::string("cam0: {cam_fx: 500.5, cam_fy: 500.5, cam_cx: 321.25, cam_cy: 240.75, cam_d0: "
                    "0.0, cam_bl: 0.063, cam_width: 640, cam_height: 480, cam_model: Pinhole}\n"
                    "images_subfolder_l: image_2/\n")}) {
    const StereoCalibration calibration = read_valid(write(text), 640, 480);
    EXPECT_EQ(calibration.format, "rectified view");
    EXPECT_DOUBLE_EQ(calibration.right.focal_x, 500.5) << text;
    EXPECT_DOUBLE_EQ(calibration.left.center_y, 240.75) << text;
    EXPECT_DOUBLE_EQ(calibration.baseline(), 0.063) << text;
    EXPECT_EQ(calibration.rectification->width, 640);
  }
  EXPECT_THAT(read_refused(write(k + "baseline: 63\n")), HasSubstr("baseline of 63 m"));
  EXPECT_THAT(read_refused(write(k + "baseline: 0.06\nD: [-0.1, 0, 0, 0]\n")),
              HasSubstr("D is not 0, so the views are not rectified"));
  EXPECT_THAT(read_refused(write(k + "baseline: 0.06\nk1: -0.1\nk2: 0\n")),
              HasSubstr("k1 is not 0"));
  EXPECT_THAT(read_refused(write(inner + "baseline: 0.06\ndistortion:\n  k1: -0.1\n")),
              HasSubstr("distortion is not 0"));
  for (const char* name : {"dist", "distCoeffs", "dist_coeff", "kc", "cam_d1"}) {
    EXPECT_THAT(read_refused(write(k + "baseline: 0.06\n" + name + ": [-0.1, 0, 0, 0]\n")),
                HasSubstr(std::string(name) + " is not 0"));
  }
  EXPECT_THAT(read_refused(write(k)),
              HasSubstr("fx, fy, cx, cy and baseline (in meters) are enough, of others M1"));
  EXPECT_THAT(read_refused(write("fx: 0\ncx: 1\ncy: 2\nbaseline: 1\n")), HasSubstr("fx = 0"));
}

TEST(RectifiedView, MayHaveAnotherCenterOnTheRight) {
  const CalibrationFolder folder;
  const auto write = [&](const std::string& text) { return folder.write("camera.yaml", text); };
  const std::string k = "fx: 500\ncx: 320\ncy: 240\nbaseline: 0.06\n";
  const std::string pair = "left_camera: {fx: 500, cx: 320, cy: 240}\nbaseline: 0.06\n";
  for (const std::string& text :
       {k + "doffs: 10\n", k + "cx_right: 330\n", replaced(k, "cx:", "cx0:") + "cx1: 330\n",
        pair + "right_camera: {fx: 500, cx: 330, cy: 240}\n",
        std::string(
            "camera: {K: [500, 0, 320, 0, 500, 240, 0, 0, 1], doffs: 10}\nbaseline: 0.06\n")}) {
    const StereoCalibration calibration = read_valid(write(text));
    EXPECT_EQ(calibration.left.center_x, 320) << text;
    EXPECT_EQ(calibration.right.center_x, 330) << text;
    EXPECT_EQ(calibration.rectification->principal_offset(), 10) << text;
  }
  EXPECT_THAT(read_refused(write(pair + "right_camera: {fx: 510, cx: 330, cy: 240}\n")),
              HasSubstr("right_camera has the focal length 510, the left view has 500"));
  EXPECT_THAT(read_refused(write(pair + "right_camera: {fx: 500, cx: 330, cy: 240, k1: 0.1}\n")),
              HasSubstr("right_camera.k1 is not 0"));
  // A pair with a pose is not rectified.
  EXPECT_THAT(
      read_refused(write(pair + "right_camera: {fx: 500, cx: 330, cy: 240}\npose: [1, 2, 3]\n")),
      HasSubstr("not a calibration of a known format"));
}

TEST(RectifiedView, NotesAnUnusualBaselineWithoutAUnit) {
  const CalibrationFolder folder;
  const auto write = [&](const std::string& text) { return folder.write("camera.yaml", text); };
  const std::string k = "fx: 500\ncx: 320\ncy: 240\n";
  EXPECT_THAT(read_valid(write(k + "baseline: 6.3\n")).remarks,
              ElementsAre(HasSubstr("Otherwise add the entry 'unit: mm' (or cm)")));
  EXPECT_TRUE(read_valid(write(k + "baseline: 6.3\nunit: m\n")).remarks.empty());
  EXPECT_THAT(read_refused(write(k + "baseline: 6.3\nunit: feet\n")), HasSubstr("unit is 'feet'"));
}

}  // namespace
}  // namespace mtstereo::test::calibration_rectified_test

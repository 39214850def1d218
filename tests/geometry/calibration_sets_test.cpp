// SPDX-License-Identifier: LGPL-2.1-or-later
// The calibrations of data sets: Cityscapes, DSEC, Argoverse; and what is refused by name.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_sets_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class SetFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.write("file", text); }
  StereoCalibration read(const std::string& text, const char* choice = "") {
    return read_valid(write(text) + choice, 640, 480);
  }
  std::string refused(const std::string& text, const char* choice = "") {
    return read_refused(write(text) + choice, 640, 480);
  }
  /// The error with one value replaced.
  std::string changed(const std::string& text, const std::string& from, const std::string& to) {
    return refused(replaced(text, from, to));
  }
  CalibrationFolder folder_;
};

/// A pair that needs no rectification.
void expect_rectified(const StereoCalibration& calibration, const Rectification& expected) {
  EXPECT_EQ(calibration.left.lens, LensModel::kNone);
  expect_near(calibration.rotation, kIdentity, 0);
  expect_near(calibration.translation, Vector3{-expected.baseline, 0, 0}, 1e-12);
  ASSERT_TRUE(calibration.rectification);
  expect_near(*calibration.rectification, expected, 1e-9);
}

Rectification views(double focal, double left_x, double right_x, double y, double baseline,
                    int width = 640, int height = 480) {
  Rectification rectification;
  rectification.left_rotation = rectification.right_rotation = kIdentity;
  rectification.focal_length = focal;
  rectification.left_center_x = left_x;
  rectification.right_center_x = right_x;
  rectification.center_y = y;
  rectification.baseline = baseline;
  rectification.width = width;
  rectification.height = height;
  return rectification;
}

constexpr const char* kDrivingStereo =
    "S_101: 640 480\nK_101: 700 0 330 0 702 236 0 0 1\nD_101: -0.1 0.01 0 0 0\n"
    "R_101: 1 0 0 0 1 0 0 0 1\nT_101: 0 0 0\nS_rect_101: 640 480\n"
    "R_rect_101: 1 0 0 0 1 0 0 0 1\nP_rect_101: 600 0 320 0 0 602 240 0 0 0 1 0\n"
    "S_rect_103: 640 480\nP_rect_103: 600 0 320 -324 0 602 240 0 0 0 1 0\n";

// All its views are rectified, with pixels that are not square: they are no rectification.
TEST_F(SetFile, OfDrivingStereoStatesItsProjections) {
  const StereoCalibration calibration = read(kDrivingStereo);
  EXPECT_EQ(calibration.format, "DrivingStereo");
  EXPECT_EQ(calibration.left.lens, LensModel::kNone);
  EXPECT_EQ(calibration.right, calibration.left);
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_EQ(calibration.left.focal_x, 600);
  EXPECT_EQ(calibration.left.focal_y, 602);
  EXPECT_EQ(calibration.rotation, kIdentity);
  expect_near(calibration.translation, Vector3{-0.54, 0, 0}, 1e-12);
  EXPECT_FALSE(calibration.rectification);
  const std::string square = replaced(replaced(kDrivingStereo, "0 0 602 240", "0 0 600 240"),
                                      "-324 0 602 240", "-324 0 600 240");
  expect_rectified(read(square), views(600, 320, 320, 240, 0.54));
}

TEST_F(SetFile, OfDrivingStereoIsRefusedWithTheEntry) {
  EXPECT_THAT(changed(kDrivingStereo, "P_rect_103", "P_rect_104"),
              HasSubstr("there is no entry P_rect_103 (projection of the right camera)"));
  EXPECT_THAT(changed(kDrivingStereo, "-324", "0"),
              HasSubstr("P_rect_103 states a baseline of 0 m"));
  EXPECT_THAT(changed(kDrivingStereo, "320 -324 0 602 240 0 0 0 1 0", "320 -324"),
              HasSubstr("P_rect_103 has 4 values, 12 are needed"));
  EXPECT_THAT(refused(kDrivingStereo, "#gray"), HasSubstr("this format has no choices"));
}

constexpr const char* kCityscapes = R"({
  "extrinsic": {"baseline": 0.25, "pitch": 0.04, "roll": 0.0, "x": 1.5, "y": 0.1, "yaw": -0.02, "z": 1.25},
  "intrinsic": {"fx": 700.5, "fy": 701.25, "u0": 330.5, "v0": 236.0}
})";

TEST_F(SetFile, OfCityscapesIsTheRectifiedLeftCamera) {
  const StereoCalibration calibration = read(kCityscapes);
  EXPECT_EQ(calibration.format, "Cityscapes");
  expect_rectified(calibration, views(700.5, 330.5, 330.5, 236, 0.25));
}

TEST_F(SetFile, OfCityscapesThatCannotBeIsRefused) {
  EXPECT_THAT(changed(kCityscapes, "0.25,", "0,"), HasSubstr("extrinsic.baseline states"));
  EXPECT_THAT(changed(kCityscapes, "0.25,", "250,"), HasSubstr("it must be in meters"));
  EXPECT_THAT(changed(kCityscapes, "701.25", "800"),
              HasSubstr("intrinsic has the focal lengths 700.5 and 800"));
  EXPECT_THAT(changed(kCityscapes, "330.5", "1100"), HasSubstr("principal point"));
  EXPECT_THAT(changed(kCityscapes, "\"fx\"", "\"f\""), HasSubstr("intrinsic has no entry fx"));
  EXPECT_THAT(refused(kCityscapes, "#left"), HasSubstr("no choices"));
}

// Camera 2 is 0.5 m to the right of camera 1, and R_rect turns both by the same angle.
constexpr const char* kDsec = R"(
intrinsics:
  cam0: {camera_matrix: [500, 501, 320, 240], distortion_coeffs: [0, 0, 0, 0], resolution: [640, 480]}
  camRect0: {camera_matrix: [550.5, 550.5, 310, 230], resolution: [640, 480]}
  camRect1: {camera_matrix: [1100.25, 1100.25, 700, 530], resolution: [1440, 1080]}
  camRect2: {camera_matrix: [1100.25, 1100.25, 705, 530], resolution: [1440, 1080]}
  camRect3: {camera_matrix: [550.5, 550.5, 310, 230], resolution: [640, 480]}
extrinsics:
  R_rect2: [[0.96, 0, 0.28], [0, 1, 0], [-0.28, 0, 0.96]]
  R_rect3: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
  T_10: [[1, 0, 0, -0.04], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
  T_21: [[1, 0, 0, -0.48], [0, 1, 0, 0], [0, 0, 1, -0.14], [0, 0, 0, 1]]
  T_32: [[1, 0, 0, -0.08], [0, 1, 0, 0], [0, 0, 1, 0.14], [0, 0, 0, 1]]
)";

TEST_F(SetFile, OfDsecHasTheRectifiedFramesAndEvents) {
  const StereoCalibration frames = read_valid(write(kDsec));
  EXPECT_EQ(frames.format, "DSEC");
  expect_rectified(frames, views(1100.25, 700, 705, 530, 0.5, 1440, 1080));
  expect_rectified(read(kDsec, "#1-2"), views(1100.25, 700, 705, 530, 0.5, 1440, 1080));
  expect_rectified(read(kDsec, "#0-3"), views(550.5, 310, 310, 230, 0.6));
}

TEST_F(SetFile, OfDsecThatCannotBeIsRefused) {
  EXPECT_THAT(refused(kDsec, "#1-3"), HasSubstr("1-2 (frames) and 0-3 (events) are pairs"));
  EXPECT_THAT(changed(kDsec, "R_rect2", "R_rect5"), HasSubstr("extrinsics has no entry R_rect2"));
  EXPECT_THAT(changed(kDsec, "camRect2", "camRect5"), HasSubstr("has no entry camRect2"));
  EXPECT_THAT(changed(kDsec, "705, 530", "705, 531"), HasSubstr("not rectified to each other"));
  EXPECT_THAT(changed(kDsec, "0, 0, -0.48", "0, 0, -48"), HasSubstr("R_rect2"));
  EXPECT_THAT(changed(kDsec, "1, -0.14", "1, 0.14"),
              HasSubstr("R_rect2 does not turn the other camera to the side"));
}

std::string argoverse(const std::string& cameras) {
  return "{\"camera_data_\": [" + cameras + "]}";
}

// A camera that looks along the x axis of the vehicle, whose y axis is to the left.
std::string argoverse_camera(const std::string& name, const std::string& y,
                             const std::string& more = "") {
  return "{\"key\": \"image_raw_" + name +
         "\", \"value\": {\"focal_length_x_px_\": 800.5, \"focal_length_y_px_\": 800.5, "
         "\"focal_center_x_px_\": 330, \"focal_center_y_px_\": 236, \"skew_\": 0.0, " +
         more +
         "\"distortion_coefficients_\": [-0.125, 0.25, 0.5], \"vehicle_SE3_camera_\": "
         "{\"rotation\": {\"coefficients\": [0.5, -0.5, 0.5, -0.5]}, \"translation\": [1.5, " +
         y + ", 1.25]}}}";
}

std::string argoverse_pair(const std::string& suffix, const std::string& right_more = "") {
  return argoverse_camera("stereo_front_right" + suffix, "-0.125", right_more) + "," +
         argoverse_camera("stereo_front_left" + suffix, "0.125");
}

TEST_F(SetFile, OfArgoverseHasTheRawPair) {
  const StereoCalibration calibration =
      read(argoverse(argoverse_camera("ring_front_center", "0") + "," + argoverse_pair("")));
  EXPECT_EQ(calibration.format, "Argoverse");
  EXPECT_EQ(calibration.left.lens, LensModel::kPlumbBob);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{-0.125, 0.25, 0, 0, 0.5}));
  EXPECT_EQ(calibration.left.focal_x, 800.5);
  expect_near(calibration.rotation, kIdentity, 1e-12);
  expect_near(calibration.translation, Vector3{-0.25, 0, 0}, 1e-12);
  EXPECT_FALSE(calibration.rectification);
}

TEST_F(SetFile, OfArgoverseHasTheRectifiedPairFirst) {
  const std::string text =
      argoverse(argoverse_pair("") + "," + argoverse_pair("_rect", "\"Txf_\": -200.125, "));
  expect_rectified(read(text), views(800.5, 330, 330, 236, 0.25));
  expect_rectified(read(text, "#rectified"), views(800.5, 330, 330, 236, 0.25));
  EXPECT_EQ(read(text, "#raw").left.lens, LensModel::kPlumbBob);
}

TEST_F(SetFile, OfArgoverseThatCannotBeIsRefused) {
  EXPECT_THAT(refused(argoverse(argoverse_camera("ring_front_center", "0"))),
              HasSubstr("has no stereo pair"));
  EXPECT_THAT(refused(argoverse(argoverse_pair("")), "#rectified"), HasSubstr("'#rectified'"));
  EXPECT_THAT(refused(argoverse(argoverse_pair("")), "#2"), HasSubstr("raw and rectified"));
  EXPECT_THAT(refused(argoverse(argoverse_pair("_rect"))), HasSubstr("has no entry Txf_"));
  EXPECT_THAT(refused(argoverse(argoverse_pair("_rect", "\"Txf_\": 0, "))), HasSubstr("Txf_"));
  EXPECT_THAT(changed(argoverse(argoverse_pair("")), "[0.5, -0.5,", "[0.75, -0.5,"),
              HasSubstr("quaternion of the length"));
  EXPECT_THAT(changed(argoverse(argoverse_pair("")), "[-0.125, 0.25, 0.5]", "[-0.125]"),
              HasSubstr("distortion_coefficients_"));
  EXPECT_THAT(refused("{\"camera_data_\": 3}"), HasSubstr("camera_data_"));
}

TEST_F(SetFile, OfColmapIsRefusedByName) {
  for (const char* text :
       {"# Camera list with one line of data per camera:\n1 PINHOLE 640 480 500 500 320 240\n",
        "# Image list with two lines of data per image:\n",
        "[{\"cameras\": [{\"image_prefix\": \"left/\", \"ref_sensor\": true}]}]"}) {
    EXPECT_THAT(refused(text), AllOf(HasSubstr("is of COLMAP"), HasSubstr("M1, D1, M2")));
  }
}

TEST_F(SetFile, OfOtherReconstructionsIsRefusedWithTheRemedy) {
  EXPECT_THAT(refused("{\"w\": 640, \"fl_x\": 500, \"cx\": 320, \"frames\": []}"),
              AllOf(HasSubstr("is of nerfstudio"), HasSubstr("M1, D1, M2")));
  EXPECT_THAT(refused("{\"intrinsics\": [{\"intrinsicId\": \"1\", \"type\": \"radial3\"}]}"),
              AllOf(HasSubstr("is of Meshroom"), HasSubstr("M1, D1, M2")));
  EXPECT_THAT(refused("{\"sfm_data_version\": \"0.3\", \"intrinsics\": []}"),
              AllOf(HasSubstr("is of OpenMVG"), HasSubstr("M1, D1, M2")));
  EXPECT_THAT(refused("<?xml version=\"1.0\"?>\n<calibration><f>500</f></calibration>\n"),
              AllOf(HasSubstr("<calibration>"), HasSubstr("M1, D1, M2")));
}

TEST_F(SetFile, OfProgramsWithoutAReaderGetsWhatToWrite) {
  const char* const cameras = R"("intrinsics": {"focal": [500, 500], "principal": [320, 240],
    "distortion_params": []}})";
  EXPECT_THAT(refused(std::string("[{\"cameras\": [{") + cameras + "]}]"),
              AllOf(HasSubstr("is an .edex of cuVSLAM; "), HasSubstr("M1, D1, M2, D2, R, T")));
  EXPECT_THAT(refused("%YAML:1.0\n---\nin_left_map:\n   -\n      fx: 400.\n      coeffs: [ 0.1 ]\n"
                      "ex_left_to_right:\n   translation: [ -80., 0., 0. ]\n"),
              AllOf(HasSubstr("is of the SDK of MYNT EYE; "), HasSubstr("length_unit: mm")));
  EXPECT_THAT(refused("type_of_vi: 3\ncam0_intrinsics: [380, 380, 320, 240]\n"
                      "cam1_intrinsics: [380, 380, 320, 240]\n"),
              AllOf(HasSubstr("is of FLVIS; "), HasSubstr("the inverse of T_cam0_cam1")));
  EXPECT_THAT(refused(R"({"camera_settings": [{"intrinsic_settings": {"fx": 700},
                      "captured_image_size": {"width": 640}}]})"),
              AllOf(HasSubstr("is of NDDS, without a baseline; "), HasSubstr("the data set")));
  EXPECT_THAT(refused("# INTERNAL CAMERA PARAMETERS\n\nParGroup: Camera: Parameter\n  \"x\";\n"),
              AllOf(HasSubstr("is of HALCON, "), HasSubstr("(mtcalibrate)")));
  const char* const kWithoutUnit = "whose lengths have no unit; write K, distortion, R and T [m]";
  for (const auto& [text, program] :
       {std::pair{R"({"camera_angle_x": 0.7, "frames": []})", "NeRF"},
        {R"({"rig": {"projection_type": "brown", "focal_x": 0.8}})", "OpenSfM"},
        {R"({"priors": [{"image_name": "left.jpg", "focal_length": 500}]})", "Theia"},
        {"<?xml version=\"1.0\"?>\n<calibration><projection>frame</projection></calibration>\n",
         "Metashape"},
        {"<document version=\"1.5\"><chunk label=\"1\"></chunk></document>\n", "Metashape"}}) {
    EXPECT_THAT(refused(text), HasSubstr(std::string("is of ") + program + ", " + kWithoutUnit));
  }
}

// Entries of them in files of others.
TEST_F(SetFile, IsNotTakenForThatOfAnotherProgram) {
  const std::string pair = stored_text("camchain.yaml");
  for (const char* comment : {"# in_left is cam0\n", "# type_of_vi\n", "# focal, principal\n"}) {
    EXPECT_EQ(read(comment + pair).format, "Kalibr camchain");
  }
}

}  // namespace
}  // namespace mtstereo::test::calibration_sets_test

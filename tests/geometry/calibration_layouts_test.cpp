// SPDX-License-Identifier: LGPL-2.1-or-later
// OpenCV files as programs write them by hand: other names, maps, and syntax that only OpenCV
// takes.
#include <utility>

#include "calibration_support.hpp"

namespace mtstereo::test::calibration_layouts_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kLeftK = "[ 500.5, 0., 321., 0., 501.5, 243., 0., 0., 1. ]";
constexpr const char* kRightK = "[ 510.5, 0., 319., 0., 511.5, 241., 0., 0., 1. ]";
constexpr const char* kLeftD = "[ -0.25, 0.125, 0.001, 0.002, 0.5 ]";
constexpr const char* kRightD = "[ -0.5, 0.0625, 0.003, 0.004, 0.25 ]";
constexpr const char* kR = "[ 0.96, 0., 0.28, 0., 1., 0., -0.28, 0., 0.96 ]";
constexpr const char* kT = "[ -0.12, 0.001, 0.002 ]";

class Layout : public ::testing::Test {
 protected:
  std::string write(const std::string& text) { return folder_.write("pair.yml", text); }
  void expect_pair(const std::string& text) {
    const StereoCalibration calibration = read_valid(write(text), 640, 480);
    EXPECT_EQ(calibration.format, "OpenCV") << text;
    EXPECT_DOUBLE_EQ(calibration.left.focal_x, 500.5);
    EXPECT_DOUBLE_EQ(calibration.right.center_y, 241);
    EXPECT_EQ(calibration.left.coefficients,
              (std::vector<double>{-0.25, 0.125, 0.001, 0.002, 0.5}));
    EXPECT_EQ(calibration.right.coefficients,
              (std::vector<double>{-0.5, 0.0625, 0.003, 0.004, 0.25}));
    expect_near(calibration.rotation, Matrix3{0.96, 0, 0.28, 0, 1, 0, -0.28, 0, 0.96}, 1e-12);
    expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
  }
  std::string refused(const std::string& text) { return read_refused(write(text), 640, 480); }
  CalibrationFolder folder_;
};

/// An entry per line: NAME, VALUE.
std::string lines(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text;
  for (const auto& [name, value] : entries) text += name + ": " + value + "\n";
  return text;
}

TEST_F(Layout, MapsPerCameraHaveTheNamesOfBoth) {
  expect_pair(std::string("left: {K: ") + kLeftK + ", D: " + kLeftD + "}\nright: {K: " + kRightK +
              ", D: " + kRightD + "}\nR: " + kR + "\nT: " + kT + "\n");
  expect_pair(std::string("Left_Camera:\n  Camera_Matrix: ") + kLeftK +
              "\n  Distortion_Coefficients: " + kLeftD + "\nRight_Camera:\n  Camera_Matrix: " +
              kRightK + "\n  Distortion_Coefficients: " + kRightD +
              "\nStereo_Parameters:\n  R: " + kR + "\n  T: " + kT + "\n");
}

TEST_F(Layout, UnknownNamesAreRecognizedByStructure) {
  expect_pair(lines({{"Camera_Matrix_0", kLeftK},
                     {"Dist_0", kLeftD},
                     {"Camera_Matrix_1", kRightK},
                     {"Dist_1", kRightD},
                     {"RotationOfRight", kR},
                     {"PositionOfRight", kT}}));
  // The order of the file has no meaning, and the results of a rectification do no harm.
  expect_pair(lines({{"rightIntrinsics", kRightK},
                     {"leftIntrinsics", kLeftK},
                     {"rightCoefficients", kRightD},
                     {"leftCoefficients", kLeftD},
                     {"R_rect", "[ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]"},
                     {"stereo", "{R: " + std::string(kR) + ", t: " + kT + "}"}}));
}

TEST_F(Layout, AnEmptyListOfUnknownNameIsNoDistortion) {
  const StereoCalibration calibration = read_valid(write(lines({{"Camera_Matrix_0", kLeftK},
                                                                {"Dist_0", kLeftD},
                                                                {"Camera_Matrix_1", kRightK},
                                                                {"Dist_1", "[]"},
                                                                {"R", kR},
                                                                {"T", kT}})));
  EXPECT_FALSE(calibration.left.coefficients.empty());
  EXPECT_TRUE(calibration.right.coefficients.empty());
}

// Beside them, a calibration of both cameras must not be missed.
TEST_F(Layout, PlacesOnABodyAreNotThoseOfTheCameras) {
  const auto cameras = [](const std::string& r, const std::string& t) {
    return lines(
        {{"M1", kLeftK}, {"D1", kLeftD}, {"M2", kRightK}, {"D2", kRightD}, {r, kR}, {t, kT}});
  };
  EXPECT_THAT(refused(cameras("R_cam_imu", "T_cam_imu")), HasSubstr("there is no entry R"));
  EXPECT_THAT(refused(cameras("R", "T_velo")), HasSubstr("there is no entry T"));
  expect_pair(cameras("RotationOfRight", "PositionOfRight") + "R_imu: " + kR + "\nT_imu: " + kT +
              "\n");
}

TEST_F(Layout, UnknownNamesMayEndInLAndR) {
  expect_pair(lines({{"RightOnes_R", kR},
                     {"cameraR", kRightK},
                     {"cameraDistcoeffR", kRightD},
                     {"cameraL", kLeftK},
                     {"cameraDistcoeffL", kLeftD},
                     {"T", kT}}));
  // Other letters state no order.
  EXPECT_THAT(refused(lines({{"cameraA", kLeftK},
                             {"distA", kLeftD},
                             {"cameraB", kRightK},
                             {"distB", kRightD},
                             {"R", kR},
                             {"T", kT}})),
              HasSubstr("there is no entry M1"));
}

TEST_F(Layout, OfTwoFilesWithTheSameNamesTheFirstIsTheLeftCamera) {
  const std::string left = folder_.write(
      "left.yml",
      lines({{"intrinsics", kLeftK}, {"distortion", kLeftD}, {"stereo_R", kR}, {"stereo_T", kT}}));
  const std::string right =
      folder_.write("right.yml", lines({{"intrinsics", kRightK}, {"distortion", kRightD}}));
  const StereoCalibration calibration = read_valid(left + "," + right, 640, 480);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 500.5);
  EXPECT_DOUBLE_EQ(calibration.right.focal_x, 510.5);
}

TEST_F(Layout, CamerasThatAreCalibratedAloneNeedAThirdFile) {
  const auto camera = [&](const char* name, const char* k, const char* d) {
    return folder_.write(name, lines({{"image_width", "640"},
                                      {"image_height", "480"},
                                      {"camera_matrix", k},
                                      {"distortion_coefficients", d}}));
  };
  const std::string left = camera("left, new.yml", kLeftK, kLeftD);
  const std::string right = camera("right.yml", kRightK, kRightD);
  const std::string pose = folder_.write("pose.yml", lines({{"R", kR}, {"T", kT}}));
  for (const std::string& path :
       {left + "," + right + "," + pose, pose + "," + left + "," + right}) {
    const StereoCalibration calibration = read_valid(path);
    EXPECT_EQ(calibration.format, "OpenCV");
    EXPECT_EQ(calibration.right.width, 640);
    EXPECT_DOUBLE_EQ(calibration.left.focal_x, 500.5) << path;
    EXPECT_DOUBLE_EQ(calibration.right.focal_x, 510.5) << path;
    EXPECT_DOUBLE_EQ(calibration.right.coefficients[0], -0.5) << path;
    expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
  }
  for (const std::string& path : {left, right, left + "," + pose}) {
    EXPECT_THAT(read_refused(path), AllOf(HasSubstr(" one camera; give the files of both cameras"),
                                          HasSubstr("LEFT,RIGHT,EXTRINSICS")));
  }
  EXPECT_THAT(read_refused(left + "," + right),
              AllOf(HasSubstr("have one camera each"), HasSubstr("LEFT,RIGHT,EXTRINSICS")));
  EXPECT_THAT(read_refused(left + "," + right + "," + left), HasSubstr("have one camera each"));
  EXPECT_THAT(read_refused(right + "," + right + "," + folder_.path("none.yml")),
              HasSubstr("none.yml"));
  EXPECT_THAT(read_refused("none.yml," + right + "," + pose),
              HasSubstr("none.yml: cannot be read"));
  EXPECT_THAT(read_refused(left + "," + stored("camchain.yaml") + "," + pose),
              HasSubstr("is a Kalibr camchain; only files of OpenCV and ROS are read by three"));
  // A number with such a name is none.
  EXPECT_THAT(refused(lines({{"k", "0.04"}, {"R", kR}, {"T", kT}})), HasSubstr("no entry M1"));
  const std::string other = camera("other.yml", kRightK, "[ 1, 2, 3 ]");
  EXPECT_THAT(read_refused(left + "," + other + "," + pose), HasSubstr("D1"));
}

TEST_F(Layout, CamerasOfRosThatAreCalibratedAloneNeedAThirdFile) {
  const auto camera = [&](const char* name, const char* k, const char* d) {
    return folder_.write(
        name, lines({{"camera_name", name},
                     {"image_width", "640"},
                     {"image_height", "480"},
                     {"camera_matrix", k},
                     {"distortion_model", "plumb_bob"},
                     {"distortion_coefficients", d},
                     {"rectification_matrix", "[ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]"},
                     {"projection_matrix", "[ 500., 0, 330., 0, 0, 500., 240., 0, 0, 0, 1, 0 ]"}}));
  };
  const std::string both =
      camera("l.yml", kLeftK, kLeftD) + "," + camera("r.yml", kRightK, kRightD);
  EXPECT_THAT(read_refused(both), HasSubstr("states a baseline of 0"));
  // RTAB-Map states the position so.
  const StereoCalibration calibration = read_valid(
      both + "," +
      folder_.write("pose.yml", lines({{"rotation_matrix", kR}, {"translation_matrix", kT}})));
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 500.5);
  EXPECT_DOUBLE_EQ(calibration.right.coefficients[0], -0.5);
  expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
}

TEST_F(Layout, WithAChoiceIsRefusedAndTheNamesAreListed) {
  // Nothing states which one is the left camera.
  EXPECT_THAT(refused(lines({{"alpha", kLeftK},
                             {"beta", kRightK},
                             {"alpha_dist", kLeftD},
                             {"beta_dist", kRightD},
                             {"R", kR},
                             {"T", kT}})),
              AllOf(HasSubstr("there is no entry M1 (K of the left camera)"),
                    HasSubstr("Matrices found: alpha (9 values), beta (9 values)"),
                    HasSubstr("Names needed: M1, D1, M2, D2, R, T")));
  // Two vectors: one of them may be the rotation.
  EXPECT_THAT(refused(lines({{"K1", kLeftK},
                             {"D1", kLeftD},
                             {"K2", kRightK},
                             {"D2", kRightD},
                             {"u", "[ 0.1, 0.2, 0.3 ]"},
                             {"v", kT}})),
              HasSubstr("there is no entry R (rotation between the cameras)"));
}

TEST_F(Layout, NamesOfPythonProgramsStateTheUnitAndTheSize) {
  const auto json = [](const std::string& name) {
    return std::string("{\"left_camera_matrix\": ") + kLeftK + ", \"left_dist\": " + kLeftD +
           ", \"right_camera_matrix\": " + kRightK + ", \"right_dist\": " + kRightD +
           ", \"rotation\": " + kR + ", \"" + name +
           "\": [-120, 1, 2], \"roi_left\": [0, 0, 640, 480],"
           " \"image_size\": {\"width\": 640, \"height\": 480},"
           " \"resolution\": {\"width\": 640, \"height\": 480}}";
  };
  // JSON has no numbers such as "0.".
  const auto plain = [](std::string text) {
    for (std::size_t at = text.find(".,"); at != std::string::npos; at = text.find(".,")) {
      text.erase(at, 1);
    }
    for (std::size_t at = text.find(". "); at != std::string::npos; at = text.find(". ")) {
      text.erase(at, 1);
    }
    return text;
  };
  const StereoCalibration calibration = read_valid(write(plain(json("translation_mm"))));
  expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_THAT(refused(plain(json("translation"))), HasSubstr("add the entry 'length_unit: mm'"));
}

TEST_F(Layout, OfTomlIsThatOfYaml) {
  const std::string camera =
      "camera_matrix = [\n  [500, 0, 322],\n  [0, 501.5, 241],\n  [0, 0, 1]\n]  # K\n"
      "distortion_coefficients = [0.1, 0.2, 0, 0, 0]\n";
  const std::string text =
      "[stereo]\nimage_size = [640, 480]\nunit = \"mm\"\n"
      "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ntranslation = [-120.5, 0, 0]\n\n"
      "[stereo.left]\n" +
      camera + "[stereo.right]\n" + camera;
  const StereoCalibration calibration = read_valid(write(text));
  EXPECT_EQ(calibration.left.focal_y, 501.5);
  EXPECT_EQ(calibration.right.center_x, 322);
  EXPECT_EQ(calibration.left.height, 480);
  EXPECT_DOUBLE_EQ(calibration.baseline(), 0.1205);
  EXPECT_THAT(refused(replaced(text, "[-120.5, 0, 0]", "[-120.5, 0")),
              HasSubstr("is not valid TOML: "));
  for (const char* name : {"[*a]", "[[%a]]", "[a.*b]"}) {
    EXPECT_THAT(refused("x = [1]\n" + std::string(name) + "\ny = 1\n"),
                HasSubstr("is not valid TOML: "));
  }
  std::string deep = "[a]\nx = [1]\n[b";
  for (int i = 0; i < 60; ++i) deep += ".b";
  EXPECT_THAT(refused(deep + "]\ny = 1\n"), HasSubstr("nested more than 50 times"));
}

TEST_F(Layout, OfTomlWithTablesInLines) {
  const std::string rectified = "[intrinsics]\nK = [500, 0, 320, 0, 500, 240, 0, 0, 1]\n";
  EXPECT_EQ(read_valid(write("baseline = 0.12\n" + rectified)).baseline(), 0.12);
  const std::string inline_table =
      "left = { fx = 500, cx = 320, cy = 240 }\nright = { fx = 500, cx = 320, cy = 240 }\n"
      "[rig]\nsize = [640, 480]\n";
  EXPECT_EQ(read_valid(write("baseline_mm = 120\n" + inline_table)).baseline(), 0.12);
}

TEST_F(Layout, InAMapBesideTextsIsFound) {
  const std::string cameras =
      lines({{"M1", kLeftK}, {"D1", kLeftD}, {"M2", kRightK}, {"D2", kRightD}});
  std::string inner =
      "  image_size: [640, 480]\n  R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n  T: [-120, 0, 0]\n";
  for (std::size_t at = 0; at < cameras.size(); at = cameras.find('\n', at) + 1) {
    inner += "  " + cameras.substr(at, cameras.find('\n', at) + 1 - at);
  }
  const StereoCalibration opencv = read_valid(write("rms: 0.3\nunit: mm\nrig:\n" + inner));
  EXPECT_EQ(opencv.left.width, 640);
  EXPECT_NEAR(opencv.baseline(), 0.12, 1e-12);
  const std::string view =
      "{\"serial\": \"A1\", \"stereo\": {\"fx\": 500.5, \"cx\": 320, \"cy\": 240, ";
  EXPECT_EQ(read_valid(write(view + "\"baseline\": 0.12}}")).left.focal_x, 500.5);
  EXPECT_THAT(
      refused("size: 2\nM1:\n  rows: 3\n  cols: 3\n  dt: d\n  data: " + std::string(kLeftK) + "\n"),
      HasSubstr("there is no entry M2"));
}

TEST_F(Layout, OfJsonWithComments) {
  const std::string text =
      "// written by a program\n{\n  \"fx\": 500.5, // pixels\n  \"cx\": 320, \"cy\": 240,\n"
      "  /* meters */ \"baseline\": 0.12\n}\n";
  EXPECT_EQ(read_valid(write(text)).left.focal_x, 500.5);
}

TEST_F(Layout, OfFourIntrinsicsPerCamera) {
  const std::string pair =
      "Left: {Width: 640, Height: 480, K: [ 500, 501, 322, 241 ], D: [ 0.1, 0.2, 0, 0 ]}\n"
      "Right: {Width: 640, Height: 480, K: [ 503, 502, 318, 239 ], D: [ 0, 0, 0, 0 ]}\n"
      "Rotate: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\nTrans: [ -0.12, 0, 0 ]\n"
      "R1: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\n";
  const StereoCalibration calibration = read_valid(write(pair));
  EXPECT_EQ(calibration.left.focal_y, 501);
  EXPECT_EQ(calibration.right.center_x, 318);
  EXPECT_EQ(calibration.translation, (Vector3{-0.12, 0, 0}));
}

TEST_F(Layout, NamesOfOtherProgramsStateTheUnitAndTheSize) {
  const std::string pair =
      lines({{"Kl", kLeftK}, {"Dl", kLeftD}, {"Kr", kRightK}, {"Dr", kRightD}, {"R", kR}});
  const StereoCalibration calibration = read_valid(write(
      "cam_width: 640\ncam_height: 480\nWorldUnits: centimeters\nt: [ -6.5, 0, 0 ]\n" + pair));
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_NEAR(calibration.baseline(), 0.065, 1e-12);
  const std::string meters = pair + "t: [ -0.065, 0, 0 ]\n";
  EXPECT_EQ(read_valid(write(meters + "resolution: 640x480\n")).right.height, 480);
  EXPECT_EQ(read_valid(write(meters + "res1: [640, 480]\nres2: [320, 240]\n")).right.width, 320);
  for (const char* size : {"640x", "640x480x3", "0x480", "640x.nan"}) {
    EXPECT_THAT(refused(meters + "resolution: " + size + "\n"), HasSubstr("resolution is "));
  }
}

TEST_F(Layout, ABaselineWithAUnitStatesThatOfT) {
  const auto pair = [](const std::string& t, const std::string& baseline) {
    return lines({{"K1", kLeftK},
                  {"D1", kLeftD},
                  {"K2", kRightK},
                  {"D2", kRightD},
                  {"R", kR},
                  {"T", t}}) +
           baseline + "\nframe_width: 640\nframe_height: 480\n";
  };
  for (const char* baseline :
       {"baseline_mm: 120.02", "baseline_cm: 12.0", "stereo: {baseline_mm: 120.02}"}) {
    const std::string t = std::string(baseline).find("_cm") == std::string::npos
                              ? "[ -120., 1., 2. ]"
                              : "[ -12., 0.1, 0.2 ]";
    const StereoCalibration calibration = read_valid(write(pair(t, baseline)));
    expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
    EXPECT_EQ(calibration.right.width, 640);
    EXPECT_TRUE(calibration.remarks.empty());
  }
  // T is in meters already.
  EXPECT_NEAR(read_valid(write(pair(kT, "baseline_mm: 120.02"))).baseline(), 0.12, 1e-4);
  // The baseline and T have different units.
  for (const char* baseline : {"baseline_cm: 12.0", "baseline_m: 0.12"}) {
    const StereoCalibration calibration = read_valid(write(pair("[ -120., 1., 2. ]", baseline)));
    expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
  }
  // A wish, not what was calibrated.
  const std::string four = "[500.5, 501, 321, 243]";
  EXPECT_EQ(read_valid(write("images: left/\ncam0:\n  Kl: " + four + "\n  Kr: " + four +
                             "\n  Dl: [0, 0, 0, 0]\n  Dr: [0, 0, 0, 0]\n  cam_bl: 0.12\n" +
                             "  R: " + kR + "\n  t: " + kT + "\n"))
                .right.focal_y,
            501);
  EXPECT_THAT(refused(pair("[ -120., 1., 2. ]", "baseline_mm: 60")), HasSubstr("length_unit: mm"));
  EXPECT_THAT(refused(pair("[ -120., 1., 2. ]", "baseline_mm: wide")), HasSubstr("length_unit"));
}

TEST_F(Layout, ARotationVectorIsNoTranslation) {
  EXPECT_THAT(refused(lines({{"K1", kLeftK},
                             {"D1", kLeftD},
                             {"K2", kRightK},
                             {"D2", kRightD},
                             {"R", kR},
                             {"rvec", kT}})),
              HasSubstr("there is no entry T (translation between the cameras)"));
}

TEST_F(Layout, ALargeRotationVectorIsNoted) {
  const auto remarks = [&](const char* vector) {
    return read_valid(write(lines({{"K1", kLeftK},
                                   {"D1", kLeftD},
                                   {"K2", kRightK},
                                   {"D2", kRightD},
                                   {"R", vector},
                                   {"T", kT}})),
                      640, 480)
        .remarks;
  };
  EXPECT_TRUE(remarks("[ 0.1, 0.1, 0.1 ]").empty());
  EXPECT_THAT(remarks("[ 0., 0.5, 0. ]"),
              ::testing::ElementsAre(HasSubstr("R is a vector that turns the cameras by 29")));
}

TEST_F(Layout, OfOmnidirHasXi) {
  const std::string four = "[ -0.25, 0.125, 0.001, 0.002 ]";
  const std::string cameras = lines({{"camera_matrix_1", kLeftK},
                                     {"distortion_coefficients_1", four},
                                     {"camera_matrix_2", kRightK},
                                     {"distortion_coefficients_2", four}});
  const std::string xi = "xi_1: 1.5\nxi_2: {rows: 1, cols: 1, dt: d, data: [ 1. ]}\n";
  const std::string pose = lines({{"rvec", "[ 0., 0., 0. ]"}, {"tvec", kT}});
  const StereoCalibration calibration = read_valid(write(cameras + xi + pose), 640, 480);
  EXPECT_EQ(calibration.left.lens, LensModel::kOmnidirectional);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{1.5, -0.25, 0.125, 0.001, 0.002}));
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 200.2);
  EXPECT_DOUBLE_EQ(calibration.right.focal_x, 255.25);
  expect_near(calibration.rotation, kIdentity, 1e-12);
  expect_near(calibration.translation, Vector3{-0.12, 0.001, 0.002}, 1e-12);
  // Without xi, rvec is the place of a board.
  EXPECT_THAT(refused(cameras + pose), HasSubstr("there is no entry R"));
  EXPECT_THAT(refused(cameras + "xi_2: 1\nR: " + kR + "\nT: " + kT + "\n"),
              HasSubstr("there is no entry xi1 (of the left camera)"));
  EXPECT_THAT(refused(cameras + "xi_1: 1\nR: " + kR + "\nT: " + kT + "\n"),
              HasSubstr("there is no entry xi2 (of the right camera)"));
  EXPECT_THAT(refused(replaced(cameras, "0.002 ]", "0.002, 0 ]") + xi + pose),
              HasSubstr("has 5 values, 4 are needed: k1, k2, p1, p2"));
  EXPECT_THAT(refused(cameras + "xi_1: -1\nxi_2: 1\n" + pose), HasSubstr("must not be negative"));
}

TEST_F(Layout, OfCamerasThatOmnidirCalibratedAloneHasXi) {
  const auto camera = [&](const char* name, const char* k, const char* xi) {
    return folder_.write(name, lines({{"camera_matrix", k},
                                      {"distortion_coefficients", "[ 0.1, 0., 0., 0. ]"},
                                      {"xi", xi}}));
  };
  const StereoCalibration calibration =
      read_valid(camera("l.yml", kLeftK, "1.") + "," + camera("r.yml", kRightK, "1.5") + "," +
                     folder_.write("pose.yml", lines({{"R", kR}, {"T", kT}})),
                 640, 480);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{1, 0.1, 0, 0, 0}));
  EXPECT_EQ(calibration.right.coefficients, (std::vector<double>{1.5, 0.1, 0, 0, 0}));
}

TEST_F(Layout, OfMatlabIsNamed) {
  EXPECT_THAT(refused(lines({{"K1", "[ 500., 0., 0., 0., 501., 0., 321., 243., 1. ]"},
                             {"D1", kLeftD},
                             {"K2", kRightK},
                             {"D2", kRightD},
                             {"R", kR},
                             {"T", kT}})),
              HasSubstr("K1 is transposed, as MATLAB states it; transpose it"));
  EXPECT_THAT(refused(lines({{"IntrinsicMatrix1", "[ 500., 0., 0., 0., 501., 0., 321., 243., 1. ]"},
                             {"IntrinsicMatrix2", "[ 500., 0., 0., 0., 501., 0., 321., 243., 1. ]"},
                             {"RotationOfCamera2", kR},
                             {"TranslationOfCamera2", kT}})),
              HasSubstr("IntrinsicMatrix1 is transposed, as MATLAB states it; transpose it"));
}

// The parts of the image that stereoRectify() leaves valid, rotations, and fx, fy, cx, cy.
TEST_F(Layout, FourNumbersAreNoLensUnlessTheirNamesSaySo) {
  const auto with = [](const std::string& left, const std::string& right,
                       const std::string& numbers) {
    return lines(
        {{"K1", kLeftK}, {left, numbers}, {"K2", kRightK}, {right, numbers}, {"R", kR}, {"T", kT}});
  };
  for (const char* name : {"roi", "q", "intrinsics_vector"}) {
    EXPECT_THAT(refused(with(name + std::string("1"), name + std::string("2"), "[1, 0, 0, 0]")),
                HasSubstr("there is no entry D1 (distortion of the left camera)"));
  }
  for (const char* name : {"kc", "lens_coeffs", "cam_dist"}) {
    const std::string text =
        with(name + std::string("1"), name + std::string("2"), "[0.1, 0, 0, 0]");
    EXPECT_EQ(read_valid(write(text)).left.coefficients.size(), 4U) << name;
  }
}

// As in SERV-CT.
TEST_F(Layout, WithProjectionsOnlyIsNamed) {
  const std::string p1 = "[[440, 0, 330, 0], [0, 440, 240, 0], [0, 0, 1, 0]]";
  const std::string p2 = "[[440, 0, 350, -2200], [0, 440, 240, 0], [0, 0, 1, 0]]";
  const std::string both = "\"P1\": " + p1 + ", \"P2\": " + p2;
  EXPECT_THAT(
      refused("{" + both + "}"),
      HasSubstr("has P1 and P2 of rectified views only; of P1 = [f 0 cx 0, 0 f cy 0, ...]"));
  EXPECT_THAT(refused("{\"P0\": " + p1 + ", " + both + "}"),
              Not(HasSubstr("rectified views only")));
}

/// A file of ORB-SLAM2 with the rectification of raw views, as people write it: without blanks.
std::string with_projections(const std::string& fourth) {
  const auto matrix = [](const char* name, const char* shape, const std::string& data) {
    return std::string(name) + ":  !!opencv-matrix\n   rows: 3\n   cols: " + shape +
           "\n   dt: d\n   data:" + data + "\n";
  };
  const std::string row = "   rows: 1\n   cols: 5\n   dt: d\n   data:";
  return "%YAML:1.0\n\nCamera.fx: 440.\nCamera.bf: 52.8\nViewer.PointSize:2\nViewer.Size: 3\n"
         "LEFT.height: 480\nLEFT.width: 640\n"
         "LEFT.D: !!opencv-matrix\n" +
         row + kLeftD + "\n" + matrix("LEFT.K", "3", kLeftK) +
         matrix("LEFT.R", "3", "[0.8, 0., 0.6, 0., 1., 0., -0.6, 0., 0.8]") +
         matrix("LEFT.P", "4", "[440., 0, 330., 0, 0, 440., 240., 0, 0, 0, 1, 0]") +
         "RIGHT.height: 480\nRIGHT.width: 640\nRIGHT.D: !!opencv-matrix\n" + row + kRightD + "\n" +
         matrix("RIGHT.K", "3", kRightK) +
         matrix("RIGHT.R", "3", "[1., 0., 0., 0., 1., 0., 0., 0., 1.]") +
         matrix("RIGHT.P", "4", "[440., 0, 330., " + fourth + ", 0, 440., 240., 0, 0, 0, 1, 0]");
}

TEST_F(Layout, OfRawViewsIsUsedWhereOrbSlamStatesTheRectifiedOnesToo) {
  expect_pair(
      "%YAML:1.0\nCamera.fx: 440.\nCamera.fy: 440.\nCamera.cx: 330.\nCamera.cy: 240.\n"
      "Camera.bf: 52.8\n" +
      lines({{"K1", kLeftK},
             {"K2", kRightK},
             {"D1", kLeftD},
             {"D2", kRightD},
             {"R", kR},
             {"T", kT}}));
}

TEST_F(Layout, WithRectifiedProjectionsNeedsNoRAndT) {
  const StereoCalibration calibration = read_valid(write(with_projections("-52.8")));
  EXPECT_EQ(calibration.left.width, 640);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 500.5);
  EXPECT_DOUBLE_EQ(calibration.rectification->focal_length, 440);
  EXPECT_NEAR(calibration.rectification->baseline, 0.12, 1e-12);
  expect_near(calibration.rotation, Matrix3{0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8}, 1e-12);
  expect_near(calibration.translation, Vector3{-0.12, 0, 0}, 1e-12);
  EXPECT_THAT(refused(with_projections("0")), HasSubstr("RIGHT.P states a baseline of 0 m"));
  EXPECT_THAT(refused(with_projections("-52800")), HasSubstr("add the entry 'length_unit: mm'"));
}

}  // namespace
}  // namespace mtstereo::test::calibration_layouts_test

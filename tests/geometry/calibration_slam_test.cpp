// SPDX-License-Identifier: LGPL-2.1-or-later
// Calibrations in the configuration of SLAM programs: ORB-SLAM, VINS-Fusion, OV2SLAM, Basalt; and
// mrcal and ROS's INI. The right camera is always 0.12 m beside the left one and 0.01 m in front of
// it.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_slam_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Matrix3 kNoTurn = {1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr Vector3 kRightOfLeft = {-0.12, 0, -0.01};

class SlamFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text, const std::string& name = "config.yaml") {
    return folder_.write(name, text);
  }
  std::string refused(const std::string& text) { return read_refused(write(text), 640, 480); }
  StereoCalibration read(const std::string& text) { return read_valid(write(text)); }
  void expect_position(const StereoCalibration& calibration) {
    expect_near(calibration.rotation, kNoTurn, 1e-9);
    expect_near(calibration.translation, kRightOfLeft, 1e-9);
  }
  CalibrationFolder folder_;
};

// ORB-SLAM

std::string orbslam(const std::string& model, const std::string& rest) {
  return "%YAML:1.0\n\nFile.version: \"1.0\"\nCamera.type: \"" + model +
         "\"\nCamera1.fx: 310.5\nCamera1.fy: 310.5\nCamera1.cx: 322.25\nCamera1.cy: 241.75\n"
         "Camera.width: 640\nCamera.height: 480\nViewer.PointSize:2\n" +
         rest;
}

constexpr const char* kSecond =
    "Camera1.k1: 0.01\nCamera1.k2: -0.02\nCamera2.fx: 311.5\nCamera2.fy: 312.5\n"
    "Camera2.cx: 320.25\nCamera2.cy: 239.75\nCamera2.k1: 0.03\nCamera2.k2: -0.04\n";
// From the right camera to the left one.
constexpr const char* kPose =
    "Stereo.T_c1_c2: !!opencv-matrix\n  rows: 4\n  cols: 4\n  dt: f\n"
    "  data:[1, 0, 0, 0.12, 0, 1, 0, 0, 0, 0, 1, 0.01, 0, 0, 0, 1.0]\n";

TEST_F(SlamFile, OfOrbSlamHasTwoCameras) {
  const StereoCalibration pinhole = read(
      orbslam("PinHole", std::string(kSecond) + "Camera1.p1: 0.001\nCamera2.k3: 0.5\n" + kPose));
  expect_position(pinhole);
  EXPECT_EQ(pinhole.format, "ORB-SLAM");
  EXPECT_EQ(pinhole.left.width, 640);
  EXPECT_DOUBLE_EQ(pinhole.right.focal_y, 312.5);
  EXPECT_EQ(pinhole.left.coefficients, (std::vector<double>{0.01, -0.02, 0.001, 0, 0}));
  EXPECT_EQ(pinhole.right.coefficients, (std::vector<double>{0.03, -0.04, 0, 0, 0.5}));
  const StereoCalibration fisheye = read(orbslam(
      "KannalaBrandt8", std::string(kSecond) + "Camera1.k3: 0.003\nCamera1.k4: -0.004\n" + kPose));
  expect_position(fisheye);
  EXPECT_EQ(fisheye.left.lens, LensModel::kFisheye);
  EXPECT_EQ(fisheye.left.coefficients, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
}

TEST_F(SlamFile, OfOlderOrbSlamHasAPoseOfThreeRows) {
  std::string text = orbslam("KannalaBrandt8", kSecond);
  for (std::size_t at = text.find("Camera1."); at != std::string::npos;
       at = text.find("Camera1.")) {
    text.erase(at + 6, 1);
  }
  text +=
      "Tlr: !!opencv-matrix\n  rows: 3\n  cols: 4\n  dt: f\n"
      "  data: [1, 0, 0, 0.12, 0, 1, 0, 0, 0, 0, 1, 0.01]\n";
  expect_position(read(text));
}

TEST_F(SlamFile, OfRectifiedViewsHasOneCameraAndTheBaseline) {
  const StereoCalibration stated = read(orbslam("Rectified", "Stereo.b: 0.12\n"));
  EXPECT_DOUBLE_EQ(stated.rectification->focal_length, 310.5);
  EXPECT_DOUBLE_EQ(stated.rectification->baseline, 0.12);
  EXPECT_EQ(stated.left.lens, LensModel::kNone);
  EXPECT_EQ(stated.rectification->width, 640);
  const StereoCalibration product = read(orbslam("PinHole", "Camera1.k1: 0.0\nCamera.bf: 37.26\n"));
  EXPECT_NEAR(product.rectification->baseline, 0.12, 1e-12);
  const StereoCalibration negative = read(orbslam("Rectified", "Camera.bf: -37.26\n"));
  EXPECT_NEAR(negative.rectification->baseline, 0.12, 1e-12);
  EXPECT_TRUE(negative.remarks.empty()) << "the cameras are not exchanged";
}

TEST_F(SlamFile, OfOrbSlamThatIsNoPairIsRefused) {
  EXPECT_THAT(refused(orbslam("PinHole", "")), HasSubstr("states one camera only"));
  EXPECT_THAT(refused(orbslam("PinHole", "Camera1.k1: 0.1\nCamera.bf: 37.26\n")),
              HasSubstr("states one camera, and it has distortion"));
  EXPECT_THAT(refused(orbslam("PinHole", "Camera.bf: 37.26\nDepthMapFactor: 5000\n")),
              HasSubstr("is of a camera for color and depth (DepthMapFactor)"));
  EXPECT_THAT(refused(orbslam("Mei", "")), HasSubstr("Camera.type is 'Mei'"));
  EXPECT_THAT(refused(orbslam("PinHole", kSecond)), HasSubstr("no entry Stereo.T_c1_c2"));
  EXPECT_THAT(refused(orbslam("Rectified", "Stereo.b: 0\n")), HasSubstr("Stereo.b states"));
  EXPECT_THAT(refused(orbslam("Rectified", "Stereo.b: .nan\n")), HasSubstr("not finite"));
  EXPECT_THAT(refused(orbslam("PinHole", std::string(kSecond) + "Tlr: [1, 2, 3]\n")),
              HasSubstr("Tlr has 3 values, 16 are needed"));
  EXPECT_THAT(
      refused(orbslam("KannalaBrandt8", replaced(kSecond, "Camera2.k1", "Camera2.x1") + kPose)),
      HasSubstr("there is no entry Camera2.k1"));
}

// VINS-Fusion

constexpr const char* kVinsPinhole =
    "%YAML:1.0\n---\nmodel_type: PINHOLE\ncamera_name: camera\nimage_width: 640\n"
    "image_height: 480\ndistortion_parameters:\n   k1: -0.25\n   k2: 0.125\n   p1: 0.001\n"
    "   p2: 0.002\nprojection_parameters:\n   fx: 310.5\n   fy: 311.5\n   cx: 322.25\n"
    "   cy: 241.75\n";
constexpr const char* kVinsFisheye =
    "%YAML:1.0\n---\nmodel_type: KANNALA_BRANDT\ncamera_name: camera\nimage_width: 640\n"
    "image_height: 480\nprojection_parameters:\n   k2: 0.01\n   k3: -0.02\n   k4: 0.003\n"
    "   k5: -0.004\n   mu: 310.5\n   mv: 311.5\n   u0: 322.25\n   v0: 241.75\n";

std::string vins(const std::string& left, const std::string& right) {
  const std::string matrix = ": !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: ";
  return "%YAML:1.0\n\nnum_of_cam: 2\ncam0_calib: \"" + left + "\"\ncam1_calib: \"" + right +
         "\"\nimage_width: 640\nimage_height: 480\nbody_T_cam0" + matrix +
         "[ 0., -1., 0., 0.02, 1., 0., 0., 0.03, 0., 0., 1., 0.04, 0., 0., 0., 1. ]\nbody_T_cam1" +
         matrix + "[ 0., -1., 0., 0.02, 1., 0., 0., 0.15, 0., 0., 1., 0.05, 0., 0., 0., 1. ]\n";
}

TEST_F(SlamFile, OfVinsFusionNamesThoseOfItsCameras) {
  write(kVinsPinhole, "left.yaml");
  write(kVinsFisheye, "right.yaml");
  const StereoCalibration calibration = read(vins("left.yaml", "right.yaml"));
  expect_position(calibration);
  EXPECT_EQ(calibration.format, "VINS-Fusion");
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{-0.25, 0.125, 0.001, 0.002}));
  EXPECT_EQ(calibration.right.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.right.coefficients, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
  EXPECT_DOUBLE_EQ(calibration.right.focal_y, 311.5);
  EXPECT_DOUBLE_EQ(calibration.right.center_y, 241.75);
}

TEST_F(SlamFile, OfVinsFusionKnowsTheModelOfMei) {
  std::string mei = replaced(kVinsPinhole, "PINHOLE", "MEI");
  mei = replaced(mei, "distortion_parameters",
                 "mirror_parameters:\n   xi: 1.5\ndistortion_parameters");
  mei = replaced(mei, "fx: 310.5", "gamma1: 775");
  mei = replaced(mei, "fy: 311.5", "gamma2: 780");
  mei = replaced(replaced(mei, "cx:", "u0:"), "cy:", "v0:");
  write(mei, "mei.yaml");
  const StereoCalibration calibration = read(vins("mei.yaml", "mei.yaml"));
  expect_position(calibration);
  EXPECT_EQ(calibration.left.lens, LensModel::kOmnidirectional);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 310);
  EXPECT_DOUBLE_EQ(calibration.left.focal_y, 312);
  EXPECT_DOUBLE_EQ(calibration.left.center_y, 241.75);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{1.5, -0.25, 0.125, 0.001, 0.002}));
  // It is equal after it was written and read.
  const std::string written = folder_.path("written.yml");
  ASSERT_TRUE(write_calibration(calibration, written).ok());
  EXPECT_EQ(read_valid(written).left, calibration.left);
  write(replaced(mei, "xi: 1.5", "xi: -0.5"), "mei.yaml");
  EXPECT_THAT(refused(vins("mei.yaml", "mei.yaml")), HasSubstr("mirror_parameters.xi is -0.5"));
}

TEST_F(SlamFile, OfVinsFusionWithoutItsCamerasIsRefused) {
  const std::string left = write(kVinsPinhole, "left.yaml");
  EXPECT_THAT(refused(vins("left.yaml", "none.yaml")), HasSubstr("none.yaml: cannot be read"));
  EXPECT_THAT(refused(vins("left.yaml", "/etc/passwd")),
              AllOf(HasSubstr("cam1_calib is '/etc/passwd'"), HasSubstr("in the same folder")));
  EXPECT_THAT(refused(vins("../left.yaml", "left.yaml")),
              HasSubstr("cam0_calib is '../left.yaml'"));
  EXPECT_THAT(refused(vins("config.yaml", "left.yaml")),
              HasSubstr("which is a file of VINS-Fusion; the file of a camera"));
  EXPECT_THAT(refused(replaced(vins("left.yaml", "left.yaml"), "cam1_calib", "other")),
              HasSubstr("there is no entry cam1_calib (the file of the right camera)"));
  EXPECT_THAT(refused(replaced(vins("left.yaml", "left.yaml"), "body_T_cam1", "other")),
              HasSubstr("there is no entry body_T_cam1"));
  EXPECT_THAT(read_refused(left), HasSubstr("give the file that names both cameras"));
  EXPECT_THAT(read_refused(left + "," + left), HasSubstr("give the file that names both cameras"));
  write(replaced(kVinsPinhole, "PINHOLE", "SCARAMUZZA"), "other.yaml");
  EXPECT_THAT(refused(vins("other.yaml", "left.yaml")),
              AllOf(HasSubstr("other.yaml: model_type is 'SCARAMUZZA'"),
                    HasSubstr("calibrate both cameras as PINHOLE, KANNALA_BRANDT or MEI")));
}

// OV2SLAM

std::string ov2slam() {
  std::string text = "%YAML 1.0\n---\nstereo: 1\n";
  for (const std::string side : {"left", "right"}) {
    text += "Camera.model_" + side + ": pinhole\nCamera." + side + "_nwidth: 640\nCamera." + side +
            "_nheight: 480\n";
    for (const auto& [name, value] : {std::pair{"fx", "310.5"},
                                      {"fy", "311.5"},
                                      {"cx", "322.25"},
                                      {"cy", "241.75"},
                                      {"k1", "0.01"},
                                      {"k2", "-0.02"},
                                      {"p1", "0.003"},
                                      {"p2", "-0.004"}}) {
      text += std::string("Camera.") + name + side[0] + ": " + value + "\n";
    }
  }
  return text + "body_T_cam0: [1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1]\n" +
         "body_T_cam1: [1, 0, 0, 0.37, 0, 1, 0, 0, 0, 0, 1, 0.51, 0, 0, 0, 1]\n";
}

TEST_F(SlamFile, OfOv2SlamHasBothCameras) {
  const StereoCalibration pinhole = read(ov2slam());
  expect_position(pinhole);
  EXPECT_EQ(pinhole.format, "OV2SLAM");
  EXPECT_EQ(pinhole.right.width, 640);
  EXPECT_DOUBLE_EQ(pinhole.left.focal_y, 311.5);
  EXPECT_EQ(pinhole.right.lens, LensModel::kPlumbBob);
  EXPECT_EQ(pinhole.right.coefficients, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
  const StereoCalibration fisheye =
      read(replaced(replaced(ov2slam(), "pinhole", "fisheye"), "pinhole", "fisheye"));
  EXPECT_EQ(fisheye.left.lens, LensModel::kFisheye);
  EXPECT_THAT(refused(replaced(ov2slam(), "pinhole", "ds")),
              HasSubstr("Camera.model_left is 'ds', only pinhole and fisheye"));
  EXPECT_THAT(refused(replaced(ov2slam(), "Camera.k2r", "k2r")), HasSubstr("Camera.k2r"));
  EXPECT_THAT(refused(replaced(ov2slam(), "body_T_cam1", "T")), HasSubstr("body_T_cam1"));
}

// Basalt

/// The axes of the IMU are those of the cameras, turned by a right angle around z.
std::string basalt(const std::string& left_model, const std::string& right_model) {
  const std::string turn =
      "\"qx\": 0, \"qy\": 0, \"qz\": 0.70710678118654752, "
      "\"qw\": 0.70710678118654752}";
  const std::string values =
      "{\"fx\": 310.5, \"fy\": 311.5, \"cx\": 322.25, \"cy\": 241.75, "
      "\"k1\": 0.01, \"k2\": -0.02, \"k3\": 0.003, \"k4\": -0.004, "
      "\"k5\": 0.5, \"k6\": 0.25, \"p1\": 0.001, \"p2\": 0.002, "
      "\"rpmax\": 2.5}";
  return "{\"value0\": {\"T_imu_cam\": [{\"px\": 0.02, \"py\": 0.03, \"pz\": 0.04, " + turn +
         ", {\"px\": 0.02, \"py\": 0.15, \"pz\": 0.05, " + turn +
         "], \"intrinsics\": [{\"camera_type\": \"" + left_model + "\", \"intrinsics\": " + values +
         "}, {\"camera_type\": \"" + right_model + "\", \"intrinsics\": " + values +
         "}], \"resolution\": [[640, 480], [640, 480]], \"vignette\": []}}\n";
}

TEST_F(SlamFile, OfBasaltHasPosesAsQuaternions) {
  const StereoCalibration calibration = read(basalt("kb4", "pinhole-radtan8"));
  expect_position(calibration);
  EXPECT_EQ(calibration.format, "Basalt");
  EXPECT_EQ(calibration.left.lens, LensModel::kFisheye);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
  EXPECT_EQ(calibration.right.coefficients,
            (std::vector<double>{0.01, -0.02, 0.001, 0.002, 0.003, -0.004, 0.5, 0.25}));
  EXPECT_EQ(read(basalt("pinhole", "pinhole")).left.lens, LensModel::kNone);
  const std::string path = write(basalt("kb4", "kb4"));
  expect_near(read_valid(path + "#0-1").translation, kRightOfLeft, 1e-9);
}

TEST_F(SlamFile, OfBasaltWithOtherModelsIsRefused) {
  for (const char* model : {"ds", "eucm"}) {
    EXPECT_THAT(refused(basalt(model, model)),
                AllOf(HasSubstr(std::string("camera_type is '") + model + "'"),
                      HasSubstr("calibrate with kb4 or pinhole-radtan8")));
  }
  EXPECT_THAT(refused(replaced(basalt("kb4", "kb4"), "0.7071", "0.9071")),
              HasSubstr("value0.T_imu_cam[0] has a quaternion of the length"));
  EXPECT_THAT(refused(replaced(basalt("kb4", "kb4"), "[640, 480], ", "")),
              HasSubstr("has 1 camera, 2 are needed"));
  EXPECT_THAT(read_refused(write(basalt("kb4", "kb4")) + "#0-7"), HasSubstr("no camera 7"));
  EXPECT_THAT(refused(replaced(basalt("kb4", "kb4"), "\"px\"", "\"x\"")),
              HasSubstr("value0.T_imu_cam[0] has no entry px"));
}

// mrcal

std::string mrcal(const std::string& model, const std::string& coefficients,
                  const std::string& extrinsics) {
  return "# generated by hand\n{\n    'lensmodel':  '" + model +
         "',\n\n    # intrinsics are fx,fy,cx,cy,distortion0,....\n    'intrinsics': [ 310.5, "
         "311.5, 322.25, 241.75," +
         coefficients +
         "],\n\n    'valid_intrinsics_region': [\n    [ 0, 0 ],\n    [ 0, 479 ],\n],\n\n"
         "    # extrinsics are rt_fromref\n    'extrinsics': [ " +
         extrinsics +
         ",],\n\n    'imagersize': [ 640, 480,],\n\n    'icam_intrinsics': 0,\n\n"
         "    'optimization_inputs': b'P)h>@6aWAK{2mjzO:aX, #[}000',\n}\n";
}

TEST_F(SlamFile, OfMrcalHasOneCameraOfThePair) {
  // Both cameras are turned by a right angle around z from the reference.
  const std::string turn = "0, 0, 1.5707963267948966, ";
  const std::string left =
      write(mrcal("LENSMODEL_OPENCV4", "0.01, -0.02, 0.003, -0.004,", turn + "0.02, 0.03, 0.04"),
            "left.cameramodel");
  const std::string right =
      write(mrcal("LENSMODEL_PINHOLE", "", turn + "-0.1, 0.03, 0.03"), "right.cameramodel");
  const StereoCalibration calibration = read_valid(left + "," + right);
  expect_position(calibration);
  EXPECT_EQ(calibration.format, "mrcal");
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
  EXPECT_EQ(calibration.right.lens, LensModel::kNone);
  EXPECT_EQ(calibration.right.height, 480);
  EXPECT_THAT(read_refused(left), HasSubstr("has one camera; give two files"));
  const std::string text = read_text(right);
  const std::string dense = replaced(text.substr(text.find('{')), "{\n    ", "{ ");
  expect_position(read_valid(left + "," + write(dense)));
}

TEST_F(SlamFile, OfMrcalWithOtherModelsIsRefused) {
  const std::string good = write(mrcal("LENSMODEL_PINHOLE", "", "0, 0, 0, 0, 0, 0"), "good");
  const auto right = [&](const std::string& text) {
    return read_refused(good + "," + write(text));
  };
  EXPECT_THAT(
      right(mrcal("LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=30_Ny=18_fov_x_deg=150", "",
                  "0, 0, 0, -0.1, 0, 0")),
      AllOf(HasSubstr("lensmodel is 'LENSMODEL_SPLINED"), HasSubstr("mrcal-convert-lensmodel")));
  EXPECT_THAT(right(mrcal("LENSMODEL_OPENCV8", "0.1, 0.2,", "0, 0, 0, -0.1, 0, 0")),
              HasSubstr("intrinsics has 6 values, 12 are needed"));
  EXPECT_THAT(right(mrcal("LENSMODEL_PINHOLE", "", "0, 0, 0, -0.1, 0")),
              HasSubstr("extrinsics has 5 values, 6 are needed"));
  const std::string text = mrcal("LENSMODEL_PINHOLE", "", "0, 0, 0, -0.1, 0, 0");
  EXPECT_THAT(right(text.substr(0, text.find("O:aX"))), HasSubstr("the file is truncated"));
  EXPECT_THAT(read_refused(good + "," + good), HasSubstr("a baseline of 0 m"));
}

// ROS's INI

std::string camera_ini(const std::string& name, const std::string& fourth) {
  return "# oST version 5.0 parameters\n\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n[" + name +
         "]\n\ncamera matrix\n310.5 0.000000 322.25\n0.000000 311.5 241.75\n0.000000 0.000000 "
         "1.000000\n\ndistortion\n-0.25 0.125 0.001 0.002 0.000000\n\nrectification\n1.000000 "
         "0.000000 0.000000\n0.000000 1.000000 0.000000\n0.000000 0.000000 1.000000\n\n"
         "projection\n300.5 0.000000 320.25 " +
         fourth + "\n0.000000 300.5 240.5 0.000000\n0.000000 0.000000 1.000000 0.000000\n\n";
}

TEST_F(SlamFile, OfRosAsIniHasOneCameraOrBoth) {
  const std::string left = write(camera_ini("narrow_stereo/left", "0.000000"), "left.ini");
  const std::string right = write(camera_ini("narrow_stereo/right", "-36.06"), "right.ini");
  const std::string both = write(read_text(left) + read_text(right), "ost.txt");
  // What camera_calibration prints begins with other words.
  const std::string printed = write(
      "Left:\nD = [-0.25, 0.125]\nR = [1.0, 0.0]\n\nRight:\nself.T = [0.1]\n" + read_text(both),
      "printed.txt");
  for (const std::string& path : {left + "," + right, both, printed}) {
    const StereoCalibration calibration = read_valid(path);
    EXPECT_EQ(calibration.format, "ROS camera_info");
    EXPECT_EQ(calibration.left.width, 640);
    EXPECT_DOUBLE_EQ(calibration.left.focal_y, 311.5);
    EXPECT_EQ(calibration.right.coefficients, (std::vector<double>{-0.25, 0.125, 0.001, 0.002, 0}));
    EXPECT_DOUBLE_EQ(calibration.rectification->focal_length, 300.5);
    EXPECT_NEAR(calibration.baseline(), 0.12, 1e-12);
  }
  EXPECT_THAT(read_refused(left), HasSubstr("has one camera; give two files"));
  EXPECT_THAT(read_refused(both + "," + right), HasSubstr("has several cameras"));
  EXPECT_THAT(read_refused(left + "," + left), HasSubstr("calibrate both cameras together"));
}

TEST_F(SlamFile, OfRosAsIniThatIsBrokenIsRefused) {
  const std::string left = write(camera_ini("left", "0.0"), "left.ini");
  const auto right = [&](const std::string& from, const std::string& to) {
    return read_refused(left + "," + write(replaced(camera_ini("right", "-36.06"), from, to)));
  };
  EXPECT_THAT(right("camera matrix", "camera"), HasSubstr("there is no entry camera_matrix"));
  EXPECT_THAT(right("310.5 ", ""), HasSubstr("camera_matrix has 8 values, 9 are needed"));
  EXPECT_THAT(right("-0.25 ", ""), HasSubstr("as fisheye lenses have, but the file states no"));
  EXPECT_THAT(right("311.5", "-nan"), HasSubstr("-nan"));
  EXPECT_THAT(right("width", ""), HasSubstr("a name such as width is needed before it"));
  EXPECT_THAT(right("300.5 240.5", "302.5 240.5"), HasSubstr("calibrate again with square pixels"));
}

// All of them

TEST_F(SlamFile, ThatIsTruncatedIsRefused) {
  write(kVinsPinhole, "left.yaml");
  const std::string left = write(camera_ini("left", "0.0"), "left.ini");
  const std::string reference =
      write(mrcal("LENSMODEL_PINHOLE", "", "0, 0, 0, 0, 0, 0"), "left.cameramodel");
  const std::string pose = replaced(kPose, "1.0]", "1.00]");
  const struct {
    std::string before, text;
    std::size_t optional;  // bytes at the end that are not needed
  } cases[] = {{"", orbslam("PinHole", std::string(kSecond) + pose), 3},
               {"", orbslam("Rectified", "Stereo.b: 0.12\n"), 5},
               {"", vins("left.yaml", "left.yaml"), 4},
               {"", basalt("kb4", "kb4"), 1},
               {left + ",", camera_ini("right", "-36.06"), 10},
               {reference + ",", mrcal("LENSMODEL_PINHOLE", "", "0, 0, 0, -0.1, 0, 0"), 2}};
  for (const auto& [before, text, optional] : cases) {
    for (std::size_t size = 1; size + optional < text.size(); size += 1 + text.size() / 80) {
      const std::string path = before + write(text.substr(0, size), "broken");
      const Result<StereoCalibration> result = read_calibration(path, 640, 480);
      EXPECT_FALSE(result.ok()) << text.substr(0, 60) << " up to byte " << size;
    }
  }
}

TEST_F(SlamFile, WithImpossibleNumbersIsRefused) {
  write(kVinsPinhole, "left.yaml");
  const std::string texts[] = {orbslam("PinHole", std::string(kSecond) + kPose),
                               orbslam("Rectified", "Stereo.b: 0.12\n"),
                               basalt("kb4", "pinhole-radtan8"), vins("left.yaml", "left.yaml")};
  for (const std::string& text : texts) {
    for (const char* number : {".nan", ".inf", "1e999", "[]", "{}", "\"\"", "-1e30"}) {
      // The first number that matters: fx, or the pose.
      const std::string from = text.find("310.5") != std::string::npos ? "310.5" : "0.02";
      const std::string message = refused(replaced(text, from, number));
      EXPECT_THAT(message, HasSubstr("config.yaml")) << message;
    }
  }
}

}  // namespace
}  // namespace mtstereo::test::calibration_slam_test

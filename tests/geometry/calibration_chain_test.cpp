// SPDX-License-Identifier: LGPL-2.1-or-later
// Camera chains of Kalibr and open_vins: the position of the cameras from T_cn_cnm1, or from the
// positions of both cameras to the IMU.
#include "calibration_support.hpp"

namespace mtstereo::test::calibration_chain_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// x of both cameras is y of the IMU. The right camera is 0.12 m beside the left one and 0.01 m in
// front of it.
constexpr const char* kLeftToImu = "[[0, -1, 0, 0.02], [1, 0, 0, 0.03], [0, 0, 1, 0.04]";
constexpr const char* kRightToImu = "[[0, -1, 0, 0.02], [1, 0, 0, 0.15], [0, 0, 1, 0.05]";
constexpr const char* kImuToLeft = "[[0, 1, 0, -0.03], [-1, 0, 0, 0.02], [0, 0, 1, -0.04]";
constexpr const char* kImuToRight = "[[0, 1, 0, -0.15], [-1, 0, 0, 0.02], [0, 0, 1, -0.05]";
constexpr const char* kLeftToRight = "[[1, 0, 0, -0.12], [0, 1, 0, 0], [0, 0, 1, -0.01]";
constexpr const char* kOtherPlace = "[[1, 0, 0, -0.06], [0, 1, 0, 0], [0, 0, 1, -0.01]";
constexpr const char* kOtherTurn = "[[0.96, -0.28, 0, -0.12], [0.28, 0.96, 0, 0], [0, 0, 1, -0.01]";

std::string pose(const char* name, const char* matrix) {
  return std::string("  ") + name + ": " + matrix + ", [0.0, 0.0, 0.0, 1.0]]\n";
}

/// A chain with these positions of the cameras.
std::string chain(const std::string& left, const std::string& right) {
  const std::string camera =
      "  camera_model: pinhole\n  distortion_coeffs: [0.01, -0.02, 0.003, -0.004]\n"
      "  distortion_model: equidistant\n  intrinsics: [310.5, 311.5, 322.25, 241.75]\n"
      "  resolution: [640, 480]\n";
  return "%YAML:1.0 # the type of the file\n\ncam0:\n" + camera + left + "cam1:\n" + camera + right;
}

class Chain : public ::testing::Test {
 protected:
  std::string write(const std::string& left, const std::string& right) {
    return folder_.write("chain.yaml", chain(left, right));
  }
  void expect_position(const StereoCalibration& calibration) {
    expect_near(calibration.rotation, Matrix3{1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-12);
    expect_near(calibration.translation, Vector3{-0.12, 0, -0.01}, 1e-12);
    EXPECT_EQ(calibration.left.lens, LensModel::kFisheye);
    EXPECT_EQ(calibration.format, "Kalibr camchain");
  }
  CalibrationFolder folder_;
};

TEST_F(Chain, NeedsOnlyThePositionsOfTheCamerasOnTheImu) {
  expect_position(read_valid(write(pose("T_imu_cam", kLeftToImu), pose("T_imu_cam", kRightToImu))));
  expect_position(read_valid(write(pose("T_cam_imu", kImuToLeft), pose("T_cam_imu", kImuToRight))));
  expect_position(read_valid(write(pose("T_imu_cam", kLeftToImu), pose("T_cam_imu", kImuToRight))));
}

TEST_F(Chain, SelectsByPositionsOnTheImuToo) {
  const std::string swapped = write(pose("T_imu_cam", kRightToImu), pose("T_imu_cam", kLeftToImu));
  expect_position(read_valid(swapped + "#cam1-cam0"));
}

TEST_F(Chain, MayBeInMapsOfOneEntryAsInRigsAndParametersOfRos) {
  std::string lines = chain("", pose("T_cn_cnm1", kLeftToRight));
  lines.erase(0, lines.find("cam0:"));
  std::string inner;
  for (std::size_t begin = 0, end = 0; begin < lines.size(); begin = end + 1) {
    end = lines.find('\n', begin);
    inner += "    " + lines.substr(begin, end - begin) + "\n";
  }
  const std::string node = "rectify:\n  ros__parameters:\n";
  expect_position(read_valid(folder_.write("node.yaml", node + inner)));
  expect_position(read_valid(folder_.write("all.yaml", replaced(node, "rectify", "/**") + inner)));
  expect_position(read_valid(folder_.write("rig.yaml", "%YAML:1.0\nstereo0:\n" + inner)));
  std::string wrong = inner;
  wrong.replace(wrong.find("310.5"), 5, "-3.10");
  EXPECT_THAT(read_refused(folder_.write("wrong.yaml", node + wrong)),
              HasSubstr("rectify.ros__parameters.cam0.intrinsics"));
  EXPECT_THAT(read_refused(folder_.write("other.yaml", "rectify:\n  size: [3, 4]\n")),
              HasSubstr("other.yaml: is not a calibration of a known format"));
}

TEST_F(Chain, UsesItsOwnPositionWhereBothAgree) {
  expect_position(
      read_valid(write(pose("T_cam_imu", kImuToLeft),
                       pose("T_cam_imu", kImuToRight) + pose("T_cn_cnm1", kLeftToRight))));
  expect_position(read_valid(write("", pose("T_cn_cnm1", kLeftToRight))));
}

TEST_F(Chain, IsRefusedWhereItsPositionsContradictEachOther) {
  const auto contradiction = [&](const char* chain_position, const char* right_name,
                                 const char* right_position) {
    return read_refused(
        write(pose("T_cam_imu", kImuToLeft),
              pose(right_name, right_position) + pose("T_cn_cnm1", chain_position)));
  };
  EXPECT_THAT(contradiction(kOtherPlace, "T_cam_imu", kImuToRight),
              AllOf(HasSubstr("cam1 states two positions that contradict each other"),
                    HasSubstr("T_cn_cnm1 a baseline of 0.0608 m"), HasSubstr("0.1204 m"),
                    HasSubstr("remove the wrong ones")));
  EXPECT_THAT(contradiction(kOtherTurn, "T_cam_imu", kImuToRight),
              HasSubstr("a rotation that differs by 16.2602 degrees"));
  // The direction of T_imu_cam is that from the camera to the IMU.
  EXPECT_THAT(contradiction(kLeftToRight, "T_imu_cam", kImuToRight), HasSubstr("contradict"));
}

TEST_F(Chain, KnowsOmnidirectionalCameras) {
  const auto omni = [&](const std::string& from, const std::string& to) {
    std::string text = chain("", pose("T_cn_cnm1", kLeftToRight));
    text = replaced(text, "camera_model: pinhole", "camera_model: omni");
    text = replaced(text, "[310.5, 311.5", "[1.5, 775, 780");
    text = replaced(text, "equidistant", "radtan");
    return folder_.write("omni.yaml", replaced(text, from, to));
  };
  const StereoCalibration calibration = read_valid(omni("radtan", "radtan"));
  EXPECT_EQ(calibration.left.lens, LensModel::kOmnidirectional);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 310);
  EXPECT_DOUBLE_EQ(calibration.left.center_x, 322.25);
  EXPECT_EQ(calibration.left.coefficients, (std::vector<double>{1.5, 0.01, -0.02, 0.003, -0.004}));
  EXPECT_EQ(calibration.right.lens, LensModel::kFisheye);
  EXPECT_THAT(read_refused(omni("radtan", "equidistant")), HasSubstr("calibrate with omni-radtan"));
  EXPECT_THAT(read_refused(omni("[1.5, ", "[")),
              HasSubstr("cam0.intrinsics has 4 values, 5 are needed: xi, fu, fv, pu, pv"));
  EXPECT_THAT(read_refused(omni("[1.5, ", "[-1.5, ")), HasSubstr("xi must not be negative"));
}

TEST_F(Chain, WithOnePositionOnlyNamesWhatIsMissing) {
  EXPECT_THAT(read_refused(write(pose("T_imu_cam", kLeftToImu), "")),
              AllOf(HasSubstr("cam1 has no entry T_cn_cnm1"),
                    HasSubstr("cam0 and cam1 have no T_cam_imu or T_imu_cam")));
  EXPECT_THAT(read_refused(write("  T_imu_cam: [1, 2]\n", pose("T_imu_cam", kRightToImu))),
              HasSubstr("cam0.T_imu_cam has 2 values, 16 are needed"));
}

}  // namespace
}  // namespace mtstereo::test::calibration_chain_test

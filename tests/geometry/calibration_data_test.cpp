// SPDX-License-Identifier: LGPL-2.1-or-later
// The calibrations of the public data sets, where MTSTEREO_TEST_DATA names a folder with them.
#include <cstdlib>

#include "calibration_support.hpp"

namespace mtstereo::test {
namespace {
namespace fs = std::filesystem;

using ::testing::HasSubstr;

class CalibrationsOfDataSets : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MTSTEREO_TEST_DATA");
    if (folder == nullptr || !fs::is_directory(folder)) {
      GTEST_SKIP() << "no data sets: MTSTEREO_TEST_DATA names no folder with them";
    }
    folder_ = folder;
  }
  /// The path of a file, or an empty text if it is not there.
  std::string file(const char* name) {
    const fs::path path = folder_ / name;
    return fs::exists(path) ? path.string() : std::string();
  }
  fs::path folder_;
};

TEST_F(CalibrationsOfDataSets, KittiSequenceStatesProjectionsWithoutNames) {
  const std::string path = file("kitti_sequence/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no kitti_sequence";
  const StereoCalibration calibration = read_valid(path, 1226, 370);
  EXPECT_EQ(calibration.left.width, 1226);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 707.0912);
  EXPECT_DOUBLE_EQ(calibration.left.center_y, 183.1104);
  EXPECT_NEAR(calibration.baseline(), 379.8145 / 707.0912, 1e-12);
}

TEST_F(CalibrationsOfDataSets, KittiRawStatesTheGrayCameras) {
  const std::string path = file("more/kitti_raw/calib_cam_to_cam.txt");
  if (path.empty()) GTEST_SKIP() << "no kitti_raw";
  const StereoCalibration calibration = read_valid(path, 1392, 512);
  EXPECT_DOUBLE_EQ(calibration.left.focal_x, 984.2439);
  EXPECT_DOUBLE_EQ(calibration.right.coefficients[4], -0.05314062);
  EXPECT_NEAR(calibration.baseline(), 0.53717, 1e-4);
  EXPECT_NEAR(calibration.rectification->baseline, 387.5744 / 721.5377, 1e-12);
  EXPECT_EQ(calibration.rectification->width, 1242);
  EXPECT_EQ(calibration.date, "2012-01-09T13:57:47");
}

TEST_F(CalibrationsOfDataSets, Eth3dHasTheFormOfMiddlebury) {
  const std::string path = file("eth3d/playground_1l/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no eth3d";
  const StereoCalibration calibration = read_valid(path);
  EXPECT_EQ(calibration.left.width, 941);
  EXPECT_NEAR(calibration.baseline(), 0.0595549, 1e-12);
}

TEST_F(CalibrationsOfDataSets, EveryOtherFileIsReadOrStatesNoCameras) {
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.find("calib") == std::string::npos || entry.path().extension() != ".txt") continue;
    ++files;
    // Middlebury's older and scaled pairs state sizes only.
    const std::string text = read_text(entry.path());
    const bool sizes_only =
        text.find("ndisp") != std::string::npos && text.find("cam0") == std::string::npos;
    if (sizes_only) {
      EXPECT_THAT(read_refused(entry.path()), HasSubstr("there is no entry cam0"));
    } else {
      (void)read_valid(entry.path());
    }
  }
  if (files == 0) GTEST_SKIP() << "no calibrations";
}

}  // namespace
}  // namespace mtstereo::test

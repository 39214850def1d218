// SPDX-License-Identifier: LGPL-2.1-or-later
// The calibrations of the public data sets, where MTSTEREO_TEST_DATA names a folder with them.
#include <cstdlib>

#include "calibration_support.hpp"
#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo::test::calibration_data_test {
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

/// A file as a program wrote it, and what OpenCV's stereoRectify() or fisheye::stereoRectify() make
/// of its numbers at alpha=0.
struct ProgramFile {
  const char* file;
  int width, height;    ///< of the video, 0 if the file states it
  double baseline;      ///< [m]
  double focal_length;  ///< [px]; 0 where OpenCV frames views by directions that it gets wrong
  const char* format;
};

class CalibrationsOfPrograms : public CalibrationsOfDataSets {
 protected:
  void SetUp() override {
    CalibrationsOfDataSets::SetUp();
    if (!IsSkipped() && !fs::is_directory(folder_ / "calibrations")) {
      GTEST_SKIP() << "no folder calibrations in " << folder_;
    }
    folder_ /= "calibrations";
  }
};

TEST_F(CalibrationsOfPrograms, AreRectifiedAsOpenCvDoes) {
  const ProgramFile files[] = {
      {"depthai-oak-d.json", 1280, 800, 0.0738079, 0, "DepthAI"},
      {"depthai-oak-d.json", 1280, 720, 0.0738079, 0, "DepthAI"},
      {"depthai-oak-d.json", 640, 400, 0.0738079, 0, "DepthAI"},
      {"zed-SN20.conf", 2208, 1242, 0.1201403, 1055.297, "ZED"},
      {"zed-SN20.conf", 1280, 720, 0.1201403, 0, "ZED"},
      {"openvins-t265.yaml", 0, 0, 0.0627412, 0, "Kalibr camchain"},
      {"openvins-uzhfpv-outdoor45.yaml", 0, 0, 0.0793809, 0, "Kalibr camchain"},
      {"openvins-tumvi.yaml", 0, 0, 0.1010873, 0, "Kalibr camchain"},
      {"orbslam3-euroc.yaml", 0, 0, 0.1100778, 436.235, "OpenCV"},
      {"vins/mynteye_stereo_config.yaml", 0, 0, 0.1165919, 0, "VINS-Fusion"},
      {"opencv-swapped.yml", 640, 480, 0.0140523, 591.566, "OpenCV"},
  };
  for (const ProgramFile& expected : files) {
    SCOPED_TRACE(expected.file);
    const std::string path = file(expected.file);
    if (path.empty()) continue;
    StereoCalibration calibration = read_valid(path, expected.width, expected.height);
    if (expected.width > 0) {
      calibration = scale_calibration(calibration, expected.width, expected.height).value();
    }
    EXPECT_EQ(calibration.format, expected.format);
    for (const double alpha : {0.0, kKeepScale}) {
      RectificationOptions options;
      options.alpha = alpha;
      options.from_file = false;
      const Result<Rectification> views = rectify(calibration, options);
      ASSERT_TRUE(views.ok()) << views.error().message;
      EXPECT_NEAR(views->baseline, expected.baseline, 1e-3 * expected.baseline);
      const double focal = (calibration.left.focal_y + calibration.right.focal_y) / 2;
      if (alpha != 0) {
        EXPECT_NEAR(views->focal_length, focal, 0.01 * focal);
      } else if (expected.focal_length > 0) {
        EXPECT_NEAR(views->focal_length, expected.focal_length, 0.01 * expected.focal_length);
      }
    }
  }
}

TEST_F(CalibrationsOfPrograms, KeepTheRectificationOfTheFile) {
  const std::string orbslam = file("orbslam3-euroc.yaml");
  if (orbslam.empty()) GTEST_SKIP() << "no orbslam3-euroc.yaml";
  const StereoCalibration calibration = read_valid(orbslam);
  EXPECT_DOUBLE_EQ(calibration.rectification->focal_length, 435.2046959714599);
  EXPECT_NEAR(calibration.rectification->baseline, 0.11007784, 1e-8);
  // Its board had squares of 1, so the length is in squares.
  const std::string intrinsics = file("opencv-squares-intrinsics.yml");
  const std::string extrinsics = file("opencv-squares-extrinsics.yml");
  if (intrinsics.empty() || extrinsics.empty()) return;
  const StereoCalibration squares = read_valid(intrinsics + "," + extrinsics, 640, 480);
  EXPECT_NEAR(squares.rectification->focal_length, 439.76968, 1e-5);
  EXPECT_NEAR(squares.baseline(), 3.34289, 1e-5);
}

TEST_F(CalibrationsOfPrograms, ThatAreNoPairAreRefusedByName) {
  const std::string ini = file("ros.ini");
  if (!ini.empty()) {
    EXPECT_THAT(read_refused(ini), HasSubstr("which has one camera; give two files"));
    EXPECT_THAT(read_refused(ini + "," + ini), HasSubstr("calibrate both cameras together"));
  }
}

}  // namespace
}  // namespace mtstereo::test::calibration_data_test

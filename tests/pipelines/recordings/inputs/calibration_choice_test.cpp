// SPDX-License-Identifier: LGPL-2.1-or-later

// Calibrations in the folders of data sets.

#include "recordings/inputs/calibration_choice.hpp"

#include <gmock/gmock.h>

#include "recordings/matching/work_options.hpp"
#include "recordings/support/recordings_folder.hpp"

namespace mtstereo::run::calibration_choice_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::write_text;

// Of rectified views, as KITTI has it.
std::string projections(const char* baseline_times_focal_length) {
  return std::string("P0: 100 0 99.5 0 0 100 59.5 0 0 0 1 0\nP1: 100 0 99.5 -") +
         baseline_times_focal_length + " 0 100 59.5 0 0 0 1 0\n";
}

// The same with the size of the views, as Middlebury has it.
std::string sized(const char* baseline) {
  return std::string(
             "cam0=[100 0 99.5; 0 100 59.5; 0 0 1]\ncam1=[100 0 99.5; 0 100 59.5; 0 0 1]\n"
             "doffs=0\nwidth=200\nheight=120\nbaseline=") +
         baseline + "\n";
}

const char* const kRaw =
    "K1: [ 100, 0, 99.5, 0, 100, 59.5, 0, 0, 1 ]\nD1: [ -0.2, 0.05, 0, 0 ]\n"
    "K2: [ 100, 0, 99.5, 0, 100, 59.5, 0, 0, 1 ]\nD2: [ -0.2, 0.05, 0, 0 ]\n"
    "R: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\nT: [ -0.1, 0, 0 ]\n";
const char* const kRectification =
    "R1: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\nR2: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\n"
    "P1: [ 90, 0, 99.5, 0, 0, 90, 59.5, 0, 0, 0, 1, 0 ]\n"
    "P2: [ 90, 0, 99.5, -9, 0, 90, 59.5, 0, 0, 0, 1, 0 ]\n";

class Calibrations : public testing::Recordings {
 protected:
  void write_views(const std::string& left, const std::string& right,
                   std::initializer_list<const char*> names = {"000000.png", "000001.png"}) const {
    write_images(left, names);
    write_images(right, names, true);
  }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }

  std::string calibration_of(const char* folder) const { return recognized({folder}).calibration; }

  Recording only() const {
    std::vector<Problem> problems;
    const std::vector<Recording> recordings = found(problems);
    EXPECT_EQ(recordings.size(), 1U);
    return recordings.empty() ? Recording() : recordings.front();
  }
};

TEST_F(Calibrations, MayBeInAFolderAroundThatOfTheViews) {
  write_views("day/drive/undistorted/cam0", "day/drive/undistorted/cam1");
  write("day/calibration/rig.txt", sized("100"));
  EXPECT_EQ(only().calibration, path("day/calibration/rig.txt"));
  EXPECT_TRUE(only().rectified);
  write("day/drive/calib.txt", sized("200"));
  EXPECT_EQ(only().calibration, path("day/drive/calib.txt"));
  write("day/drive/undistorted/calib_rig/a.txt", projections("30"));
  EXPECT_EQ(only().calibration, path("day/drive/undistorted/calib_rig/a.txt"));
}

// Of Kalibr, without distortion and rotation.
std::string parallel(const std::string& left, const std::string& right) {
  const std::string lens = "  camera_model: pinhole\n  distortion_model: none\n";
  const std::string size = "\n  resolution: [ 400, 240 ]\n";
  return "cam0:\n" + lens + "  intrinsics: " + left + size + "cam1:\n" + lens +
         "  intrinsics: " + right + size +
         "  T_cn_cnm1: [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
}

TEST_F(Calibrations, OfFoundationStereoAreBesideTheViews) {
  write_images("demo", {"left.png"});
  write_images("demo", {"right.png"}, true);
  write("demo/k.txt", "100 0 99.5 0 100 59.5 0 0 1\n0.063\n");
  EXPECT_THAT(calibration_of("demo"), IsEmpty());
  write("demo/K.txt", "100 0 99.5 0 100 59.5 0 0 1\n0.063\n");
  EXPECT_EQ(calibration_of("demo"), path("demo/K.txt"));
  write("demo/K.txt", "100 0 99.5 0 100 59.5 0 0 1\n");
  EXPECT_THAT(calibration_of("demo"), IsEmpty());
  EXPECT_THAT(recognized({"demo"}).remarks, Contains(HasSubstr("K.txt")));
}

TEST_F(Calibrations, OfParallelCamerasDescribeTheViewsAsTheyAre) {
  write_views("left", "right");
  write("camchain.yaml", parallel("[ 200, 200, 199.5, 119.5 ]", "[ 200, 200, 199.5, 119.5 ]"));
  EXPECT_EQ(only().calibration, path("camchain.yaml"));
  EXPECT_TRUE(only().rectified);
  for (const char* other :
       {"[ 200, 200, 199.5, 129.5 ]", "[ 202, 202, 199.5, 119.5 ]", "[ 200, 200, 209.5, 119.5 ]"}) {
    write("camchain.yaml", parallel("[ 200, 200, 199.5, 119.5 ]", other));
    EXPECT_FALSE(only().rectified) << other;
  }
  // The pixels are not square: those of rectified views are.
  const std::string tall = "[ 200, 210, 199.5, 119.5 ]";
  write("camchain.yaml", parallel(tall, tall));
  EXPECT_EQ(only().calibration, path("camchain.yaml"));
  EXPECT_FALSE(only().rectified);
}

// A folder may have those of other cameras.
TEST_F(Calibrations, AroundTheViewsMustStateTheirSize) {
  write_views("day/drive/left", "day/drive/right");
  write("day/calibration/rig.txt", projections("10"));
  EXPECT_THAT(only().calibration, IsEmpty());
  EXPECT_THAT(only().remarks, Contains(HasSubstr("rig.txt: is not beside the views and does not")));
  std::string twice = sized("100");
  twice.replace(twice.find("200"), 3, "400").replace(twice.find("120"), 3, "240");
  write("day/calibration/rig.txt", twice);
  EXPECT_THAT(only().calibration, IsEmpty());
  write("day/calibration/rig.txt", sized("100"));
  EXPECT_EQ(only().calibration, path("day/calibration/rig.txt"));
}

TEST_F(Calibrations, OutsideOfTheGivenFolderAreNotUsed) {
  write_views("drive/left", "drive/right");
  write("calibration/rig.txt", projections("10"));
  write("camera.txt", projections("10"));
  EXPECT_THAT(calibration_of("drive"), IsEmpty());
  EXPECT_THAT(recognized({"drive/left", "drive/right"}).calibration, IsEmpty());
}

// Cityscapes and DrivingStereo.
TEST_F(Calibrations, WithTheNameOfTheSceneCountFirst) {
  write_views("leftImg8bit/train/ulm", "rightImg8bit/train/ulm");
  write("camera/train/ulm/ulm_0_camera.json", projections("10"));
  write("camera/train/jena/jena_0_camera.json", projections("20"));
  EXPECT_EQ(only().calibration, path("camera/train/ulm/ulm_0_camera.json"));
  fs::remove_all(path("camera"));
  write("calib/half-image/ulm.txt", projections("30"));
  write("calib/half-image/jena.txt", projections("40"));
  write("calib/all.txt", projections("50"));
  EXPECT_EQ(only().calibration, path("calib/half-image/ulm.txt"));
}

// KITTI 2015 has one for each image.
TEST_F(Calibrations, ThatDifferAreNotUsed) {
  write_views("training/image_2", "training/image_3");
  write("training/calib/000000.txt", projections("10"));
  write("training/calib/000001.txt", projections("10"));
  EXPECT_EQ(calibration_of("training"), path("training/calib/000000.txt"));
  write("training/calib/000001.txt", projections("20"));
  const Recording recording = recognized({"training"});
  EXPECT_THAT(recording.calibration, IsEmpty());
  EXPECT_THAT(recording.remarks,
              Contains(AllOf(HasSubstr("No calibration is used: there are several"),
                             HasSubstr("calib/000001.txt: choose one by --calibration"))));
}

TEST_F(Calibrations, OfKittiAreThoseOfTheCameras) {
  write_views("training/image_0", "training/image_1");
  write("training/calib/000000.txt", projections("10"));
  EXPECT_EQ(calibration_of("training"), path("training/calib/000000.txt") + "#gray");
}

TEST_F(Calibrations, BesideFoldersOfViewsThatHaveTheirImagesBelow) {
  write_views("cam0/data", "cam1/data");
  write("calib.txt", projections("10"));
  EXPECT_EQ(calibration_of(""), path("calib.txt"));
  EXPECT_EQ(recognized({"cam0", "cam1"}).calibration, path("calib.txt"));
}

TEST_F(Calibrations, OfRawViewsAreNotUsedForViewsThatAreNamedRectified) {
  write_views("undistorted_images/cam0", "undistorted_images/cam1");
  write("undistorted_images/stereo.yml", kRaw);
  Recording recording = only();
  EXPECT_THAT(recording.calibration, IsEmpty());
  EXPECT_TRUE(recording.rectified);
  EXPECT_THAT(recording.remarks, Contains(AllOf(HasSubstr("stereo.yml: describes raw views"),
                                                HasSubstr("undistorted_images/cam0"))));
  WorkOptions depth;
  depth.products = {Product::kDepth};
  EXPECT_THAT(test::error_of<UserError>([&] { check_products(recording, depth); }),
              AllOf(HasSubstr("depths and clouds need a calibration. No calibration is used: "),
                    HasSubstr("--calibration uses it")));
  InputOptions options;
  options.calibration = path("undistorted_images/stereo.yml");
  recording = recognized({"undistorted_images"}, options);
  EXPECT_FALSE(recording.rectified);
  EXPECT_THAT(recording.remarks, Contains(HasSubstr("if so, state --rectified yes")));
  options = {};
  options.rectified = true;
  EXPECT_THAT(recognized({"undistorted_images"}, options).calibration, HasSubstr("stereo.yml"));
  // One with the rectification describes both.
  write("undistorted_images/stereo.yml", std::string(kRaw) + kRectification);
  recording = only();
  EXPECT_EQ(recording.calibration, path("undistorted_images/stereo.yml"));
  EXPECT_TRUE(recording.rectified);
}

TEST_F(Calibrations, OfRectifiedViewsAreNotUsedForViewsThatAreNamedDistorted) {
  write_views("images/left/distorted", "images/right/distorted");
  write("calibration/rig.txt", sized("100"));
  EXPECT_THAT(only().calibration, IsEmpty());
  EXPECT_THAT(only().remarks, Contains(HasSubstr("rig.txt: describes rectified views")));
}

TEST_F(Calibrations, OfViewsWithOtherNamesRectifyThem) {
  write_views("direct/left", "direct/right");
  write("direct/stereo.yml", kRaw);
  EXPECT_EQ(only().calibration, path("direct/stereo.yml"));
  EXPECT_FALSE(only().rectified);
}

}  // namespace
}  // namespace mtstereo::run::calibration_choice_test

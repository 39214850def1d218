// SPDX-License-Identifier: LGPL-2.1-or-later

// Folders as the data sets have them, and the data sets themselves where they are there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/recognition.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/media/frame_index.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::data_sets_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;
using testing::write_text;

class DataSets : public ::testing::Test {
 protected:
  void write_images(const std::string& folder, std::initializer_list<const char*> names,
                    cv::Size size) const {
    for (const char* name : names) {
      const fs::path file = folder_ / (folder + "/" + name);
      ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(size, CV_8UC1, cv::Scalar(80)))) << file;
    }
  }

  void copy_calibration(const char* name, const std::string& to) const {
    fs::copy_file(fs::path(MTSTEREO_CALIBRATION_FILES) / name, folder_ / to);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  Recording recognized(const std::string& folder) const { return recognize({path(folder)}, {}); }

  TemporaryFolder folder_;
};

// A folder of the data that is not part of the source, or "" without it.
std::string shared(const std::string& name) {
  const char* data = std::getenv("MTSTEREO_TEST_DATA");
  const fs::path folder = fs::path(data != nullptr ? data : "") / name;
  return data != nullptr && fs::exists(folder) ? folder.string() : "";
}

constexpr Nanoseconds kMillisecond = 1'000'000;

TEST_F(DataSets, KittiOdometry) {
  const cv::Size size(1241, 376);
  for (const char* camera : {"00/image_0", "00/image_1", "00/image_2", "00/image_3"}) {
    write_images(camera, {"000000.png", "000001.png", "000003.png"}, size);
  }
  write_text(folder_ / "00/times.txt", "0.000000e+00\n1.037360e-01\n2.073640e-01\n3.110040e-01\n");
  copy_calibration("kitti_calib.txt", "00/calib.txt");
  const Recording recording = recognized("00");
  EXPECT_EQ(recording.kind, "KITTI odometry sequence");
  EXPECT_EQ(recording.name, "00");
  EXPECT_EQ(recording.left.images.front(), path("00/image_2/000000.png"));
  EXPECT_EQ(recording.right.images.back(), path("00/image_3/000003.png"));
  EXPECT_THAT(recording.left.times, ElementsAre(0, 103'736'000, 311'004'000));
  EXPECT_EQ(recording.right.times, recording.left.times);
  EXPECT_EQ(recording.calibration, path("00/calib.txt"));
  EXPECT_TRUE(recording.rectified);
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("calib.txt (KITTI odometry)")));
}

TEST_F(DataSets, KittiOdometryInGray) {
  for (const char* camera : {"00/image_0", "00/image_1"}) {
    write_images(camera, {"000000.png", "000001.png"}, {1241, 376});
  }
  copy_calibration("kitti_calib.txt", "00/calib.txt");
  const Recording recording = recognized("00");
  EXPECT_EQ(recording.calibration, path("00/calib.txt") + "#gray");
  EXPECT_EQ(recording.frame_rate, 10);
  EXPECT_THAT(recording.remarks, ElementsAre(HasSubstr("times.txt is missing or damaged"),
                                             HasSubstr("calib.txt#gray (KITTI odometry)")));
}

TEST_F(DataSets, KittiOdometryWithTooFewTimes) {
  for (const char* camera : {"00/image_0", "00/image_1"}) {
    write_images(camera, {"000000.png", "000001.png", "000002.png"}, {1241, 376});
  }
  write_text(folder_ / "00/times.txt", "0\n0.1\n");
  const Recording recording = recognized("00");
  EXPECT_THAT(recording.left.times, ElementsAre(0, 100 * kMillisecond));
  EXPECT_THAT(recording.remarks, Contains(HasSubstr("000002.png is left out")));
}

TEST_F(DataSets, KittiRaw) {
  for (const bool synchronized : {true, false}) {
    const std::string day = synchronized ? "a" : "b";
    const std::string drive = day + "/drive_0001" + (synchronized ? "_sync" : "_extract");
    for (const char* camera : {"/image_02", "/image_03"}) {
      write_images(drive + camera + "/data", {"0000000000.png", "0000000001.png"},
                   synchronized ? cv::Size(1242, 375) : cv::Size(1392, 512));
    }
    write_text(folder_ / (drive + "/image_02/timestamps.txt"),
               "2011-09-26 13:59:59.950000000\n2011-09-26 14:00:00.053333333\n");
    write_text(folder_ / (drive + "/image_03/timestamps.txt"),
               "2011-09-26 13:59:59.951000000\n2011-09-26 14:00:00.054333333\n");
    copy_calibration("calib_cam_to_cam.txt", day + "/calib_cam_to_cam.txt");
    const Recording recording = recognized(drive);
    EXPECT_EQ(recording.kind, "KITTI raw drive");
    EXPECT_EQ(recording.rectified, synchronized);
    EXPECT_EQ(recording.calibration, path(day + "/calib_cam_to_cam.txt") + "#color");
    const Nanoseconds later = synchronized ? 0 : kMillisecond;
    ASSERT_THAT(recording.left.times, SizeIs(2));
    EXPECT_NEAR(recording.left.times[1], 103'333'333, 10);
    ASSERT_THAT(recording.right.times, SizeIs(2));
    EXPECT_NEAR(recording.right.times[0], later, 10);
    EXPECT_NEAR(recording.right.times[1], later + 103'333'333, 10);
  }
}

// Feature: recognition of videos, images and data sets
TEST_F(DataSets, Euroc) {
  const std::string base = "MH_01/mav0/";
  write_images(base + "cam0/data", {"1403636579763555584.png", "1403636579813555456.png"},
               {752, 480});
  write_images(base + "cam1/data", {"1403636579763555584.png", "1403636579813555456.png"},
               {752, 480});
  write_text(folder_ / (base + "cam0/data.csv"),
             "#timestamp [ns],filename\r\n"
             "1403636579763555584,1403636579763555584.png\r\n"
             "1403636579813555456,1403636579813555456.png\r\n"
             "1403636579863555584,1403636579863555584.png\r\n");
  write_text(folder_ / (base + "cam1/data.csv"),
             "#timestamp [ns],filename\n"
             "1403636579763555584, 1403636579763555584.png\n"
             "1403636579813555456, 1403636579813555456.png\n");
  copy_calibration("euroc_cam0.yaml", base + "cam0/sensor.yaml");
  copy_calibration("euroc_cam1.yaml", base + "cam1/sensor.yaml");
  for (const char* folder : {"MH_01", "MH_01/mav0"}) {
    const Recording recording = recognized(folder);
    EXPECT_EQ(recording.kind, "EuRoC (ASL) sequence");
    EXPECT_EQ(recording.name, "MH_01");
    EXPECT_THAT(recording.left.times, ElementsAre(0, 49'999'872));
    EXPECT_THAT(recording.right.times, ElementsAre(0, 49'999'872));
    EXPECT_THAT(recording.calibration, HasSubstr("cam0/sensor.yaml,"));
    EXPECT_FALSE(recording.rectified);
    EXPECT_THAT(recording.remarks, Contains(HasSubstr("names 1 images that do not exist")));
  }
  write_text(folder_ / (base + "cam1/data.csv"), "nonsense\n");
  EXPECT_THROW(recognized("MH_01"), UserError);
}

TEST_F(DataSets, OlderMiddleburyPairs) {
  write_images("Aloe", {"view0.png", "view1.png", "view5.png", "disp1.png"}, {427, 370});
  write_images("Teddy", {"im2.png", "im6.png", "disp2.png"}, {450, 375});
  fs::create_directory(folder_ / "venus");
  for (const char* name : {"im0.ppm", "im1.ppm", "im2.ppm", "im6.ppm"}) {
    ASSERT_TRUE(cv::imwrite(path("venus/") + name, cv::Mat(383, 434, CV_8UC3, cv::Scalar(80))));
  }
  EXPECT_EQ(recognized("Aloe").left.images.front(), path("Aloe/view1.png"));
  EXPECT_EQ(recognized("Aloe").right.images.front(), path("Aloe/view5.png"));
  EXPECT_EQ(recognized("Teddy").right.images.front(), path("Teddy/im6.png"));
  EXPECT_EQ(recognized("venus").left.images.front(), path("venus/im2.ppm"));
}

TEST_F(DataSets, ImagesOfASequenceAreNoOlderPair) {
  write_images("one", {"im1.png", "im2.png", "im3.png", "im4.png", "im5.png", "im6.png"},
               {450, 375});
  EXPECT_THROW(recognized("one"), UserError);
  write_images("one", {"disp2.png"}, {450, 375});
  EXPECT_EQ(recognized("one").right.images.front(), path("one/im6.png"));
}

TEST_F(DataSets, ImagesOfACameraAreNoPair) {
  for (const char* camera : {"Bathroom/camera_00", "Bathroom/camera_02"}) {
    write_images(camera, {"im0.png", "im1.png"}, {200, 150});
  }
  const Recording recording = recognized("Bathroom");
  EXPECT_THAT(recording.left.images,
              ElementsAre(path("Bathroom/camera_00/im0.png"), path("Bathroom/camera_00/im1.png")));
  EXPECT_EQ(recording.right.images.front(), path("Bathroom/camera_02/im0.png"));
}

TEST_F(DataSets, DepthsBesideViewsAreNoRecording) {
  write_images("kitchen", {"0.left.jpg", "0.right.jpg", "0.left.depth.png", "0.right.depth.png"},
               {200, 150});
  std::vector<Problem> problems;
  const std::vector<Recording> found = find_recordings(path("kitchen"), {}, problems);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().left.images.front(), path("kitchen/0.left.jpg"));
  EXPECT_THAT(found.front().remarks, Contains(HasSubstr("not used: 2")));
  EXPECT_THAT(problems, IsEmpty());
}

TEST_F(DataSets, MiddleburyPair) {
  write_images("Piano", {"im0.png", "im1.png"}, {2964, 1988});
  copy_calibration("middlebury_calib.txt", "Piano/calib.txt");
  const Recording recording = recognized("Piano");
  EXPECT_EQ(recording.kind, "Middlebury pair");
  EXPECT_EQ(recording.calibration, path("Piano/calib.txt"));
  EXPECT_EQ(recording.max_disparity, 280);
  EXPECT_TRUE(recording.rectified);
  fs::remove(path("Piano/im1.png"));
  EXPECT_THROW(recognized("Piano"), UserError);
}

TEST_F(DataSets, CalibrationBesideTheInput) {
  write_images("left", {"0.png"}, {848, 480});
  write_images("right", {"0.png"}, {848, 480});
  copy_calibration("camchain.yaml", "camchain.yaml");
  const Recording recording = recognized("");
  EXPECT_EQ(recording.calibration, path("camchain.yaml"));
  EXPECT_FALSE(recording.rectified);
  EXPECT_THAT(recording.remarks, Contains(HasSubstr("The views are not rectified")));
  InputOptions options;
  options.rectified = true;
  EXPECT_TRUE(recognize({path("")}, options).rectified);
}

TEST_F(DataSets, TwoCalibrationsBesideTheInputAreRefused) {
  write_images("left", {"0.png"}, {848, 480});
  write_images("right", {"0.png"}, {848, 480});
  copy_calibration("camchain.yaml", "camchain.yaml");
  copy_calibration("kitti_calib.txt", "left/calibration.txt");
  EXPECT_THAT(
      [&] {
        recognize({path("left"), path("right")}, {});
      },
      ThrowsMessage<UserError>(AllOf(HasSubstr("camchain.yaml"), HasSubstr("left/calibration.txt"),
                                     HasSubstr("--calibration"))));
  InputOptions options;
  options.calibration = path("camchain.yaml");
  EXPECT_EQ(recognize({path("left"), path("right")}, options).calibration, path("camchain.yaml"));
  // One that cannot be read, or is of another size, is none.
  write_text(folder_ / "left/calibration.txt", "nonsense");
  EXPECT_EQ(recognize({path("left"), path("right")}, {}).calibration, path("camchain.yaml"));
  fs::remove(path("left/calibration.txt"));
  copy_calibration("middlebury_calib.txt", "calib.txt");
  EXPECT_EQ(recognize({path("left"), path("right")}, {}).calibration, path("camchain.yaml"));
}

// As Kalibr writes them without and with the inertial sensor.
TEST_F(DataSets, TwoCalibrationsThatAreEqualAreOne) {
  write_images("left", {"0.png"}, {848, 480});
  write_images("right", {"0.png"}, {848, 480});
  copy_calibration("camchain.yaml", "camchain.yaml");
  copy_calibration("camchain.yaml", "rig-camchain.yaml");
  EXPECT_EQ(recognized("").calibration, path("camchain.yaml"));
}

TEST_F(DataSets, CalibrationOutsideOfTheInputIsNotUsed) {
  write_images("rig/left", {"0.png"}, {848, 480});
  write_images("rig/right", {"0.png"}, {848, 480});
  write_images("other/right", {"0.png"}, {848, 480});
  copy_calibration("camchain.yaml", "camchain.yaml");
  EXPECT_THAT(recognize({path("rig/left"), path("rig/right")}, {}).calibration, IsEmpty());
  // Not that of one view only, if the folders of the views do not lie side by side.
  fs::rename(path("camchain.yaml"), path("rig/camchain.yaml"));
  EXPECT_THAT(recognize({path("rig/left"), path("other/right")}, {}).calibration, IsEmpty());
  EXPECT_THAT(recognize({path("rig/left"), path("rig/right")}, {}).calibration,
              HasSubstr("camchain.yaml"));
}

TEST_F(DataSets, CalibrationWithAnotherNameIsNotUsed) {
  write_images("left", {"0.png"}, {848, 480});
  write_images("right", {"0.png"}, {848, 480});
  copy_calibration("camchain.yaml", "rig.yaml");
  copy_calibration("camchain.yaml", "camchain.bak");
  EXPECT_THAT(recognized("").calibration, IsEmpty());
}

TEST_F(DataSets, BrokenCalibrationIsNamed) {
  write_images("left", {"0.png"}, {752, 480});
  write_images("right", {"0.png"}, {752, 480});
  write_text(folder_ / "calibration.yml", "nonsense");
  const Recording recording = recognized("");
  EXPECT_THAT(recording.calibration, IsEmpty());
  EXPECT_THAT(recording.remarks, Contains(HasSubstr(path("calibration.yml"))));
  InputOptions options;
  options.calibration = path("calibration.yml");
  EXPECT_THROW(recognize({path("")}, options), UserError);
  options.calibration.clear();
  options.rectified = false;
  EXPECT_THROW(recognize({path("")}, options), UserError);
}

TEST_F(DataSets, CamerasCalibratedAloneLieBesideTheirExtrinsics) {
  write_images("views/left", {"0.png"}, {752, 480});
  write_images("views/right", {"0.png"}, {752, 480});
  for (const char* name : {"views/left.yml", "views/right.yml"}) {
    write_text(folder_ / name,
               "K: [ 460, 0, 370, 0, 460, 240, 0, 0, 1 ]\nD: [ -0.25, 0.1, 0, 0 ]\n");
  }
  EXPECT_THAT(recognized("views").remarks, Contains(HasSubstr("have one camera each")));
  write_text(folder_ / "views/extrinsics.yml",
             "R: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ]\nT: [ -0.1, 0, 0 ]\n");
  const Recording recording = recognized("views");
  EXPECT_EQ(recording.calibration, path("views/left.yml") + "," + path("views/right.yml") + "," +
                                       path("views/extrinsics.yml"));
  EXPECT_FALSE(recording.rectified);
  EXPECT_THAT(recording_files(recording), Contains(path("views/extrinsics.yml")));
}

TEST_F(DataSets, RealFolders) {
  const std::string raw = shared("more/kitti_raw"), sequence = shared("kitti_sequence");
  const std::string eth3d = shared("eth3d/playground_1l"), teddy = shared("middlebury/Teddy");
  if (raw.empty() || sequence.empty() || eth3d.empty() || teddy.empty()) {
    GTEST_SKIP() << "no data in MTSTEREO_TEST_DATA";
  }
  const Recording drive = recognize({raw}, {});
  EXPECT_EQ(drive.kind, "KITTI raw drive");
  EXPECT_FALSE(drive.rectified);
  EXPECT_THAT(drive.calibration, HasSubstr("#gray"));
  EXPECT_THAT(drive.left.images, SizeIs(8));
  EXPECT_EQ(drive.left.times, drive.right.times);

  const Recording street = recognize({sequence}, {});
  EXPECT_EQ(street.name, "kitti_sequence");
  EXPECT_GT(street.left.images.size(), 10U);
  EXPECT_EQ(street.left.images.size(), street.right.images.size());
  EXPECT_TRUE(street.rectified);
  EXPECT_THAT(street.calibration, HasSubstr("calib.txt"));

  const Recording pair = recognize({eth3d}, {});
  EXPECT_EQ(pair.kind, "ETH3D pair");
  EXPECT_EQ(pair.max_disparity, 64);
  EXPECT_EQ(pair.calibration, eth3d + "/calib.txt");
  const Recording old = recognize({teddy}, {});
  EXPECT_EQ(old.max_disparity, 64);
  EXPECT_THAT(old.remarks, IsEmpty());
}

// One view of a street is as wide as two views of other cameras: its halves do not match.
TEST_F(DataSets, RealViewsAreNotTakenForTwo) {
  const std::string sequence = shared("kitti_sequence");
  if (sequence.empty()) GTEST_SKIP() << "no data in MTSTEREO_TEST_DATA";
  EXPECT_THAT([&] { recognize({sequence + "/image_l/%06d.png"}, {}); },
              ThrowsMessage<UserError>(HasSubstr("its halves do not match")));
}

// Real pairs side by side and one above the other.
TEST_F(DataSets, RealPairsInOneFrameAreRecognized) {
  for (const char* name : {"middlebury/Teddy", "middlebury/Motorcycle", "eth3d/playground_1l"}) {
    const std::string pair = shared(name);
    if (pair.empty()) GTEST_SKIP() << "no data in MTSTEREO_TEST_DATA";
    const cv::Mat left = cv::imread(pair + "/im0.png"), right = cv::imread(pair + "/im1.png");
    cv::Mat frame;
    cv::hconcat(left, right, frame);
    cv::imwrite(path("beside.png"), frame);
    const Recording beside = recognized("beside.png");
    EXPECT_EQ(beside.arrangement, Arrangement::kSideBySide) << name;
    EXPECT_FALSE(beside.swapped) << name;
    cv::vconcat(right, left, frame);
    cv::imwrite(path("below.png"), frame);
    const Recording below = recognized("below.png");
    EXPECT_EQ(below.arrangement, Arrangement::kTopBottom) << name;
    EXPECT_TRUE(below.swapped) << name;
  }
}

}  // namespace
}  // namespace mtstereo::run::data_sets_test

// SPDX-License-Identifier: LGPL-2.1-or-later
// Every kind of input, from its recognition to its maps: they are what the elements give for the
// same frames in a usual pipeline.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "lib/outputs/user_error.hpp"
#include "recordings/inputs/recognition.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::inputs_test {
namespace {

using testing::frames_of;
using ::testing::HasSubstr;
using testing::have_ffmpeg;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::run_command;
using ::testing::ThrowsMessage;
using testing::View;
using testing::write_text;

constexpr int kFrames = 3;
const Progress kNoProgress;

std::string joined(const std::vector<std::string>& frames) {
  std::string all;
  for (const std::string& frame : frames) all += frame;
  return all;
}

// A frame with both views, one above the other.
std::vector<std::uint8_t> stacked(int number, View above, View below) {
  std::vector<std::uint8_t> frame = testing::stereo_frame(number, above);
  const std::vector<std::uint8_t> second = testing::stereo_frame(number, below);
  frame.insert(frame.end(), second.begin(), second.end());
  return frame;
}

class Inputs : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void write_image(const std::string& name, View view, int number) const {
    std::vector<std::uint8_t> pixels = testing::stereo_frame(number, view);
    const cv::Mat image(kStereoHeight, kStereoWidth, CV_8UC1, pixels.data());
    ASSERT_TRUE(cv::imwrite(path(name), image)) << name;
  }
  // The images of a view; `names`: printf pattern.
  void write_images(const std::string& names, View view) const {
    for (int i = 0; i < kFrames; ++i) {
      char name[200];
      std::snprintf(name, sizeof name, names.c_str(), i);
      write_image(name, view, i);
    }
  }
  // A video by ffmpeg, without loss.
  void write_video(const std::string& name, int width, int height,
                   const std::vector<std::vector<std::uint8_t>>& frames) const {
    std::string bytes;
    for (const auto& frame : frames) bytes.append(frame.begin(), frame.end());
    write_text(path("raw"), bytes);
    run_command("ffmpeg -v error -y -f rawvideo -pix_fmt gray -r 30 -s " + std::to_string(width) +
                "x" + std::to_string(height) + " -i '" + path("raw") +
                "' -pix_fmt yuv420p -c:v libx264 -qp 0 '" + path(name) + "'");
  }

  // The maps of a recording, by the whole way from its recognition.
  Recording process_input(const std::vector<std::string>& inputs, bool with_depth,
                          const InputOptions& input_options = {}) {
    Recording recording = recognize(inputs, input_options);
    WorkOptions options;
    options.parameters = {{"max-disparity", "24"}, {"alignment", "off"}};
    if (with_depth) options.products.push_back(Product::kDepth);
    const Work work = prepare(recording, options, std::nullopt, false);
    const PieceReport report =
        process(work, testing::whole(work), path("out"), kNoProgress, Existing::kReplace);
    EXPECT_EQ(report.frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(report.damage, "");
    return recording;
  }
  std::string maps(const std::string& product) const {
    return joined(frames_of("filesrc location=" + path("out/" + product + ".mkv") +
                            " ! matroskademux ! avdec_ffv1 ! appsink name=out sync=false"));
  }
  static std::string maps_of(const std::string& sources, const std::string& downstream = "") {
    return joined(frames_of(sources + " mtstereo name=m max-disparity=24 alignment=off ! " +
                            downstream + "appsink name=out sync=false"));
  }
  // The sources of a usual pipeline for images, with an element after each.
  std::string images(const std::string& left, const std::string& right,
                     const std::string& left_element = "",
                     const std::string& right_element = "") const {
    const auto source = [this](const std::string& names, const std::string& element) {
      return " multifilesrc location=" + path(names) +
             " caps=image/png,framerate=30/1 ! pngdec ! queue ! " + element;
    };
    return source(left, left_element) + "m.sink_left" + source(right, right_element) +
           "m.sink_right";
  }
  std::string both(const std::string& file, const std::string& layout, bool swapped) const {
    return " filesrc location=" + path(file) + " ! decodebin ! mtsplit name=b layout=" + layout +
           (swapped ? " swap=true" : "") +
           "  b.left ! queue ! m.sink_left  b.right ! queue ! m.sink_right";
  }
  void expect_maps(const std::string& sources) const {
    const std::string expected = maps_of(sources);
    ASSERT_EQ(expected.size(), std::size_t{2} * kFrames * kStereoWidth * kStereoHeight);
    EXPECT_EQ(maps("disparity"), expected);
  }
  void expect_depths(const std::string& sources, const std::string& depth) const {
    EXPECT_EQ(maps("depth"), maps_of(sources, depth + " ! "));
  }

  testing::TemporaryFolder folder_;
};

TEST_F(Inputs, NamesImagesOfAnotherSize) {
  write_images("left/%d.png", View::kLeft);
  write_images("right/%d.png", View::kRight);
  ASSERT_TRUE(cv::imwrite(path("left/1.png"), cv::Mat(40, 60, CV_8UC1, cv::Scalar(9))));
  EXPECT_THAT(
      [&] {
        process_input({path("left"), path("right")}, false);
      },
      ThrowsMessage<UserError>(
          HasSubstr("(" + path("left/0.png") + ") to 60x40 px (" + path("left/1.png") + ")")));
}

TEST_F(Inputs, VideosWithBothViews) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  std::vector<std::vector<std::uint8_t>> beside, below, swapped;
  for (int i = 0; i < kFrames; ++i) {
    beside.push_back(testing::stereo_frame(i, View::kBoth));
    below.push_back(stacked(i, View::kLeft, View::kRight));
    swapped.push_back(stacked(i, View::kRight, View::kLeft));
  }
  write_video("beside.mp4", 2 * kStereoWidth, kStereoHeight, beside);
  EXPECT_EQ(process_input({path("beside.mp4")}, false).arrangement, Arrangement::kSideBySide);
  expect_maps(both("beside.mp4", "side-by-side", false));
  write_video("below.mkv", kStereoWidth, 2 * kStereoHeight, below);
  EXPECT_EQ(process_input({path("below.mkv")}, false).arrangement, Arrangement::kTopBottom);
  expect_maps(both("below.mkv", "top-bottom", false));
  write_video("swapped.mkv", kStereoWidth, 2 * kStereoHeight, swapped);
  EXPECT_TRUE(process_input({path("swapped.mkv")}, false).swapped);
  expect_maps(both("swapped.mkv", "top-bottom", true));
}

TEST_F(Inputs, NumberedImages) {
  write_images("left/%d.png", View::kLeft);
  write_images("right/%d.png", View::kRight);
  EXPECT_EQ(process_input({path("left"), path("right")}, false).left.images.size(),
            static_cast<std::size_t>(kFrames));
  expect_maps(images("left/%d.png", "right/%d.png"));
}

TEST_F(Inputs, KittiOdometry) {
  write_images("00/image_0/%06d.png", View::kLeft);
  write_images("00/image_1/%06d.png", View::kRight);
  write_text(path("00/times.txt"), "0.000000e+00\n1.037360e-01\n2.073640e-01\n");
  write_text(path("00/calib.txt"),
             "P0: 150 0 80 0 0 150 48 0 0 0 1 0\nP1: 150 0 80 -15 0 150 48 0 0 0 1 0\n");
  const Recording recording = process_input({path("00")}, true);
  EXPECT_EQ(recording.kind, "KITTI odometry sequence");
  const std::string sources = images("00/image_0/%06d.png", "00/image_1/%06d.png");
  expect_maps(sources);
  expect_depths(sources, "mtdepth calibration=" + path("00/calib.txt") + "#gray");
}

TEST_F(Inputs, KittiRaw) {
  const std::string drive = "day/drive_0001_sync";
  write_images(drive + "/image_02/data/%010d.png", View::kLeft);
  write_images(drive + "/image_03/data/%010d.png", View::kRight);
  write_text(path(drive + "/image_02/timestamps.txt"),
             "2011-09-26 13:59:59.950000000\n2011-09-26 14:00:00.053333333\n"
             "2011-09-26 14:00:00.156666666\n");
  std::string calibration;
  for (const char* camera : {"00", "01", "02", "03"}) {
    const bool left = camera[1] == '0' || camera[1] == '2';
    const std::string name = std::string("_") + camera + ": ", rect = "_rect" + name;
    calibration += "S" + name + "160 96\nK" + name + "150 0 80 0 150 48 0 0 1\nD" + name +
                   "0 0 0 0 0\nR" + name + "1 0 0 0 1 0 0 0 1\nT" + name + (left ? "0" : "-0.1") +
                   " 0 0\nS" + rect + "160 96\nR" + rect + "1 0 0 0 1 0 0 0 1\nP" + rect +
                   "150 0 80 " + (left ? "0" : "-15") + " 0 150 48 0 0 0 1 0\n";
  }
  write_text(path("day/calib_cam_to_cam.txt"), calibration);
  EXPECT_EQ(process_input({path(drive)}, true).kind, "KITTI raw drive");
  const std::string sources =
      images(drive + "/image_02/data/%010d.png", drive + "/image_03/data/%010d.png");
  expect_maps(sources);
  expect_depths(sources, "mtdepth calibration=" + path("day/calib_cam_to_cam.txt") + "#color");
}

TEST_F(Inputs, Euroc) {
  const std::string base = "MH_01/mav0/";
  write_images("left/%d.png", View::kLeft);
  write_images("right/%d.png", View::kRight);
  for (const char* camera : {"0", "1"}) {
    const bool left = camera[0] == '0';
    const std::string folder = base + "cam" + camera;
    std::string list = "#timestamp [ns],filename\n";
    for (int i = 0; i < kFrames; ++i) {
      const std::string time = std::to_string(1403636579763555584 + 50'000'000LL * i);
      write_image(folder + "/data/" + time + ".png", left ? View::kLeft : View::kRight, i);
      list += time + "," + time + ".png\n";
    }
    write_text(path(folder + "/data.csv"), list);
    write_text(path(folder + "/sensor.yaml"),
               std::string("sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, ") +
                   (left ? "0" : "0.1") +
                   ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: 20\nresolution: [160, 96]\n"
                   "camera_model: pinhole\nintrinsics: [150, 150, 80, 48]\n"
                   "distortion_model: radial-tangential\n"
                   "distortion_coefficients: [-0.1, 0.01, 0, 0]\n");
  }
  const Recording recording = process_input({path("MH_01")}, true);
  EXPECT_EQ(recording.kind, "EuRoC (ASL) sequence");
  const std::string rectify = "mtrectify calibration=" + recording.calibration + " camera=";
  const std::string sources =
      images("left/%d.png", "right/%d.png", rectify + "left ! ", rectify + "right ! ");
  expect_maps(sources);
  expect_depths(sources, "mtdepth");
}

TEST_F(Inputs, PairFolders) {
  for (const char* name : {"Piano", "playground_1l"}) {
    const std::string folder = name;
    write_image(folder + "/im0.png", View::kLeft, 0);
    write_image(folder + "/im1.png", View::kRight, 0);
    testing::write_stereo_calibration(path(folder));
    const Recording recording = recognize({path(folder)}, {});
    EXPECT_EQ(recording.kind, folder == "Piano" ? "Middlebury pair" : "ETH3D pair");
    WorkOptions options;
    options.products = {Product::kDisparity, Product::kDepth};
    options.parameters = {{"max-disparity", "24"}, {"alignment", "off"}};
    const Work work = prepare(recording, options, std::nullopt, false);
    process(work, testing::whole(work), path("out"), kNoProgress, Existing::kReplace);
    const auto source = [this, &folder](const std::string& file) {
      return " filesrc location=" + path(folder + "/" + file) + " ! pngdec ! queue ! m.sink_";
    };
    const std::string sources = source("im0.png") + "left" + source("im1.png") + "right";
    const std::string expected = maps_of(sources);
    EXPECT_EQ(expected.size(), std::size_t{2} * kStereoWidth * kStereoHeight);
    EXPECT_EQ(maps("disparity"), expected);
    expect_depths(sources, "mtdepth calibration=" + path(folder + "/calib.txt"));
  }
}

TEST_F(Inputs, CalibrationsOfOtherProgramsBesideTheViews) {
  write_image("rig/left/0.png", View::kLeft, 0);
  write_image("rig/right/0.png", View::kRight, 0);
  write_text(path("rig/stereo.npz"), std::string("PK\x03\x04\x14\0\0\0mtx.npy", 15));
  EXPECT_THAT(recognize({path("rig")}, {}).remarks,
              ::testing::Contains(HasSubstr("No calibration is used: ")));
  write_text(path("rig/calibration.toml"),
             "baseline = 0.12\n[intrinsics]\nK = [150, 0, 80, 0, 150, 48, 0, 0, 1]\n");
  EXPECT_EQ(recognize({path("rig")}, {}).calibration, path("rig/calibration.toml"));
}

}  // namespace
}  // namespace mtstereo::run::inputs_test

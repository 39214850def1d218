// SPDX-License-Identifier: LGPL-2.1-or-later
// Every product in every format, read by other programs, is what the elements give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "run/view_geometry.hpp"
#include "stereo_files.hpp"
#include "video_files.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::constant_times;
using testing::frames_of;
using testing::have_ffmpeg;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::matcher_line;
using testing::run_command;
using testing::run_pipeline;
using testing::TemporaryFolder;
using testing::View;
using testing::whole;
using testing::work_of;
using testing::write_view;

constexpr int kFrames = 5;
constexpr std::size_t kPixels = std::size_t{kStereoWidth} * kStereoHeight;
const Progress kNoProgress;

class Products : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::string coding = testing::kBFrames + std::string(" ! matroskamux");
    write_view(*folder_ / "left.mkv", View::kLeft, coding, constant_times(kFrames));
    write_view(*folder_ / "right.mkv", View::kRight, coding, constant_times(kFrames));
    testing::write_stereo_calibration(folder_->path());
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path file(const std::string& name) { return *folder_ / name; }

  // Makes the products of all pairs, and returns their folder.
  static fs::path make(const std::vector<Product>& products, MapFormat format) {
    WorkOptions options;
    options.products = products;
    options.format = format;
    Work work = work_of(file("left.mkv"), file("right.mkv"), options);
    work.recording.calibration = file("calib.txt").string();
    const fs::path results = file("results");
    process(work, whole(work), results, kNoProgress, Existing::kReplace);
    return results;
  }
  // What the elements give: the frames downstream of the matcher.
  static std::vector<std::string> expected(const std::string& downstream) {
    return frames_of(matcher_line(file("left.mkv"), file("right.mkv"), "") + " ! " + downstream +
                     " ! appsink name=out sync=false");
  }
  static std::string depth() { return "mtdepth calibration=" + file("calib.txt").string(); }

  static TemporaryFolder* folder_;
};

TemporaryFolder* Products::folder_ = nullptr;

std::string joined(const std::vector<std::string>& frames) {
  std::string all;
  for (const std::string& frame : frames) all += frame;
  return all;
}

// The frames of a video by ffmpeg.
std::string by_ffmpeg(const fs::path& video, const std::string& format) {
  const fs::path raw = video.string() + ".raw";
  run_command("ffmpeg -v error -y -i " + video.string() + " -f rawvideo -pix_fmt " + format + " " +
              raw.string());
  return bytes_of(raw);
}

std::string by_gstreamer(const fs::path& video, const std::string& format = "") {
  return joined(
      frames_of("filesrc location=\"" + video.string() + "\" ! matroskademux ! avdec_ffv1 ! " +
                (format.empty() ? "" : "videoconvert ! video/x-raw,format=" + format + " ! ") +
                "appsink name=out sync=false"));
}

TEST_F(Products, VideosAreReadByGStreamer) {
  const fs::path results =
      make({Product::kDisparity, Product::kDepth, Product::kColor, Product::kConfidence},
           MapFormat::kMatroska);
  const std::vector<std::string> maps = expected("identity");
  ASSERT_EQ(maps.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(by_gstreamer(results / "disparity.mkv"), joined(maps));
  EXPECT_EQ(by_gstreamer(results / "depth.mkv"), joined(expected(depth())));
  EXPECT_EQ(by_gstreamer(results / "confidence.mkv"),
            joined(expected("mtconfidence output=confidence")));
  EXPECT_EQ(by_gstreamer(results / "color.mkv", "BGR"),
            joined(expected("mtcolor ! video/x-raw,format=BGR")));
}

TEST_F(Products, VideosAreReadByFfmpeg) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const fs::path results =
      make({Product::kDisparity, Product::kDepth, Product::kColor, Product::kConfidence},
           MapFormat::kMatroska);
  EXPECT_EQ(by_ffmpeg(results / "disparity.mkv", "gray16le"), joined(expected("identity")));
  EXPECT_EQ(by_ffmpeg(results / "depth.mkv", "gray16le"), joined(expected(depth())));
  EXPECT_EQ(by_ffmpeg(results / "confidence.mkv", "gray"),
            joined(expected("mtconfidence output=confidence")));
  EXPECT_EQ(by_ffmpeg(results / "color.mkv", "bgr24"),
            joined(expected("mtcolor ! video/x-raw,format=BGR")));
  const std::vector<double> times = testing::ffprobe_times(results / "disparity.mkv");
  ASSERT_EQ(times.size(), static_cast<std::size_t>(kFrames));
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], static_cast<double>(i) / 30, 1e-5);
  }
}

TEST_F(Products, VideosStateWhatWasUsed) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  WorkOptions options;
  options.products = {Product::kDepth};
  Work work = work_of(file("left.mkv"), file("right.mkv"), options);
  work.recording.calibration = file("calib.txt").string();
  find_geometry(work);
  process(work, whole(work), file("tags"), kNoProgress);
  const fs::path text = file("tags.txt");
  run_command("ffprobe -v error -show_entries format_tags " +
              (file("tags") / "depth.mkv").string() + " > " + text.string());
  const std::string tags = bytes_of(text);
  for (const char* const tag :
       {"MTSTEREO_PRODUCT=depth\n", "MTSTEREO_INPUT_KIND=two video files\n",
        "MTSTEREO_INPUT_RECTIFIED=yes\n", "MTSTEREO_DISPARITY_SCALE=256\n",
        "MTSTEREO_DEPTH_UNIT_M=0.001\n", "MTSTEREO_FOCAL_LENGTH_PX=100\n",
        "MTSTEREO_BASELINE_M=0.1\n", "MTSTEREO_PRINCIPAL_X_PX=79.5\n",
        "MTSTEREO_PRINCIPAL_Y_PX=47.5\n", "MTSTEREO_PRINCIPAL_OFFSET_PX=0\n",
        "MTSTEREO_CALIBRATION=calib.txt\n", "MTSTEREO_CALIBRATION_FORMAT=Middlebury",
        "mode=semi-dense max-disparity=24 ", " alignment=hold\n"}) {
    EXPECT_NE(tags.find(tag), std::string::npos) << tag << "in\n" << tags;
  }
}

TEST_F(Products, PicturesAreReadByOpenCv) {
  const fs::path results =
      make({Product::kDisparity, Product::kDepth, Product::kColor, Product::kConfidence},
           MapFormat::kPng);
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"disparity", "identity"},
      {"depth", depth()},
      {"color", "mtcolor ! video/x-raw,format=BGR"},
      {"confidence", "mtconfidence output=confidence"}};
  for (const auto& [name, downstream] : kinds) {
    const std::vector<std::string> frames = expected(downstream);
    for (int i = 0; i < kFrames; ++i) {
      const fs::path picture = results / name / ("00000" + std::to_string(i) + ".png");
      const cv::Mat image = cv::imread(picture.string(), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(image.size(), cv::Size(kStereoWidth, kStereoHeight)) << picture;
      const std::string& frame = frames[static_cast<std::size_t>(i)];
      ASSERT_EQ(image.total() * image.elemSize(), frame.size()) << picture;
      EXPECT_EQ(std::memcmp(image.data, frame.data(), frame.size()), 0) << picture;
    }
  }
}

// The values of a little-endian file, the first row on top.
std::vector<float> read_pfm(const fs::path& file) {
  const std::string bytes = bytes_of(file), head = "Pf\n160 96\n-1.0\n";
  EXPECT_EQ(bytes.substr(0, head.size()), head);
  EXPECT_EQ(bytes.size(), head.size() + 4 * kPixels);
  std::vector<float> values(kPixels);
  for (std::size_t y = 0; y < kStereoHeight; ++y) {
    const std::size_t from = head.size() + 4 * kStereoWidth * (kStereoHeight - 1 - y);
    std::memcpy(values.data() + y * kStereoWidth, bytes.data() + from, 4 * kStereoWidth);
  }
  return values;
}

TEST_F(Products, FloatingPointMapsAreInPixelsAndMeters) {
  const fs::path results = make({Product::kDisparity, Product::kDepth}, MapFormat::kPfm);
  const std::vector<std::string> maps = expected("identity");
  int known = 0;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const std::string name = "00000" + std::to_string(i) + ".pfm";
    const std::vector<float> disparity = read_pfm(results / "disparity" / name);
    const std::vector<float> depth = read_pfm(results / "depth" / name);
    for (std::size_t p = 0; p < kPixels; ++p) {
      std::uint16_t value = 0;
      std::memcpy(&value, maps[i].data() + 2 * p, 2);
      if (value == 0) {
        ASSERT_TRUE(std::isinf(disparity[p]) && std::isinf(depth[p])) << p;
        continue;
      }
      ++known;
      ASSERT_EQ(disparity[p], static_cast<float>(value) / 256) << p;
      ASSERT_NEAR(depth[p], 100 * 0.1 / (value / 256.0), 1e-5) << p;
    }
  }
  EXPECT_GT(known, kFrames * static_cast<int>(kPixels) / 2);
}

TEST_F(Products, CloudsAreThoseOfTheElement) {
  const fs::path results = make({Product::kCloud}, MapFormat::kMatroska);
  const fs::path clouds = file("clouds");
  fs::create_directories(clouds);
  const std::string line =
      "filesrc location=" + file("left.mkv").string() +
      " ! decodebin ! tee name=l  l. ! queue ! m.sink_left  l. ! queue ! videoconvert ! "
      "video/x-raw,format=RGB ! c.sink_left  filesrc location=" +
      file("right.mkv").string() +
      " ! decodebin ! queue ! m.sink_right  mtstereo name=m max-disparity=24 alignment=off ! queue "
      "! mtcloud name=c calibration=" +
      file("calib.txt").string() + " location=" + clouds.string() + "/%06d.ply";
  run_pipeline(line);
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = "00000" + std::to_string(i) + ".ply";
    EXPECT_EQ(bytes_of(results / "clouds" / name), bytes_of(clouds / name)) << name;
    EXPECT_GT(fs::file_size(clouds / name), kPixels) << name;
  }
}

// A lens with distortion; the right camera is turned.
void write_raw_calibration(const fs::path& calibration) {
  const std::string camera =
      "!!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n  data: "
      "[150, 0, 80, 0, 150, 48, 0, 0, 1]\n";
  const std::string lens =
      "!!opencv-matrix\n  rows: 1\n  cols: 5\n  dt: d\n  data: "
      "[-0.1, 0.01, 0, 0, 0]\n";
  testing::write_text(
      calibration,
      "%YAML:1.0\n---\nimage_width: 160\nimage_height: 96\nM1: " + camera + "D1: " + lens +
          "M2: " + camera + "D2: " + lens +
          "R: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n  data: [1, 0, 0, 0, 0.999998, "
          "0.002, 0, -0.002, 0.999998]\nT: !!opencv-matrix\n  rows: 3\n  cols: 1\n  dt: "
          "d\n  data: [-0.1, 0, 0]\n");
}

// The coordinates z of the points of a file.
std::vector<float> depths_of(const fs::path& cloud) {
  const std::string bytes = bytes_of(cloud), end = "end_header\n";
  constexpr std::size_t kPoint = 16;  // three numbers, three colors, the confidence
  std::vector<float> depths;
  for (std::size_t at = bytes.find(end) + end.size(); at < bytes.size(); at += kPoint) {
    depths.emplace_back();
    std::memcpy(&depths.back(), bytes.data() + at + 8, 4);
  }
  return depths;
}

TEST_F(Products, DepthsOutsideOfTheLimitsAreLeftOut) {
  // The disparities are 6 and 11 px: 1.67 and 0.91 m.
  WorkOptions options;
  options.products = {Product::kCloud, Product::kDepth};
  Work work = work_of(file("left.mkv"), file("right.mkv"), options);
  work.recording.calibration = file("calib.txt").string();
  process(work, whole(work), file("all"), kNoProgress);
  work.options.near = 1.2;
  process(work, whole(work), file("far part"), kNoProgress);
  work.options.near = 0;
  work.options.far = 1.2;
  process(work, whole(work), file("near part"), kNoProgress);
  const auto depths = [&](const char* part) {
    return depths_of(file(part) / "clouds" / "000000.ply");
  };
  const std::vector<float> all = depths("all"), far = depths("far part"),
                           near = depths("near part");
  EXPECT_EQ(all.size(), far.size() + near.size());
  EXPECT_GT(*std::min_element(far.begin(), far.end()), 1.2);
  EXPECT_LT(*std::max_element(near.begin(), near.end()), 1.2);
  // Without a limit the default of clouds applies: 100 px * 0.1 m / 4 px.
  EXPECT_LE(*std::max_element(all.begin(), all.end()), 2.5);
  work.options.products = {Product::kDepth};
  work.options.format = MapFormat::kPfm;
  process(work, whole(work), file("near maps"), kNoProgress);
  int known = 0;
  for (const float depth : read_pfm(file("near maps") / "depth" / "000000.pfm")) {
    if (std::isinf(depth)) continue;
    ++known;
    ASSERT_LE(depth, 1.2);
  }
  EXPECT_EQ(known, static_cast<int>(near.size()));
  const std::string video = by_gstreamer(file("near part") / "depth.mkv");
  for (std::size_t at = 0; at < video.size(); at += 2) {
    std::uint16_t value = 0;
    std::memcpy(&value, video.data() + at, 2);
    ASSERT_LE(value, 1200);
  }
}

TEST_F(Products, EveryPointIsKeptWithoutALimit) {
  WorkOptions options;
  options.products = {Product::kCloud};
  options.parameters = {{"min-disparity", "-2"}};
  Work work = work_of(file("left.mkv"), file("left.mkv"), options);
  work.recording.calibration = file("calib.txt").string();
  process(work, whole(work), file("limited"), kNoProgress);
  work.options.far = 0;
  process(work, whole(work), file("unlimited"), kNoProgress);
  // Equal views: everything is at a disparity of 0, or of some hundredths of a px.
  EXPECT_TRUE(depths_of(file("limited") / "clouds" / "000000.ply").empty());
  EXPECT_FALSE(depths_of(file("unlimited") / "clouds" / "000000.ply").empty());
}

TEST_F(Products, OfRawViewsAreThoseOfRectifiedOnes) {
  const fs::path calibration = file("raw.yml");
  write_raw_calibration(calibration);
  WorkOptions options;
  options.products = {Product::kDisparity, Product::kDepth, Product::kCloud};
  Work work = work_of(file("left.mkv"), file("right.mkv"), options);
  work.recording.rectified = false;
  work.recording.calibration = calibration.string();
  const fs::path results = file("raw");
  process(work, whole(work), results, kNoProgress, Existing::kReplace);
  const auto source = [&](const char* side) {
    return " filesrc location=" + file(std::string(side) + ".mkv").string() +
           " ! decodebin ! queue ! mtrectify calibration=" + calibration.string() +
           " camera=" + side + " ! m.sink_" + side;
  };
  const std::string maps =
      source("left") + source("right") + " mtstereo name=m max-disparity=24 alignment=off ! ";
  const std::string sink = "appsink name=out sync=false";
  EXPECT_EQ(by_gstreamer(results / "disparity.mkv"), joined(frames_of(maps + sink)));
  EXPECT_EQ(by_gstreamer(results / "depth.mkv"), joined(frames_of(maps + "mtdepth ! " + sink)));
  EXPECT_GT(fs::file_size(results / "clouds" / "000004.ply"), kPixels);
}

TEST_F(Products, RectifiedViewsAreThoseOfTheElement) {
  const fs::path calibration = file("raw.yml");
  write_raw_calibration(calibration);
  WorkOptions options;
  options.products = {Product::kRectifiedLeft, Product::kRectifiedRight, Product::kCloud};
  Work work = work_of(file("left.mkv"), file("right.mkv"), options);
  work.recording.rectified = false;
  work.recording.calibration = calibration.string();
  const fs::path results = file("rectified");
  process(work, whole(work), results, kNoProgress, Existing::kReplace);
  work.options.products = {Product::kRectifiedLeft, Product::kRectifiedRight};
  work.options.format = MapFormat::kPng;
  process(work, whole(work), file("pictures"), kNoProgress);
  for (const std::string side : {"left", "right"}) {
    const std::vector<std::string> frames = frames_of(
        "filesrc location=" + file(side + ".mkv").string() +
        " ! decodebin ! videoconvert ! video/x-raw,format=BGR ! mtrectify color=true calibration=" +
        calibration.string() + " camera=" + side + " ! appsink name=out sync=false");
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
    const fs::path video = results / ("rectified-" + side + ".mkv");
    EXPECT_EQ(by_gstreamer(video, "BGR"), joined(frames)) << side;
    const fs::path picture = file("pictures") / ("rectified-" + side) / "000004.png";
    const cv::Mat image = cv::imread(picture.string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(image.total() * image.elemSize(), frames[4].size()) << picture;
    EXPECT_EQ(std::memcmp(image.data, frames[4].data(), frames[4].size()), 0) << picture;
  }
}

TEST_F(Products, RectifiedViewsOfGrayRectifiedInputAreTheInput) {
  const std::string coding = "video/x-raw,format=GRAY8 ! avenc_ffv1 ! matroskamux";
  write_view(file("gray-l.mkv"), View::kLeft, coding, constant_times(kFrames));
  write_view(file("gray-r.mkv"), View::kRight, coding, constant_times(kFrames));
  WorkOptions options;
  options.products = {Product::kRectifiedLeft, Product::kRectifiedRight};
  const Work work = work_of(file("gray-l.mkv"), file("gray-r.mkv"), options);
  const fs::path results = file("as matched");
  process(work, whole(work), results, kNoProgress, Existing::kReplace);
  EXPECT_EQ(by_gstreamer(results / "rectified-left.mkv"), by_gstreamer(file("gray-l.mkv")));
  EXPECT_EQ(by_gstreamer(results / "rectified-right.mkv"), by_gstreamer(file("gray-r.mkv")));
}

TEST_F(Products, OfAPairDoNotDependOnTheOthers) {
  const fs::path together =
      make({Product::kDisparity, Product::kConfidence, Product::kCloud}, MapFormat::kMatroska);
  const std::string disparity = bytes_of(together / "disparity.mkv");
  EXPECT_EQ(bytes_of(make({Product::kDisparity}, MapFormat::kMatroska) / "disparity.mkv"),
            disparity);
}

TEST_F(Products, OfAnotherRunAreReplaced) {
  make({Product::kDisparity, Product::kConfidence, Product::kRectifiedLeft}, MapFormat::kMatroska);
  const fs::path results = make({Product::kDisparity}, MapFormat::kPng);
  EXPECT_FALSE(fs::exists(results / "disparity.mkv"));
  EXPECT_FALSE(fs::exists(results / "confidence.mkv"));
  EXPECT_FALSE(fs::exists(results / "rectified-left.mkv"));
  EXPECT_FALSE(fs::exists(results / "unfinished"));
  EXPECT_TRUE(fs::exists(results / "disparity" / "000000.png"));
}

TEST_F(Products, SideBySideIsAsTwoVideos) {
  const std::string coding = "avenc_ffv1 ! matroskamux";
  write_view(file("l.mkv"), View::kLeft, coding, constant_times(kFrames));
  write_view(file("r.mkv"), View::kRight, coding, constant_times(kFrames));
  write_view(file("both.mkv"), View::kBoth, coding, constant_times(kFrames));
  const Work two = work_of(file("l.mkv"), file("r.mkv"), {});
  process(two, whole(two), file("two"), kNoProgress);
  Work one = work_of(file("both.mkv"), file("both.mkv"), {});
  one.recording.arrangement = Arrangement::kSideBySide;
  one.recording.right = {};
  process(one, whole(one), file("one"), kNoProgress);
  EXPECT_EQ(bytes_of(file("one") / "disparity.mkv"), bytes_of(file("two") / "disparity.mkv"));
}

}  // namespace
}  // namespace mtstereo::run

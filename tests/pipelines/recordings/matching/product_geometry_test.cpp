// SPDX-License-Identifier: LGPL-2.1-or-later
// Clouds, the limits of depth, and rectified views.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "products.hpp"

namespace mtstereo::run::product_geometry_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::constant_times;
using testing::frames_of;
using testing::run_pipeline;
using testing::View;
using testing::whole;
using testing::work_of;
using testing::write_view;

// Feature: results that other programs read
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

// Work on views that are to be rectified by a calibration.
Work of_raw_views(Work work, const fs::path& calibration,
                  const decltype(WorkOptions::products)& products) {
  work.options.products = products;
  work.recording.rectified = false;
  work.recording.calibration = calibration.string();
  return work;
}

TEST_F(Products, OfRawViewsAreThoseOfRectifiedOnes) {
  const fs::path calibration = file("raw.yml");
  write_raw_calibration(calibration);
  const Work work = of_raw_views(work_of(file("left.mkv"), file("right.mkv"), {}), calibration,
                                 {Product::kDisparity, Product::kDepth, Product::kCloud});
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
  Work work = of_raw_views(work_of(file("left.mkv"), file("right.mkv"), {}), calibration,
                           {Product::kRectifiedLeft, Product::kRectifiedRight, Product::kCloud});
  const fs::path results = file("rectified");
  process(work, whole(work), results, kNoProgress, Existing::kReplace);
  work.options.products = {Product::kRectifiedLeft, Product::kRectifiedRight};
  work.options.format = MapFormat::kPng;
  process(work, whole(work), file("images"), kNoProgress);
  for (const std::string side : {"left", "right"}) {
    const std::vector<std::string> frames = frames_of(
        "filesrc location=" + file(side + ".mkv").string() +
        " ! decodebin ! videoconvert ! video/x-raw,format=BGR ! mtrectify color=true calibration=" +
        calibration.string() + " camera=" + side + " ! appsink name=out sync=false");
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
    const fs::path video = results / ("rectified-" + side + ".mkv");
    EXPECT_EQ(by_gstreamer(video, "BGR"), joined(frames)) << side;
    const fs::path path = file("images") / ("rectified-" + side) / "000004.png";
    const cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(image.total() * image.elemSize(), frames[4].size()) << path;
    EXPECT_EQ(std::memcmp(image.data, frames[4].data(), frames[4].size()), 0) << path;
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

}  // namespace
}  // namespace mtstereo::run::product_geometry_test

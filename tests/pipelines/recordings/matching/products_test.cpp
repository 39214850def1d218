// SPDX-License-Identifier: LGPL-2.1-or-later
// Every product in every format, read by other programs, is what the elements give.
#include "products.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "recordings/matching/view_geometry.hpp"

namespace mtstereo::run::products_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using testing::constant_times;
using testing::have_ffmpeg;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::run_command;
using testing::View;
using testing::whole;
using testing::work_of;
using testing::write_view;

const std::vector<Product> kMaps{Product::kDisparity, Product::kDepth, Product::kColor,
                                 Product::kConfidence};
constexpr const char* kConfidence = "mtconfidence output=confidence";
constexpr const char* kColor = "mtcolor ! video/x-raw,format=BGR";

TEST_F(Products, VideosAreReadByGStreamer) {
  const fs::path results = make(kMaps, MapFormat::kMatroska);
  const std::vector<std::string>& maps = expected("identity");
  ASSERT_EQ(maps.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(by_gstreamer(results / "disparity.mkv"), joined(maps));
  EXPECT_EQ(by_gstreamer(results / "depth.mkv"), joined(expected(depth())));
  EXPECT_EQ(by_gstreamer(results / "confidence.mkv"), joined(expected(kConfidence)));
  EXPECT_EQ(by_gstreamer(results / "color.mkv", "BGR"), joined(expected(kColor)));
}

// Feature: results that other programs read
TEST_F(Products, VideosAreReadByFfmpeg) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const fs::path results = make(kMaps, MapFormat::kMatroska);
  const std::string in = results.string() + "/", out = " -f rawvideo -pix_fmt ";
  run_command("ffmpeg -v error -i " + in + "disparity.mkv -i " + in + "depth.mkv -i " + in +
              "confidence.mkv -i " + in + "color.mkv -map 0" + out + "gray16le " + in +
              "disparity.raw -map 1" + out + "gray16le " + in + "depth.raw -map 2" + out + "gray " +
              in + "confidence.raw -map 3" + out + "bgr24 " + in + "color.raw");
  EXPECT_EQ(bytes_of(results / "disparity.raw"), joined(expected("identity")));
  EXPECT_EQ(bytes_of(results / "depth.raw"), joined(expected(depth())));
  EXPECT_EQ(bytes_of(results / "confidence.raw"), joined(expected(kConfidence)));
  EXPECT_EQ(bytes_of(results / "color.raw"), joined(expected(kColor)));
  const std::vector<double> times = testing::ffprobe_times(results / "disparity.mkv");
  ASSERT_EQ(times.size(), static_cast<std::size_t>(kFrames));
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], static_cast<double>(i) / 30, 1e-5);
  }
}

// Feature: results that other programs read
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

// Feature: results that other programs read
TEST_F(Products, ImagesAreReadByOpenCv) {
  const fs::path results = make(kMaps, MapFormat::kPng);
  const std::vector<std::pair<std::string, std::string>> kinds{{"disparity", "identity"},
                                                               {"depth", depth()},
                                                               {"color", kColor},
                                                               {"confidence", kConfidence}};
  for (const auto& [name, downstream] : kinds) {
    const std::vector<std::string>& frames = expected(downstream);
    for (int i = 0; i < kFrames; ++i) {
      const fs::path path = results / name / ("00000" + std::to_string(i) + ".png");
      const cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
      ASSERT_EQ(image.size(), cv::Size(kStereoWidth, kStereoHeight)) << path;
      const std::string& frame = frames[static_cast<std::size_t>(i)];
      ASSERT_EQ(image.total() * image.elemSize(), frame.size()) << path;
      EXPECT_EQ(std::memcmp(image.data, frame.data(), frame.size()), 0) << path;
    }
  }
}

// Feature: results that other programs read
TEST_F(Products, FloatingPointMapsAreInPixelsAndMeters) {
  const fs::path results = make({Product::kDisparity, Product::kDepth}, MapFormat::kPfm);
  const std::vector<std::string>& maps = expected("identity");
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
}  // namespace mtstereo::run::products_test

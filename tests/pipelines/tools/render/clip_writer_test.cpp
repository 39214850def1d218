// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/clip_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"
#include "tools/render/render.hpp"

namespace mtstereo::render::clip_writer_test {
namespace {

using test::error_of;
using test::read_text;
using test::TemporaryFolder;
using test::write_text;

namespace fs = std::filesystem;

struct Rendered {
  Scene scene = make_scene("street", 1);
  Settings settings;
  StereoFrame frame;

  Rendered() {
    settings.width = 64, settings.height = 36;
    settings = complete(scene, settings);
    frame = render(scene, 0, settings);
  }
};

float pfm_value(const std::string& bytes, int width, int height, int x, int y) {
  const std::size_t header = bytes.size() - static_cast<std::size_t>(width * height) * 4;
  float value = 0;
  const auto at = header + static_cast<std::size_t>((height - 1 - y) * width + x) * 4;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

TEST(ClipWriter, WritesTheRenderedFrames) {
  TemporaryFolder folder;
  const Rendered r;
  ClipWriter writer(folder / "clip", Layout::kClip, false);
  writer.write(7, r.frame, rectification_of(r.settings));
  writer.finish(rectification_of(r.settings));

  const cv::Mat left = cv::imread((folder / "clip/left/000007.png").string(), cv::IMREAD_UNCHANGED);
  const cv::Mat right =
      cv::imread((folder / "clip/right/000007.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(left.size(), r.frame.left.size());
  EXPECT_EQ(cv::norm(left, r.frame.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(right, r.frame.right, cv::NORM_INF), 0);

  const std::string pfm = read_text(folder / "clip/truth/000007.pfm");
  ASSERT_EQ(pfm.substr(0, 14), "Pf\n64 36\n-1.0\n");
  ASSERT_EQ(pfm.size(), 14u + 64 * 36 * 4);
  const cv::Mat mask = cv::imread((folder / "clip/mask/000007.png").string(), cv::IMREAD_UNCHANGED);
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float d = r.frame.truth.at<float>(y, x);
      ASSERT_EQ(pfm_value(pfm, 64, 36, x, y), d) << x << ", " << y;
      const int expected = std::isinf(d)                                  ? 0
                           : r.frame.occluded.at<std::uint8_t>(y, x) != 0 ? 128
                                                                          : 255;
      ASSERT_EQ(mask.at<std::uint8_t>(y, x), expected) << x << ", " << y;
    }
  }
}

TEST(ClipWriter, CalibrationCoversEveryDisparity) {
  TemporaryFolder folder;
  const Rendered r;
  ClipWriter writer(folder / "clip", Layout::kClip, false);
  writer.write(0, r.frame, rectification_of(r.settings));
  writer.finish(rectification_of(r.settings));
  const std::string text = read_text(folder / "clip/calib.txt");
  EXPECT_NE(text.find("cam0=[54.4 0 31.5; 0 54.4 17.5; 0 0 1]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("cam1=[54.4 0 31.5; 0 54.4 17.5; 0 0 1]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nbaseline=300\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nwidth=64\nheight=36\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nndisp=" + std::to_string(writer.disparities()) + "\n"), std::string::npos);
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float d = r.frame.truth.at<float>(y, x);
      if (std::isinf(d)) continue;
      ASSERT_LT(d, static_cast<float>(writer.disparities() - 1));
    }
  }
}

TEST(ClipWriter, MiddleburyLayoutHasOneFolderPerFrame) {
  TemporaryFolder folder;
  const Rendered r;
  ClipWriter writer(folder / "set", Layout::kMiddlebury, false);
  writer.write(0, r.frame, rectification_of(r.settings));
  writer.write(1, r.frame, rectification_of(r.settings));
  writer.finish(rectification_of(r.settings));
  for (const char* frame : {"set/000000", "set/000001"}) {
    for (const char* name : {"im0.png", "im1.png", "disp0GT.pfm", "mask0nocc.png", "calib.txt"}) {
      EXPECT_TRUE(fs::is_regular_file(folder / frame / name)) << frame << "/" << name;
    }
  }
  EXPECT_FALSE(fs::exists(folder / "set/left"));
  EXPECT_FALSE(fs::exists(folder / "set/calib.txt"));
}

TEST(ClipWriter, RejectsAFolderThatIsNotEmpty) {
  TemporaryFolder folder;
  write_text(folder / "diary.txt", "dear diary");
  const std::string error = error_of([&] { ClipWriter(folder.path(), Layout::kClip, false); });
  EXPECT_NE(error.find(folder.path().string()), std::string::npos) << error;
  EXPECT_NE(error.find("not empty"), std::string::npos) << error;
}

TEST(ClipWriter, OverwriteRemovesOnlyTheClip) {
  TemporaryFolder folder;
  const Rendered r;
  ClipWriter(folder.path(), Layout::kClip, false).write(5, r.frame, rectification_of(r.settings));
  ClipWriter(folder.path(), Layout::kMiddlebury, true)
      .write(3, r.frame, rectification_of(r.settings));
  EXPECT_FALSE(fs::exists(folder / "left"));
  write_text(folder / "diary.txt", "dear diary");
  fs::create_directory(folder / "000009");  // a number, but not a frame of a clip
  ClipWriter(folder.path(), Layout::kClip, true).write(0, r.frame, rectification_of(r.settings));
  EXPECT_FALSE(fs::exists(folder / "000003"));
  EXPECT_TRUE(fs::exists(folder / "000009"));
  EXPECT_EQ(read_text(folder / "diary.txt"), "dear diary");
}

TEST(ClipWriter, NamesAFolderThatCannotBeCreated) {
  const std::string error = error_of([] { ClipWriter("/dev/null/clip", Layout::kClip, false); });
  EXPECT_NE(error.find("/dev/null/clip"), std::string::npos) << error;
}

TEST(ClipWriter, RejectsAFileAsFolder) {
  TemporaryFolder folder;
  write_text(folder / "file", "");
  const std::string error = error_of([&] { ClipWriter(folder / "file", Layout::kClip, true); });
  EXPECT_NE(error.find("not a folder"), std::string::npos) << error;
}

TEST(ClipWriter, NamesTheFileThatCannotBeWritten) {
  TemporaryFolder folder;
  const Rendered r;
  ClipWriter writer(folder / "clip", Layout::kClip, false);
  fs::create_directory(folder / "clip/truth/000000.pfm");  // blocks the file
  const std::string error =
      error_of([&] { writer.write(0, r.frame, rectification_of(r.settings)); });
  EXPECT_NE(error.find("truth/000000.pfm"), std::string::npos) << error;
}

TEST(ClipWriter, DetectsAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const Rendered r;
  const std::string error = error_of([&] { write_pfm("/dev/full", r.frame.truth); });
  EXPECT_NE(error.find("/dev/full"), std::string::npos) << error;
}

}  // namespace
}  // namespace mtstereo::render::clip_writer_test

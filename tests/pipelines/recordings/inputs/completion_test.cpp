// SPDX-License-Identifier: LGPL-2.1-or-later
// What the frames of a recording show about it.
#include "recordings/inputs/completion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "recordings/support/recordings_folder.hpp"
#include "support/exif.hpp"

namespace mtstereo::run::completion_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::constant_times;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::have_ffmpeg;
using ::testing::IsEmpty;
using testing::kBFrames;
using testing::kHeight;
using testing::kWidth;
using testing::Recordings;
using testing::run_command;
using testing::view;
using testing::write_text;
using testing::write_video;

TEST_F(Recordings, NamesTheRemedyForAFileWithSoundOnly) {
  testing::run_pipeline("audiotestsrc num-buffers=5 ! wavenc ! filesink location=" +
                        path("left.wav"));
  fs::copy(path("left.wav"), path("right.wav"));
  EXPECT_THAT(error_of({"left.wav", "right.wav"}),
              AllOf(HasSubstr(path("left.wav")), HasSubstr("give a video, an image")));
}

// The decoder of GStreamer crashes with its usual properties.
TEST_F(Recordings, NamesTheRemedyForPixelsThatAreNotDecoded) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* format : {"gray10le", "gray12le"}) {
    run_command(
        "ffmpeg -v error -y -f lavfi -i testsrc=size=64x48:duration=0.2 -c:v ffv1 -pix_fmt " +
        std::string(format) + " '" + path("left.mkv") + "'");
    fs::copy(path("left.mkv"), path("right.mkv"), fs::copy_options::overwrite_existing);
    EXPECT_THAT(error_of({"left.mkv", "right.mkv"}),
                AllOf(HasSubstr(path("left.mkv")), HasSubstr("-pix_fmt gray16le")));
  }
}

// Phones store how they were held.
TEST_F(Recordings, RefusesVideoThatPlayersTurn) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  write_video(folder_ / "plain.mp4", std::string(kBFrames) + " ! mp4mux", constant_times(5));
  for (const char* angle : {"90", "180"}) {
    run_command("ffmpeg -v error -y -i '" + path("plain.mp4") +
                "' -c copy -metadata:s:v rotate=" + angle + " '" + path("turned.mp4") + "'");
    EXPECT_THAT(error_of({"plain.mp4", "turned.mp4"}),
                AllOf(HasSubstr(path("turned.mp4") + ": players turn its frames (rotate-"),
                      HasSubstr("ffmpeg -i FILE")));
  }
}

// A JPEG image with an EXIF orientation.
void write_turned(const fs::path& file, const cv::Mat& image, char orientation) {
  std::vector<unsigned char> coded;
  cv::imencode(".jpg", image, coded);
  write_text(file, test::with_orientation({coded.begin(), coded.end()}, orientation));
}

TEST_F(Recordings, RefusesImagesThatProgramsTurn) {
  for (const char orientation : {'\1', '\3', '\6'}) {
    write_turned(folder_ / "left.jpg", view(false), orientation);
    write_turned(folder_ / "right.jpg", view(true), orientation);
    const std::string error = error_of({"left.jpg", "right.jpg"});
    if (orientation == '\1') {
      EXPECT_THAT(error, IsEmpty());
    } else {
      EXPECT_THAT(error, AllOf(HasSubstr(path("left.jpg")), HasSubstr("mogrify -auto-orient")));
    }
  }
}

// Thermal cameras use a small part of the values.
TEST_F(Recordings, NotesVideoThatUsesFewOf16Bits) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* side : {"left", "right"}) {
    cv::Mat few;
    view(side[0] == 'r').convertTo(few, CV_16U, 1, 7500);
    cv::imwrite(path("few.png"), few);
    run_command("ffmpeg -v error -i '" + path("few.png") + "' -c:v ffv1 '" +
                path(std::string(side) + ".mkv") + "'");
    run_command("ffmpeg -v error -i '" + path("few.png") +
                "' -vf 'lut=(val-7500)*250' -c:v ffv1 '" + path(std::string(side) + "-wide.mkv") +
                "'");
  }
  EXPECT_THAT(recognized({"left.mkv", "right.mkv"}).remarks,
              ElementsAre(AllOf(HasSubstr("few of the values of 16 bits: matching sees about "),
                                HasSubstr("-vf 'lut=(val-7"))));
  EXPECT_THAT(recognized({"left-wide.mkv", "right-wide.mkv"}).remarks, IsEmpty());
}

TEST_F(Recordings, RefusesViewsOfASingleRowOrColumn) {
  const auto write = [this](int rows, int cols) {
    for (const bool right : {false, true}) {
      cv::imwrite(path(right ? "right.png" : "left.png"), view(right)(cv::Rect(0, 0, cols, rows)));
    }
  };
  write(1, kWidth);
  EXPECT_THAT(error_of({"left.png", "right.png"}),
              HasSubstr("left.png: 200x1 px is a single row or column, and no view"));
  write(kHeight, 1);
  EXPECT_THAT(error_of({"left.png", "right.png"}), HasSubstr("left.png: 1x120 px is a single row"));
  write(2, kWidth);
  InputOptions halves;
  halves.arrangement = Arrangement::kTopBottom;
  EXPECT_THAT(error_of({"left.png"}, halves), HasSubstr("left.png: 200x1 px is a single row"));
  EXPECT_EQ(recognized({"left.png", "right.png"}).left.images.size(), 1U);
}

TEST_F(Recordings, NotesTheMosaicOfAColorCamera) {
  const auto remarks_with = [this](double blue) {
    for (const bool right : {false, true}) {
      cv::Mat mosaic = view(right);
      for (int y = 1; y < mosaic.rows; y += 2) {
        for (int x = 1; x < mosaic.cols; x += 2) {
          mosaic.at<unsigned char>(y, x) =
              static_cast<unsigned char>(blue * mosaic.at<unsigned char>(y, x));
        }
      }
      cv::imwrite(path(right ? "right.png" : "left.png"), mosaic);
    }
    return recognized({"left.png", "right.png"}).remarks;
  };
  EXPECT_THAT(remarks_with(0.95), ElementsAre(HasSubstr("COLOR_BayerBG2GRAY")));
  EXPECT_THAT(remarks_with(1), IsEmpty());
}

}  // namespace
}  // namespace mtstereo::run::completion_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "recordings/media/frame_reader.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::image_reader_test {
namespace {

namespace fs = std::filesystem;
using testing::frames_of;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::rows_of;
using testing::TemporaryFolder;

cv::Mat gray() {
  std::vector<std::uint8_t> pixels = testing::stereo_frame(3, testing::View::kLeft);
  return cv::Mat(kStereoHeight, kStereoWidth, CV_8UC1, pixels.data()).clone();
}

cv::Mat color() {
  cv::Mat image;
  cv::applyColorMap(gray(), image, cv::COLORMAP_JET);
  return image;
}

struct Kind {
  const char* file;
  int type;
  const char* decoder;  // of GStreamer, to its own format
  const char* format;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.file << ' ' << kind.format; }

class Images : public ::testing::TestWithParam<Kind> {};

cv::Mat image_of(int type) {
  cv::Mat image = CV_MAT_CN(type) == 1 ? gray() : color();
  if (CV_MAT_CN(type) == 4) cv::cvtColor(image, image, cv::COLOR_BGR2BGRA);
  if (CV_MAT_DEPTH(type) == CV_16U) image.convertTo(image, CV_16U, 257);
  return image;
}

TEST_P(Images, AreDecodedAsByPipelines) {
  const Kind& kind = GetParam();
  const TemporaryFolder folder;
  const fs::path file = folder / kind.file;
  ASSERT_TRUE(cv::imwrite(file.string(), image_of(kind.type)));
  const auto reader = open_images({file, file});
  DecodedFrame frame = reader->read(1);
  ASSERT_EQ(frame.state, FrameState::kDecoded) << reader->problem();
  const std::vector<std::string> expected = frames_of(
      "filesrc location=" + file.string() + " ! " + kind.decoder +
      " ! videoconvert ! video/x-raw,format=" + kind.format + " ! appsink name=out sync=false");
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_EQ(rows_of(frame.buffer.get(), frame.caps.get()), expected[0]);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Images,
                         ::testing::Values(Kind{"a.png", CV_8UC1, "pngdec", "GRAY8"},
                                           Kind{"a.png", CV_8UC3, "pngdec", "BGR"},
                                           Kind{"a.png", CV_8UC4, "pngdec", "BGRA"},
                                           Kind{"a.png", CV_16UC1, "pngdec", "GRAY16_LE"},
                                           Kind{"a.jpg", CV_8UC1, "jpegdec", "GRAY8"},
                                           Kind{"a.JPEG", CV_8UC3, "jpegdec", "I420"},
                                           Kind{"a.pgm", CV_8UC1, "pnmdec", "GRAY8"},
                                           Kind{"a.ppm", CV_8UC3, "pnmdec", "BGR"}));

TEST(Images16Bit, KeepTheirColors) {
  const TemporaryFolder folder;
  const cv::Mat image = image_of(CV_16UC3);
  ASSERT_TRUE(cv::imwrite((folder / "a.png").string(), image));
  const DecodedFrame frame = open_images({folder / "a.png"})->read(0);
  ASSERT_EQ(frame.state, FrameState::kDecoded);
  const std::string rows = rows_of(frame.buffer.get(), frame.caps.get());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      std::array<std::uint16_t, 4> pixel{};
      std::memcpy(pixel.data(), rows.data() + 8 * (y * image.cols + x), 8);
      const auto& expected = image.at<cv::Vec3w>(y, x);
      ASSERT_EQ(pixel,
                (std::array<std::uint16_t, 4>{expected[0], expected[1], expected[2], 0xffff}));
    }
  }
}

// Its encoder loses a little of 16 bits.
TEST(Images16Bit, OfJpeg2000KeepTheirColors) {
  const TemporaryFolder folder;
  const cv::Mat image = image_of(CV_16UC3);
  ASSERT_TRUE(cv::imwrite((folder / "a.jp2").string(), image));
  const DecodedFrame frame = open_images({folder / "a.jp2"})->read(0);
  ASSERT_EQ(frame.state, FrameState::kDecoded);
  std::string rows = rows_of(frame.buffer.get(), frame.caps.get());
  const cv::Mat decoded(image.rows, image.cols, CV_16UC4, rows.data());
  cv::Mat colors;
  cv::cvtColor(decoded, colors, cv::COLOR_BGRA2BGR);
  const double mean_difference = cv::norm(colors, image, cv::NORM_L1) / 3 / image.total();
  EXPECT_LT(mean_difference, 0.01 * 65535);
}

TEST(Images16Bit, WithUnusedBitsUseAllOfThem) {
  const TemporaryFolder folder;
  const cv::Mat image = (cv::Mat_<std::uint16_t>(1, 4) << 0, 1, 4095, 5000);
  ASSERT_TRUE(cv::imwrite((folder / "a.png").string(), image));
  const DecodedFrame frame = open_images({folder / "a.png"}, 4)->read(0);
  ASSERT_EQ(frame.state, FrameState::kDecoded);
  std::array<std::uint16_t, 4> pixels{};
  std::memcpy(pixels.data(), rows_of(frame.buffer.get(), frame.caps.get()).data(), 8);
  EXPECT_EQ(pixels, (std::array<std::uint16_t, 4>{0, 16, 65520, 65535}));
  // Those of 8 bits have none.
  ASSERT_TRUE(cv::imwrite((folder / "b.png").string(), gray()));
  const auto rows = [&](int unused) {
    const DecodedFrame read = open_images({folder / "b.png"}, unused)->read(0);
    return rows_of(read.buffer.get(), read.caps.get());
  };
  EXPECT_EQ(rows(4), rows(0));
}

TEST(BrokenImage, IsNamedAndTheNextOneIsRead) {
  const TemporaryFolder folder;
  const fs::path good = folder / "good.jpg", good_png = folder / "good.png";
  ASSERT_TRUE(cv::imwrite(good.string(), color()));
  ASSERT_TRUE(cv::imwrite(good_png.string(), color()));
  testing::write_text(folder / "text.jpg", "no image");
  testing::write_text(folder / "text.png", "no image");
  testing::write_text(folder / "empty.jpg", "");
  const auto reader = open_images({folder / "text.jpg", good, folder / "text.png", good_png,
                                   folder / "empty.jpg", good, folder / "missing.png"});
  for (const std::int64_t number : {0, 2, 4, 6}) {
    EXPECT_EQ(reader->read(number).state, FrameState::kMissing) << number;
    EXPECT_NE(reader->problem().find(number == 6   ? "missing.png"
                                     : number == 4 ? "empty"
                                                   : "text"),
              std::string::npos)
        << reader->problem();
    if (number < 6) {
      EXPECT_EQ(reader->read(number + 1).state, FrameState::kDecoded);
    }
  }
}

}  // namespace
}  // namespace mtstereo::run::image_reader_test

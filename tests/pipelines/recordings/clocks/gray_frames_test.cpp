// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/gray_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "recordings/support/video_files.hpp"

namespace mtstereo::run::gray_frames_test {
namespace {

using testing::have_ffmpeg;
using testing::run_command;
using testing::TemporaryFolder;

// Decoders of FFV1 state no matrix of colors.
TEST(GrayFrames, HaveTheContrastOfTheirVideo) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  constexpr int kDark = 40, kBright = 200;
  for (const char* format : {"gray", "gray16le", "yuv420p", "yuvj420p", "yuv444p", "bgr0"}) {
    const std::string file = (folder / (std::string(format) + ".mkv")).string();
    run_command(
        "ffmpeg -v error -f lavfi -i \"color=0x282828:size=64x48:rate=10:duration=0.2,"
        "drawbox=x=32:y=0:w=32:h=48:color=0xc8c8c8:t=fill\" -pix_fmt " +
        std::string(format) + " -c:v ffv1 '" + file + "'");
    Source source;
    source.video = file;
    const FrameIndex index = index_frames(source, 0);
    const cv::Mat frame = GrayFrames(source, index, 64).at(0);
    constexpr double kNear = 18;  // the range may be limited
    EXPECT_NEAR(cv::mean(frame.colRange(0, 24))[0], kDark, kNear) << format;
    EXPECT_NEAR(cv::mean(frame.colRange(40, 64))[0], kBright, kNear) << format;
  }
}

}  // namespace
}  // namespace mtstereo::run::gray_frames_test

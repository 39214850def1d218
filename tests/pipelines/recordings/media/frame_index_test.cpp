// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/frame_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "lib/outputs/user_error.hpp"
#include "recordings/media/container.hpp"
#include "recordings/media/video_times.hpp"
#include "recordings/support/video_files.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::frame_index_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::constant_times;
using testing::decoded_times;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using testing::ffprobe_times;
using ::testing::HasSubstr;
using testing::have_ffmpeg;
using ::testing::IsEmpty;
using testing::kBFrames;
using ::testing::Not;
using testing::run_command;
using testing::TemporaryFolder;
using testing::variable_times;
using testing::write_beginning;
using testing::write_text;
using testing::write_video;

constexpr int kLong = 330;  // frames; so many are not decoded as a whole

FrameIndex index_of(const fs::path& video) { return index_frames({video, {}, {}}, 0); }

std::string error_of(const fs::path& video) {
  return test::error_of<UserError>([&] { index_of(video); });
}

// Each listed time is one of a frame that was encoded; `unit`: that of the time stamps of the
// container, 0 if they are not those of the frames. Few frames are missing: GStreamer's muxer for
// MP4 writes an edit list without the last frames of a variable rate, and its demultiplexer does
// not show the first ones of fragments.
void expect_encoded(const std::vector<Nanoseconds>& times, const std::vector<Nanoseconds>& encoded,
                    const std::string& container, Nanoseconds unit) {
  const bool is_mp4 = container.find("Mp4") != std::string::npos;
  ASSERT_LE(times.size(), encoded.size());
  ASSERT_GE(times.size() + (is_mp4 ? 3 : 0), encoded.size());
  if (unit == 0) return;
  const Nanoseconds start = is_mp4 ? 0 : times.front() - encoded.front();
  for (std::size_t i = is_mp4 ? 1 : 0; i < times.size(); ++i) {  // the first one may be clipped
    const Nanoseconds time = times[i];
    const auto next = std::lower_bound(encoded.begin(), encoded.end(), time - start - unit);
    ASSERT_NE(next, encoded.end());
    ASSERT_NEAR(*next, time - start, static_cast<double>(unit));
  }
}

void expect_as_ffprobe(const FrameIndex& index, const fs::path& file) {
  const std::vector<double> expected = ffprobe_times(file);
  ASSERT_EQ(index.times.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double time = 1e-9 * static_cast<double>(index.times[i] - index.times.front());
    ASSERT_NEAR(time, expected[i] - expected.front(), 2e-6) << "frame " << i;
  }
}

struct Container {
  const char* name;   // of the case
  const char* muxer;  // of GStreamer
  const char* extension;
  Nanoseconds unit;            // of the time stamps
  const char* of_ffmpeg = "";  // its options for the same
};

constexpr Nanoseconds kMillisecond = 1'000'000;

class Containers : public ::testing::TestWithParam<Container> {
 protected:
  fs::path video(const std::string& name) const { return folder_ / (name + GetParam().extension); }
  fs::path written(const std::vector<Nanoseconds>& times) const {
    const fs::path file = video("gst");
    write_video(file, std::string(kBFrames) + " ! " + GetParam().muxer, times);
    return file;
  }

  TemporaryFolder folder_;
};

TEST_P(Containers, ListsWhatIsDecoded) {
  for (const auto& times : {constant_times(kLong), variable_times(kLong)}) {
    const fs::path file = written(times);
    const FrameIndex index = index_of(file);
    EXPECT_EQ(index.times, decoded_times(file));
    expect_encoded(index.times, times, GetParam().name, GetParam().unit);
    EXPECT_THAT(index.damage, IsEmpty());
    EXPECT_EQ(index.width, 64);
    EXPECT_EQ(index.height, 48);
    EXPECT_THAT(index.codec, HasSubstr("H.264"));
    EXPECT_TRUE(parser_suffices(file, read_times(file, Reading::kCoded)));
  }
}

TEST_P(Containers, ListsShortVideos) {
  for (const int count : {1, 2, 40}) {
    const fs::path file = written(variable_times(count));
    const FrameIndex index = index_of(file);
    EXPECT_EQ(index.times, decoded_times(file));
    expect_encoded(index.times, variable_times(count), GetParam().name, GetParam().unit);
    EXPECT_THAT(index.damage, IsEmpty());
  }
}

TEST_P(Containers, ListsFilesOfFfmpeg) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* rate : {"", "-vf select='mod(n+mod(n\\,4)\\,3)' -vsync vfr"}) {
    const fs::path file = video("ffmpeg");
    run_command(
        "ffmpeg -v error -y -f lavfi -i testsrc=size=96x64:rate=30:duration=16 "
        "-f lavfi -i sine=duration=16 " +
        std::string(rate) + " -c:v libx264 -preset ultrafast -bf 3 -g 40 -c:a aac " +
        GetParam().of_ffmpeg + " '" + file.string() + "'");
    const FrameIndex index = index_of(file);
    EXPECT_GT(index.times.size(), 300U);
    EXPECT_EQ(index.times, decoded_times(file));
    expect_as_ffprobe(index, file);
    EXPECT_THAT(index.damage, IsEmpty());
    EXPECT_TRUE(parser_suffices(file, read_times(file, Reading::kCoded)));
  }
}

TEST_P(Containers, StatesWhereTruncatedFileEnds) {
  const fs::path whole = written(variable_times(kLong));
  const std::vector<Nanoseconds> times = index_of(whole).times;
  for (const double fraction : {0.3, 0.7317}) {
    const fs::path file = video("part");
    write_beginning(whole, file, fraction);
    if (const std::string error = error_of(file); !error.empty()) {
      // Only an MP4 file whose index is at its end cannot be read at all.
      EXPECT_STREQ(GetParam().name, "Mp4");
      EXPECT_THAT(error, HasSubstr(file.string()));
      EXPECT_THAT(error, HasSubstr("bytes of its box 'mdat' are missing"));
      continue;
    }
    const FrameIndex index = index_of(file);
    EXPECT_EQ(index.times, decoded_times(file));
    EXPECT_GT(index.times.size(), 10U);
    EXPECT_LT(index.times.size(), times.size());
    EXPECT_THAT(index.damage, HasSubstr("truncated after "));
    EXPECT_TRUE(std::equal(index.times.begin(), index.times.end() - 4, times.begin()));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Muxers, Containers,
    ::testing::Values(Container{"Mp4", "mp4mux", ".mp4", 100'000},
                      Container{"FastStartMp4", "mp4mux faststart=true", ".mp4", 100'000,
                                "-movflags faststart"},
                      Container{"FragmentedMp4", "mp4mux fragment-duration=1000", ".mp4", 0,
                                "-movflags frag_keyframe+empty_moov"},
                      Container{"Matroska", "matroskamux", ".mkv", kMillisecond},
                      Container{"TransportStream", "mpegtsmux", ".ts", 12'000}),
    [](const auto& info) { return std::string(info.param.name); });

class FrameIndexTest : public ::testing::Test {
 protected:
  fs::path written(const std::string& name, const std::string& coding, int count = kLong) const {
    const fs::path file = folder_ / name;
    write_video(file, coding, constant_times(count));
    return file;
  }

  TemporaryFolder folder_;
};

TEST_F(FrameIndexTest, ListsVideosWithoutBFrames) {
  for (const auto& [name, coding] :
       {std::pair("jpeg.avi", "jpegenc ! avimux"),
        std::pair("ffv1.mkv", "avenc_ffv1 ! matroskamux"),
        std::pair("raw.avi", "video/x-raw,format=I420 ! avimux"),
        std::pair("mpeg4.avi", "avenc_mpeg4 ! avimux"), std::pair("jpeg.mov", "jpegenc ! qtmux")}) {
    const fs::path file = written(name, coding);
    const FrameIndex index = index_of(file);
    EXPECT_EQ(index.times.size(), static_cast<std::size_t>(kLong)) << name;
    EXPECT_EQ(index.times, decoded_times(file)) << name;
    EXPECT_THAT(index.damage, IsEmpty()) << name;
  }
}

// Groups of images that refer to frames of the group before.
TEST_F(FrameIndexTest, ListsOpenGroups) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* coding : {"libx264 -x264-params open_gop=1:keyint=50:bframes=3",
                             "libx265 -x265-params log-level=none:open-gop=1:keyint=50:bframes=3",
                             "mpeg2video -bf 2 -g 15"}) {
    const fs::path coded = folder_ / "coded.mp4";
    run_command(
        "ffmpeg -v error -y -f lavfi -i testsrc=size=96x64:rate=30:duration=11 -preset ultrafast "
        "-c:v " +
        std::string(coding) + " '" + coded.string() + "'");
    for (const char* name : {"coded.mp4", "open.mkv", "open.ts"}) {
      const fs::path file = folder_ / name;
      if (file != coded) {
        run_command("ffmpeg -v error -y -i '" + coded.string() + "' -c copy '" + file.string() +
                    "'");
      }
      const FrameIndex index = index_of(file);
      EXPECT_EQ(index.times.size(), 330U) << coding;
      EXPECT_EQ(index.times, decoded_times(file)) << coding;
      expect_as_ffprobe(index, file);
      EXPECT_THAT(index.damage, IsEmpty()) << coding;
    }
  }
}

// Frames of VP8 and VP9 that are only references are not shown.
TEST_F(FrameIndexTest, DoesNotListHiddenFrames) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* codec : {"libvpx", "libvpx-vp9"}) {
    const fs::path file = folder_ / "hidden.webm";
    run_command(
        "ffmpeg -v error -y -f lavfi -i testsrc=size=96x64:rate=30:duration=4 -c:v " +
        std::string(codec) +
        " -auto-alt-ref 1 -lag-in-frames 16 -deadline realtime -cpu-used 5 -b:v 60k -g 60 '" +
        file.string() + "'");
    const FrameIndex index = index_of(file);
    EXPECT_EQ(index.times.size(), 120U) << codec;
    EXPECT_EQ(index.times, decoded_times(file)) << codec;
    EXPECT_THAT(index.damage, IsEmpty()) << codec;
  }
}

// An edit list that skips the first frames, as a cut without encoding writes it.
TEST_F(FrameIndexTest, HonorsEditLists) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const fs::path whole = written("whole.mp4", std::string(kBFrames) + " ! mp4mux");
  const fs::path file = folder_ / "cut.mp4";
  run_command("ffmpeg -v error -y -ss 0.5 -i '" + whole.string() + "' -c copy '" + file.string() +
              "'");
  const FrameIndex index = index_of(file);
  EXPECT_LT(index.times.size(), static_cast<std::size_t>(kLong));
  EXPECT_EQ(index.times, decoded_times(file));
}

TEST_F(FrameIndexTest, ListsTransportStreamThatStartsBetweenKeyframes) {
  const fs::path whole = written("whole.ts", std::string(kBFrames) + " ! mpegtsmux");
  std::ifstream in(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  // The tables of the stream, then the stream from a packet in the middle on.
  const fs::path file = folder_ / "later.ts";
  write_text(file, bytes.substr(0, 4 * 188) + bytes.substr(bytes.size() / 188 / 5 * 188));
  const FrameIndex index = index_of(file);
  // From the first keyframe on.
  const std::vector<Nanoseconds> decoded = decoded_times(file);
  ASSERT_GT(index.times.size(), 200U);
  ASSERT_LT(index.times.size(), decoded.size());
  EXPECT_TRUE(std::equal(index.times.rbegin(), index.times.rend(), decoded.rbegin()));
  // The counters of the packets show the cut. The frames before the keyframe are not lost by it.
  EXPECT_THAT(index.damage, AllOf(HasSubstr("damaged in 1 place"), Not(HasSubstr("decoded"))));
}

TEST_F(FrameIndexTest, ListsWhatIsDecodedOfTransportStreamWithLoss) {
  const fs::path whole = written("whole.ts", std::string(kBFrames) + " ! mpegtsmux");
  std::ifstream in(whole, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  bytes.erase(bytes.size() / 188 / 2 * 188, 99 * 188);
  const fs::path file = folder_ / "loss.ts";
  write_text(file, bytes);
  const FrameIndex index = index_of(file);
  std::vector<Nanoseconds> decoded = decoded_times(file);
  decoded.erase(std::unique(decoded.begin(), decoded.end()), decoded.end());
  EXPECT_EQ(index.times, decoded);
  EXPECT_LT(index.times.size(), static_cast<std::size_t>(kLong));
  EXPECT_THAT(index.damage, HasSubstr("packets before it are missing"));
}

TEST_F(FrameIndexTest, NamesFilesThatAreNoVideos) {
  write_text(folder_ / "empty.mp4", "");
  write_text(folder_ / "text.mkv", "This is no video.\n");
  write_text(folder_ / "noise.ts", std::string(100'000, 'x'));
  for (const char* name : {"empty.mp4", "text.mkv", "noise.ts"}) {
    const fs::path file = folder_ / name;
    EXPECT_THAT(error_of(file), AllOf(HasSubstr(file.string() + ": "),
                                      HasSubstr("give a video, an image or a folder of images")))
        << name;
  }
}

TEST_F(FrameIndexTest, NamesFileWithoutVideo) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const fs::path file = folder_ / "sound.mkv";
  run_command("ffmpeg -v error -y -f lavfi -i sine=duration=1 '" + file.string() + "'");
  EXPECT_THAT(error_of(file), HasSubstr(file.string() + ": "));
}

TEST_F(FrameIndexTest, ContainersThatAreWholeHaveNoMissingEnd) {
  EXPECT_THAT(missing_end(written("a.avi", "jpegenc ! avimux", 20)), IsEmpty());
  EXPECT_THAT(missing_end(written("a.mov", "jpegenc ! qtmux", 20)), IsEmpty());
  EXPECT_THAT(missing_end(written("a.mkv", "jpegenc ! matroskamux streamable=true", 20)),
              IsEmpty());
  EXPECT_THAT(missing_end(folder_ / "none.mkv"), IsEmpty());
}

TEST_F(FrameIndexTest, ImagesHaveTheirTimes) {
  Source source;
  for (const char* name : {"0.png", "1.png", "2.png"}) {
    source.images.push_back(folder_ / name);
    cv::imwrite(source.images.back().string(), cv::Mat(30, 40, CV_8UC1, cv::Scalar(9)));
  }
  const FrameIndex by_rate = index_frames(source, 25);
  EXPECT_THAT(by_rate.times, ElementsAre(0, 40'000'000, 80'000'000));
  EXPECT_EQ(by_rate.period, 40'000'000);
  EXPECT_EQ(by_rate.codec, "PNG");
  EXPECT_EQ(by_rate.width, 40);
  EXPECT_EQ(by_rate.height, 30);
  EXPECT_EQ(by_rate.bytes, 3 * fs::file_size(source.images[0]));
  source.images.resize(1);
  EXPECT_EQ(index_frames(source, 10).period, 100'000'000) << "the rate of a single image";
  source.times = {7};
  EXPECT_EQ(index_frames(source, 10).period, 0);
  source.times = {0, 5, 11};
  EXPECT_EQ(index_frames(source, 0).times, source.times);
  source.times.clear();
  EXPECT_THROW(index_frames(source, 0), UserError);
  EXPECT_THROW(index_frames({}, 30), UserError);
}

}  // namespace
}  // namespace mtstereo::run::frame_index_test

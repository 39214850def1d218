// SPDX-License-Identifier: LGPL-2.1-or-later
// Videos that ffmpeg and OpenCV have written: the frames of the numbers are those that ffmpeg
// decodes, in order and after jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "recordings/media/frame_reader.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::foreign_files_test {
namespace {

namespace fs = std::filesystem;
using testing::bytes_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::have_ffmpeg;
using ::testing::IsEmpty;
using testing::kStereoHeight;
using testing::kStereoWidth;
using testing::rows_of;
using testing::run_command;
using testing::TemporaryFolder;
using testing::View;
using testing::write_text;

constexpr int kFrames = 100;
constexpr std::size_t kPixels = std::size_t{kStereoWidth} * kStereoHeight;

constexpr const char* kSound = " -f lavfi -i sine=duration=4 ";
const std::string kH264 = "-c:v libx264 -preset veryfast -bf 3 -g 20 -threads 1 ";
const std::string kOpenGroups = kH264 + "-x264-params open_gop=1 ";
constexpr const char* kEarlySound = "-itsoffset -0.5 -f lavfi -i sine=duration=4";

struct File {
  const char* name;       // of the case
  const char* file;       // its extension is that of the container
  std::string inputs;     // of ffmpeg, besides the frames
  std::string options;    // of ffmpeg; or the code of OpenCV
  int count = kFrames;    // frames
  double difference = 0;  // mean, of decoders whose transforms are not those of ffmpeg
};

void PrintTo(const File& file, std::ostream* out) { *out << file.name; }

// Writes the frames of a view by ffmpeg.
fs::path write_by_ffmpeg(const TemporaryFolder& folder, View view, const std::string& file,
                         const File& coding) {
  std::string frames;
  for (int i = 0; i < kFrames; ++i) {
    const std::vector<std::uint8_t> frame = testing::stereo_frame(i, view);
    frames.append(frame.begin(), frame.end());
  }
  const fs::path raw = folder / "frames.gray", result = folder / file;
  write_text(raw, frames);
  const std::string size = std::to_string(view == View::kBoth ? 2 * kStereoWidth : kStereoWidth) +
                           "x" + std::to_string(kStereoHeight);
  run_command("ffmpeg -v error -y -f rawvideo -pix_fmt gray -s " + size + " -r 30 -i '" +
              raw.string() + "' " + coding.inputs + " -pix_fmt yuv420p " + coding.options + " '" +
              result.string() + "'");
  return result;
}

// The luma of all frames as ffmpeg decodes them.
std::vector<std::string> by_ffmpeg(const fs::path& video) {
  const fs::path raw = video.string() + ".raw";
  run_command("ffmpeg -v error -y -i '" + video.string() +
              "' -map 0:v:0 -vsync passthrough -f rawvideo '" + raw.string() + "'");
  const std::string bytes = bytes_of(raw);
  std::vector<std::string> frames;
  for (std::size_t at = 0; at + kPixels * 3 / 2 <= bytes.size(); at += kPixels * 3 / 2) {
    frames.push_back(bytes.substr(at, kPixels));
  }
  return frames;
}

double mean_difference(const std::string& a, const std::string& b) {
  EXPECT_EQ(a.size(), b.size());
  if (a == b) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    sum += std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i]));
  }
  return sum / static_cast<double>(a.size());
}

void expect_frames(const fs::path& file, const File& expected) {
  const std::vector<std::string> frames = by_ffmpeg(file);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(expected.count));
  const FrameIndex index = index_frames({file, {}, {}}, 0);
  EXPECT_EQ(index.damage, "");
  ASSERT_EQ(index.times.size(), frames.size());
  std::vector<std::int64_t> numbers(frames.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int64_t>(i);
  const std::int64_t last = numbers.back();
  const auto reader = open_video(file, index);
  for (const std::int64_t number : {last, std::int64_t{1}, last - 7, std::int64_t{0}, last - 8}) {
    numbers.push_back(number);
  }
  for (const std::int64_t number : numbers) {
    const DecodedFrame frame = reader->read(number);
    ASSERT_EQ(frame.state, FrameState::kDecoded) << number << ' ' << reader->problem();
    ASSERT_LE(mean_difference(rows_of(frame.buffer.get(), frame.caps.get()),
                              frames[static_cast<std::size_t>(number)]),
              expected.difference)
        << number;
  }
}

class OfFfmpeg : public ::testing::TestWithParam<File> {};

TEST_P(OfFfmpeg, FramesAreThoseOfTheirNumbers) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  expect_frames(write_by_ffmpeg(folder, View::kLeft, GetParam().file, GetParam()), GetParam());
}

// The frames that lead the first keyframe refer to others that are not in the file. Matroska does
// not state their times, and MP4 leaves them out by its edit list.
TEST(OfFfmpegCut, StartsAtItsKeyframe) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const std::string h265 =
      "-c:v libx265 -preset ultrafast -x265-params "
      "log-level=none:open-gop=1:keyint=20:bframes=3";
  for (const std::string& coding : {kOpenGroups, h265}) {
    const TemporaryFolder folder;
    const fs::path whole = write_by_ffmpeg(folder, View::kLeft, "whole.mp4", {"", "", "", coding});
    for (const char* name : {"cut.mkv", "cut.mp4"}) {
      const fs::path cut = folder / name;
      run_command("ffmpeg -v error -ss 1.2 -i '" + whole.string() + "' -c copy '" + cut.string() +
                  "'");
      SCOPED_TRACE(coding + name);
      const auto count = static_cast<int>(by_ffmpeg(cut).size());
      ASSERT_GT(count, kFrames / 3);
      expect_frames(cut, {name, "", "", "", count});
    }
  }
}

// Pieces of files in which a seek alone would give other frames.
TEST(OfFfmpegInPieces, JoinedAreEqualToTheWhole) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const File& file :
       {File{"", "a.mkv", kEarlySound, kH264 + "-c:a flac"}, File{"", "a.avi", "", kH264}}) {
    const TemporaryFolder folder;
    const fs::path left =
        write_by_ffmpeg(folder, View::kLeft, std::string("left_") + file.file, file);
    const fs::path right =
        write_by_ffmpeg(folder, View::kRight, std::string("right_") + file.file, file);
    const Work work = testing::work_of(left, right, {});
    process(work, testing::whole(work), folder / "whole", {});
    const std::vector<Range> ranges{{0, 67}, {67, 5}, {72, kFrames - 72}};
    std::vector<fs::path> pieces;
    for (const Range& range : ranges) {
      pieces.push_back(folder / std::to_string(range.first));
      process(work, range, pieces.back(), {});
    }
    join(work, ranges, pieces, folder / "joined");
    EXPECT_EQ(testing::contents_of(folder / "joined"), testing::contents_of(folder / "whole"));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, OfFfmpeg,
    ::testing::Values(
        File{"MatroskaWithSound", "a.mkv", kSound, kH264 + "-c:a aac"},
        File{"Mp4WithSound", "a.mp4", kSound, kH264 + "-c:a aac"},
        File{"FragmentedMp4", "a.mp4", kSound,
             kH264 + "-c:a aac -movflags frag_keyframe+empty_moov"},
        File{"TransportStreamWithSound", "a.ts", kSound, kH264 + "-c:a aac"},
        File{"ProgramStream", "a.mpg", kSound, "-c:v mpeg2video -bf 2 -g 12 -b:v 2M -c:a mp2",
             kFrames, 0.5},
        File{"OpenGroups", "a.mp4", "", kOpenGroups},
        File{"Hevc", "a.mkv", "",
             "-c:v libx265 -preset ultrafast -x265-params "
             "log-level=none:open-gop=1:keyint=20:bframes=3"},
        File{"VariableRateMatroska", "a.mkv", "", kH264 + "-vf select='mod(n\\,5)' -vsync vfr",
             kFrames * 4 / 5},
        File{"VariableRateMp4", "a.mp4", "", kH264 + "-vf select='mod(n\\,5)' -vsync vfr",
             kFrames * 4 / 5},
        File{"Avi", "a.avi", kSound, "-c:v mpeg4 -g 20 -q:v 3 -c:a mp3"},
        File{"AviWithBFrames", "a.avi", "", "-c:v mpeg4 -bf 2 -g 20 -q:v 3"},
        File{"H264InAvi", "a.avi", "", kH264},
        File{"MatroskaThatStartsWithSound", "a.mkv", kEarlySound, kH264 + "-c:a flac"},
        File{"Vp9", "a.webm", "", "-c:v libvpx-vp9 -deadline realtime -cpu-used 8"},
        File{"Ffv1", "a.mkv", kSound, "-c:v ffv1 -c:a flac"},
        File{"MotionJpeg", "a.avi", kSound, "-c:v mjpeg -pix_fmt yuvj420p -q:v 3", kFrames, 0.5}),
    [](const auto& info) { return info.param.name; });

fs::path h264(const TemporaryFolder& folder, const std::string& file, const char* inputs = "") {
  return write_by_ffmpeg(folder, View::kLeft, file, {"", "", inputs, kH264});
}

FrameIndex index_of(const fs::path& video) { return index_frames({video, {}, {}}, 0); }

// Ends a file of MPEG-TS after the first packet of a frame that has more of them.
void truncate_in_frame(const fs::path& file) {
  constexpr std::size_t kPacket = 188;
  const std::string bytes = bytes_of(file);
  const auto starts = [&bytes](std::size_t at) { return (bytes[at + 1] & 0x40) != 0; };
  const auto id = [&bytes](std::size_t at) {
    return std::pair(bytes[at + 1] & 0x1f, bytes[at + 2]);
  };
  std::size_t end = bytes.size() - kPacket;
  while (!starts(end - kPacket) || starts(end) || id(end - kPacket) != id(end)) end -= kPacket;
  fs::resize_file(file, end);
}

TEST(TruncatedTransportStream, IsNoticedAtTheEndOfAPacket) {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.ts";
  testing::write_view(file, View::kLeft, std::string(testing::kBFrames) + " ! mpegtsmux",
                      testing::constant_times(40));
  EXPECT_EQ(index_of(file).damage, "");
  truncate_in_frame(file);
  const FrameIndex index = index_of(file);
  EXPECT_THAT(index.damage, HasSubstr("the file is truncated after 1."));
  EXPECT_THAT(index.damage, HasSubstr("bytes of the stream with PID 65 are missing"));
}

// Where the lengths of frames are not stated, only a frame whose last packet is full raises doubt.
TEST(TruncatedTransportStream, WithoutLengthsIsARemark) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  const fs::path file = h264(folder, "a.ts");
  EXPECT_THAT(index_of(file).remarks, IsEmpty());
  truncate_in_frame(file);
  const FrameIndex index = index_of(file);
  EXPECT_EQ(index.damage, "");
  EXPECT_THAT(index.remarks, ElementsAre(HasSubstr("may be truncated within its last frame")));
}

TEST(TruncatedAvi, WithBFramesGivesWhatCanBeRead) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  const fs::path file = h264(folder, "a.avi"), cut = folder / "cut.avi";
  const std::vector<Nanoseconds> times = index_of(file).times;
  testing::write_beginning(file, cut, 0.6);
  const FrameIndex index = index_of(cut);
  EXPECT_THAT(index.damage, HasSubstr("truncated after"));
  EXPECT_TRUE(index.by_order);
  ASSERT_GT(index.times.size(), times.size() / 3);
  ASSERT_LT(index.times.size(), times.size());
  EXPECT_TRUE(std::equal(index.times.begin(), index.times.end(), times.begin()));
  const auto last = static_cast<std::int64_t>(index.times.size()) - 1;
  EXPECT_EQ(open_video(cut, index)->read(last).state, FrameState::kDecoded);
}

// The index and the reader take the same stream.
TEST(SeveralVideoStreams, TheFirstOneIsUsedAndNamed) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* name : {"a.mkv", "a.mp4", "a.ts"}) {
    const TemporaryFolder folder;
    const fs::path file = h264(folder, name,
                               "-f lavfi -i testsrc=size=96x64:rate=25:duration=2 "
                               "-map 0:v -map 1:v");
    EXPECT_THAT(index_of(file).remarks,
                ElementsAre(HasSubstr("2 streams with video: the first one, 160x96 px, is used")));
    expect_frames(file, {"", "", "", ""});
  }
}

// A view in a file of OpenCV.
class OfOpenCv : public ::testing::TestWithParam<File> {};

TEST_P(OfOpenCv, FramesAreThoseOfTheirNumbers) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  const fs::path raw = folder / "frames.gray", file = folder / GetParam().file;
  std::string frames;
  for (int i = 0; i < kFrames; ++i) {
    const std::vector<std::uint8_t> frame = testing::stereo_frame(i, View::kLeft);
    frames.append(frame.begin(), frame.end());
  }
  write_text(raw, frames);
  // Its libraries may leak.
  run_command("ASAN_OPTIONS=detect_leaks=0 '" OPENCV_WRITER "' " + GetParam().options +
              " 160 96 '" + raw.string() + "' '" + file.string() + "'");
  expect_frames(file, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Files, OfOpenCv,
                         ::testing::Values(File{"MotionJpeg", "a.avi", "", "MJPG", kFrames, 0.5},
                                           File{"Mpeg4", "a.mp4", "", "mp4v"},
                                           File{"Mpeg4InAvi", "a.avi", "", "XVID"}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mtstereo::run::foreign_files_test

// SPDX-License-Identifier: LGPL-2.1-or-later
// Videos that ffmpeg and OpenCV have written: the frames of the numbers are those that ffmpeg
// decodes, in order and after jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <span>

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

const std::string kH264 = "-c:v libx264 -preset veryfast -bf 3 -g 20 -threads 1 ";
const std::string kOpenGroups = kH264 + "-x264-params open_gop=1 ";
const std::string kH265 =
    "-c:v libx265 -preset ultrafast -x265-params log-level=none:open-gop=1:keyint=20:bframes=3 ";

// The inputs of ffmpeg besides the frames.
constexpr const char* kInputs =
    " -f lavfi -i sine=duration=4 -itsoffset -0.5 -f lavfi -i sine=duration=4 "
    "-f lavfi -i testsrc=size=96x64:rate=25:duration=2 ";
const std::string kSound = "-map 1 ", kEarlySound = "-map 2 ", kSecondVideo = "-map 3 ";

struct Output {
  fs::path file;        // its extension is that of the container
  std::string options;  // of ffmpeg
};

fs::path write_raw(const TemporaryFolder& folder, View view) {
  std::string frames;
  for (int i = 0; i < kFrames; ++i) {
    const std::vector<std::uint8_t>& frame = testing::stereo_frame(i, view);
    frames.append(frame.begin(), frame.end());
  }
  write_text(folder / "frames.gray", frames);
  return folder / "frames.gray";
}

// Writes the frames of a view: one process for all files, since ffmpeg starts slowly.
void write_by_ffmpeg(const std::vector<Output>& outputs, View view = View::kLeft) {
  const TemporaryFolder folder;
  std::string command = "ffmpeg -v error -y -f rawvideo -pix_fmt gray -s 160x96 -r 30 -i '" +
                        write_raw(folder, view).string() + "'" + kInputs + "-vsync vfr";
  for (const Output& output : outputs) {
    command += " -map 0 -pix_fmt yuv420p " + output.options + " '" + output.file.string() + "'";
  }
  run_command(command);
}

// The luma of all frames of a video.
using Frames = std::vector<std::string>;

// What ffmpeg decodes, also by one process.
std::vector<Frames> by_ffmpeg(const std::vector<fs::path>& videos) {
  std::string inputs, outputs;
  for (std::size_t i = 0; i < videos.size(); ++i) {
    inputs += " -i '" + videos[i].string() + "'";
    outputs += " -map " + std::to_string(i) + ":v:0 -f rawvideo '" + videos[i].string() + ".raw'";
  }
  run_command("ffmpeg -v error -y" + inputs + " -vsync passthrough" + outputs);
  std::vector<Frames> all;
  for (const fs::path& video : videos) {
    const std::string bytes = bytes_of(video.string() + ".raw");
    Frames& frames = all.emplace_back();
    for (std::size_t at = 0; at + kPixels * 3 / 2 <= bytes.size(); at += kPixels * 3 / 2) {
      frames.push_back(bytes.substr(at, kPixels));
    }
  }
  return all;
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

// `difference`: the largest mean, of decoders whose transforms are not those of ffmpeg.
void expect_frames(const fs::path& file, const Frames& frames, double difference = 0) {
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
              difference)
        << number;
  }
}

struct File {
  const char* name;       // of the case
  const char* container;  // the extension
  std::string options;    // of ffmpeg; or the code of OpenCV
  int count = kFrames;    // frames
  double difference = 0;  // see expect_frames()
};

void PrintTo(const File& file, std::ostream* out) { *out << file.name; }

// Files that another program has written at once, and their frames as ffmpeg decodes them.
class OfOthers : public ::testing::TestWithParam<File> {
 protected:
  static void SetUpTestSuite() { folder_ = std::make_unique<TemporaryFolder>(); }
  static void TearDownTestSuite() {
    frames_.clear();
    folder_.reset();
  }
  static fs::path path_of(const File& file) {
    return *folder_ / (std::string(file.name) + "." + file.container);
  }
  static void decode(std::span<const File> files) {
    std::vector<fs::path> paths;
    for (const File& file : files) paths.push_back(path_of(file));
    std::vector<Frames> decoded = by_ffmpeg(paths);
    for (std::size_t i = 0; i < paths.size(); ++i) frames_[paths[i]] = std::move(decoded[i]);
  }
  void check() {
    if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
    const Frames& frames = frames_[path_of(GetParam())];
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(GetParam().count));
    expect_frames(path_of(GetParam()), frames, GetParam().difference);
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::map<fs::path, Frames> frames_;
};

const File kOfFfmpeg[] = {
    {"MatroskaWithSound", "mkv", kSound + kH264 + "-c:a aac"},
    {"Mp4WithSound", "mp4", kSound + kH264 + "-c:a aac"},
    {"FragmentedMp4", "mp4", kSound + kH264 + "-c:a aac -movflags frag_keyframe+empty_moov"},
    {"TransportStreamWithSound", "ts", kSound + kH264 + "-c:a aac"},
    {"ProgramStream", "mpg", kSound + "-c:v mpeg2video -bf 2 -g 12 -b:v 2M -c:a mp2", kFrames, 0.5},
    {"OpenGroups", "mp4", kOpenGroups},
    {"Hevc", "mkv", kH265},
    {"VariableRateMatroska", "mkv", kH264 + "-vf select='mod(n\\,5)'", kFrames * 4 / 5},
    {"VariableRateMp4", "mp4", kH264 + "-vf select='mod(n\\,5)'", kFrames * 4 / 5},
    {"Avi", "avi", kSound + "-c:v mpeg4 -g 20 -q:v 3 -c:a mp3"},
    {"AviWithBFrames", "avi", "-c:v mpeg4 -bf 2 -g 20 -q:v 3"},
    {"H264InAvi", "avi", kH264},
    {"MatroskaThatStartsWithSound", "mkv", kEarlySound + kH264 + "-c:a flac"},
    {"Vp9", "webm", "-c:v libvpx-vp9 -deadline realtime -cpu-used 8"},
    {"Ffv1", "mkv", kSound + "-c:v ffv1 -c:a flac"},
    {"MotionJpeg", "avi", kSound + "-c:v mjpeg -pix_fmt yuvj420p -q:v 3", kFrames, 0.5}};

class OfFfmpeg : public OfOthers {
 protected:
  static void SetUpTestSuite() {
    OfOthers::SetUpTestSuite();
    if (!have_ffmpeg()) return;
    std::vector<Output> outputs;
    for (const File& file : kOfFfmpeg) outputs.push_back({path_of(file), file.options});
    write_by_ffmpeg(outputs);
    decode(kOfFfmpeg);
  }
};

TEST_P(OfFfmpeg, FramesAreThoseOfTheirNumbers) { check(); }

INSTANTIATE_TEST_SUITE_P(Files, OfFfmpeg, ::testing::ValuesIn(kOfFfmpeg),
                         [](const auto& info) { return info.param.name; });

const File kOfOpenCv[] = {{"MotionJpeg", "avi", "MJPG", kFrames, 0.5},
                          {"Mpeg4", "mp4", "mp4v"},
                          {"Mpeg4InAvi", "avi", "XVID"}};

class OfOpenCv : public OfOthers {
 protected:
  static void SetUpTestSuite() {
    OfOthers::SetUpTestSuite();
    if (!have_ffmpeg()) return;
    // Its libraries may leak.
    std::string command = "ASAN_OPTIONS=detect_leaks=0 '" OPENCV_WRITER "' 160 96 '" +
                          write_raw(*folder_, View::kLeft).string() + "'";
    for (const File& file : kOfOpenCv) command += " " + file.options + " " + path_of(file).string();
    run_command(command);
    decode(kOfOpenCv);
  }
};

TEST_P(OfOpenCv, FramesAreThoseOfTheirNumbers) { check(); }

INSTANTIATE_TEST_SUITE_P(Files, OfOpenCv, ::testing::ValuesIn(kOfOpenCv),
                         [](const auto& info) { return info.param.name; });

// The frames that lead the first keyframe refer to others that are not in the file. Matroska does
// not state their times, and MP4 leaves them out by its edit list.
TEST(OfFfmpegCut, StartsAtItsKeyframe) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder folder;
  write_by_ffmpeg({{folder / "h264.mp4", kOpenGroups}, {folder / "h265.mp4", kH265}});
  std::string inputs, outputs;
  std::vector<fs::path> cuts;
  for (const char* coding : {"h264", "h265"}) {
    inputs += " -ss 1.2 -i '" + (folder / coding).string() + ".mp4'";
    for (const char* container : {".mkv", ".mp4"}) {
      cuts.push_back(folder / (std::string("cut-") + coding + container));
      outputs += std::string(" -map ") + (coding == std::string("h264") ? "0" : "1") +
                 " -c copy '" + cuts.back().string() + "'";
    }
  }
  run_command("ffmpeg -v error" + inputs + outputs);
  const std::vector<Frames> frames = by_ffmpeg(cuts);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    SCOPED_TRACE(cuts[i]);
    ASSERT_GT(frames[i].size(), std::size_t{kFrames} / 3);
    expect_frames(cuts[i], frames[i]);
  }
}

// Pieces of files in which a seek alone would give other frames.
TEST(OfFfmpegInPieces, JoinedAreEqualToTheWhole) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const TemporaryFolder all;
  for (const auto& [name, view] : {std::pair("left", View::kLeft), {"right", View::kRight}}) {
    write_by_ffmpeg({{all / (std::string(name) + ".mkv"), kEarlySound + kH264 + "-c:a flac"},
                     {all / (std::string(name) + ".avi"), kH264}},
                    view);
  }
  for (const std::string container : {".mkv", ".avi"}) {
    const TemporaryFolder folder;
    const Work work = testing::work_of(all / ("left" + container), all / ("right" + container), {});
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

fs::path h264(const TemporaryFolder& folder, const std::string& file) {
  write_by_ffmpeg({{folder / file, kH264}});
  return folder / file;
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
  const TemporaryFolder folder;
  const std::vector<fs::path> files{folder / "a.mkv", folder / "a.mp4", folder / "a.ts"};
  std::vector<Output> outputs;
  for (const fs::path& file : files) outputs.push_back({file, kSecondVideo + kH264});
  write_by_ffmpeg(outputs);
  const std::vector<Frames> frames = by_ffmpeg(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_THAT(index_of(files[i]).remarks,
                ElementsAre(HasSubstr("2 streams with video: the first one, 160x96 px, is used")));
    ASSERT_EQ(frames[i].size(), static_cast<std::size_t>(kFrames));
    expect_frames(files[i], frames[i]);
  }
}

}  // namespace
}  // namespace mtstereo::run::foreign_files_test

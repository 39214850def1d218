// SPDX-License-Identifier: LGPL-2.1-or-later
// What decoders report about damaged videos, and nothing about whole ones.
#include "recordings/media/decoder_reports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "recordings/media/frame_reader.hpp"
#include "recordings/media/jpeg_check.hpp"
#include "recordings/support/video_files.hpp"

namespace mtstereo::run::decoder_reports_test {
namespace {

namespace fs = std::filesystem;
using testing::constant_times;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kBFrames;
using ::testing::Not;
using testing::run_command;
using ::testing::SizeIs;
using testing::TemporaryFolder;
using testing::write_text;
using testing::write_video;

constexpr Nanoseconds kLast = 1'000'000'000'000;
constexpr int kFrames = 150;
constexpr std::int64_t kAfterSeek = 90;  // far enough from the start for one

std::string bytes_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Changes single bytes in the middle third of the file.
void damage_middle(const fs::path& file) {
  constexpr std::size_t kStep = 151;
  std::string bytes = bytes_of_file(file);
  for (std::size_t i = bytes.size() / 3; i < 2 * bytes.size() / 3; i += kStep) bytes[i] ^= 0x55;
  write_text(file, bytes);
}

std::vector<DamagedFrame> damage_of(const fs::path& video, std::int64_t first = 0) {
  const FrameIndex index = index_frames({video, {}, {}}, 0);
  const auto reader = open_video(video, index);
  for (auto i = first; i < std::ssize(index.times); ++i) reader->read(i);
  return reader->take_damaged();
}

struct Coding {
  const char* file;
  std::string line;  // after the source
};

void PrintTo(const Coding& coding, std::ostream* out) { *out << coding.file; }

class Codings : public ::testing::TestWithParam<Coding> {
 protected:
  fs::path written() const {
    const fs::path file = folder_ / GetParam().file;
    write_video(file, GetParam().line, constant_times(kFrames));
    return file;
  }

  TemporaryFolder folder_;
};

TEST_P(Codings, WholeFileHasNoDamage) {
  const fs::path file = written();
  for (const std::int64_t first : {std::int64_t{0}, kAfterSeek})
    EXPECT_THAT(damage_of(file, first), IsEmpty());
}

TEST_P(Codings, ReportsDamagedFrame) {
  const fs::path file = written();
  damage_middle(file);
  const std::vector<DamagedFrame> found = damage_of(file);
  ASSERT_THAT(found, Not(IsEmpty()));
  EXPECT_LT(found.size(), std::size_t{kFrames});
  EXPECT_FALSE(found.front().reason.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Muxers, Codings,
    ::testing::Values(Coding{"b-frames.mp4", std::string(kBFrames) + " ! mp4mux"},
                      Coding{"b-frames.mkv", std::string(kBFrames) + " ! matroskamux"},
                      Coding{"jpeg.avi", "jpegenc ! avimux"},
                      Coding{"jpeg.mkv", "jpegenc ! matroskamux"},
                      Coding{"mpeg4.mp4", "avenc_mpeg4 ! mp4mux"}));

// The file ends with the data of its last frame, of more than 800 bytes.
TEST(DecodedVideo, NamesTheFrameThatIsDamaged) {
  const TemporaryFolder folder;
  const std::string file = (folder / "last.mp4").string();
  run_command(
      "ffmpeg -v error -f lavfi -i testsrc=size=64x48:rate=30:duration=2,noise=alls=40:allf=t "
      "-pix_fmt yuv420p -c:v libx264 -g 1 -movflags +faststart '" +
      file + "'");
  std::string bytes = bytes_of_file(file);
  for (std::size_t i = 600; i > 500; --i) bytes[bytes.size() - i] ^= 0x55;
  write_text(file, bytes);
  const std::vector<DamagedFrame> found = damage_of(file);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().time, index_frames({file, {}, {}}, 0).times.back());
}

// Threads of libav count on after a seek.
TEST(DecodedVideo, ReportsTheSameFramesAfterASeek) {
  const TemporaryFolder folder;
  const fs::path file = folder / "b-frames.mp4";
  write_video(file, std::string(kBFrames) + " ! mp4mux", constant_times(kFrames));
  damage_middle(file);
  const FrameIndex index = index_frames({file, {}, {}}, 0);
  ASSERT_GT(std::ssize(index.times), kAfterSeek);
  std::vector<std::optional<Nanoseconds>> expected, times;
  for (const DamagedFrame& frame : damage_of(file)) {
    if (frame.time >= index.times[kAfterSeek]) expected.push_back(frame.time);
  }
  for (const DamagedFrame& frame : damage_of(file, kAfterSeek)) times.push_back(frame.time);
  EXPECT_THAT(times, Not(IsEmpty()));
  EXPECT_THAT(times, ElementsAreArray(expected));
}

void expect_no_damage_of_cut(const std::string& coding, const std::string& from,
                             const std::string& name) {
  const TemporaryFolder folder;
  const std::string whole = (folder / "whole.mp4").string(), cut = (folder / name).string();
  run_command(
      "ffmpeg -v error -f lavfi -i testsrc2=size=64x48:rate=30:duration=3,noise=alls=20:allf=t "
      "-pix_fmt yuv420p -c:v libx264 -x264-params open-gop=1:" +
      coding + " '" + whole + "'");
  run_command("ffmpeg -v error -ss " + from + " -i '" + whole + "' -c copy '" + cut + "'");
  EXPECT_EQ(index_frames({cut, {}, {}}, 0).damage, "");
  EXPECT_THAT(damage_of(cut), IsEmpty());
}

// The decoder needs frames that the edit list leaves out, and misses others that they refer to.
TEST(DecodedVideo, CutWithAnEditListHasNoDamage) {
  expect_no_damage_of_cut("keyint=15:min-keyint=15:scenecut=0:bframes=3", "0.5", "cut.mp4");
}

TEST(DecodedVideo, CutWithLeadingFramesWithoutTimesHasNoDamage) {
  expect_no_damage_of_cut("keyint=15:min-keyint=15:scenecut=0:bframes=3", "0.7", "cut.mkv");
}

// A frame that is shown asks to forget references that are not in the file.
TEST(DecodedVideo, CutWithoutOldReferencesHasNoDamage) {
  expect_no_damage_of_cut("keyint=40:bframes=8:b-pyramid=strict:ref=4", "2.3", "cut.mkv");
}

TEST(DecoderReports, CountsFromTheFirstKeyframeOn) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(50, false);
  reports->add("before the keyframe");
  reports->begin(100, true);
  reports->begin(80, false);
  reports->add("shown before the keyframe");
  EXPECT_THAT(reports->take_until(kLast), IsEmpty());
  reports->begin(120, false);
  reports->add("damaged");
  reports->add("the same frame");
  const std::vector<DamagedFrame> found = reports->take_until(kLast);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().time, 120);
  EXPECT_EQ(found.front().reason, "damaged");
}

TEST(DecoderReports, DoesNotCountFramesThatWereNotRead) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(0, true);
  reports->begin(90, false);
  reports->add("later");
  EXPECT_THAT(reports->take_until(80), IsEmpty());
  EXPECT_THAT(reports->take_until(90), SizeIs(1));
}

TEST(DecoderReports, AfterASeekOnlyWantedFramesCount) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(0, true);
  reports->set_first(300);
  reports->flush();
  reports->begin(200, true);
  reports->begin(250, false);
  reports->add("decoded for others");
  reports->begin(300, false);
  reports->add("wanted");
  const std::vector<DamagedFrame> found = reports->take_until(kLast);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().reason, "wanted");
}

TEST(DecoderReports, FramesThatAreNotShownDoNotCount) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(DecoderReports::kNotShown, true);
  reports->add("before an edit list");
  EXPECT_THAT(reports->take_until(kLast), IsEmpty());
}

TEST(DecoderReports, ThreadsReportByNumber) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(10, false);  // before the keyframe
  for (const Nanoseconds time : {100, 120, 140}) reports->begin(time, time == 100);
  for (const std::int64_t number : {-1, 0, 2, 4}) reports->add_of(number, "of a thread");
  const std::vector<DamagedFrame> found = reports->take_until(kLast);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().time, 120);
}

TEST(DecoderReports, OldNumbersAreForgotten) {
  const auto reports = std::make_shared<DecoderReports>();
  for (Nanoseconds time = 0; time < 1000; ++time) reports->begin(time, true);
  for (const std::int64_t number : {0, 500, 990}) reports->add_of(number, "of a thread");
  const std::vector<DamagedFrame> found = reports->take_until(kLast);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found.front().time, 990);
}

TEST(DecoderReports, FramesWithoutTimesCount) {
  const auto reports = std::make_shared<DecoderReports>();
  reports->begin(std::nullopt, true);
  reports->add("no time");
  EXPECT_THAT(reports->take_until(0), SizeIs(1));
}

TEST(DamageText, StatesCountTimeAndReason) {
  EXPECT_EQ(damage_text({}, "left view"), "");
  EXPECT_EQ(damage_text({{1'500'000'000, "bad"}}, "left view"),
            "1 frame of the left view cannot be decoded without errors, the first one at 1.500 s "
            "(bad)");
  EXPECT_EQ(damage_text({{std::nullopt, "bad"}, {5, "worse"}}, "recording"),
            "2 frames of the recording cannot be decoded without errors (bad)");
}

class JpegCheck : public ::testing::Test {
 protected:
  // One frame with the markers of its start and end.
  std::string image() const {
    const fs::path file = folder_ / "one.jpg";
    write_video(file, "jpegenc", constant_times(1));
    return bytes_of_file(file);
  }

  TemporaryFolder folder_;
};

TEST_F(JpegCheck, AcceptsWholeImage) { EXPECT_EQ(damage_of_jpeg(image()), ""); }

// Some cameras write such bytes.
TEST_F(JpegCheck, AcceptsFillBytesBeforeTheEnd) {
  std::string bytes = image();
  bytes.insert(bytes.size() - 2, std::string(4, '\0'));
  EXPECT_EQ(damage_of_jpeg(bytes), "");
}

TEST_F(JpegCheck, ReportsTruncatedImage) {
  const std::string bytes = image();
  EXPECT_THAT(damage_of_jpeg(std::string_view(bytes).substr(0, bytes.size() * 3 / 4)),
              HasSubstr("Premature end"));
}

TEST_F(JpegCheck, ReportsWhatIsNoImage) {
  EXPECT_NE(damage_of_jpeg(std::string_view()), "");
  EXPECT_NE(damage_of_jpeg(std::string(500, 'x')), "");
  EXPECT_NE(damage_of_jpeg(std::string_view("\xff\xd8")), "");
}

}  // namespace
}  // namespace mtstereo::run::decoder_reports_test

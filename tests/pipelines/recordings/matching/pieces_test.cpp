// SPDX-License-Identifier: LGPL-2.1-or-later
// Pieces of recordings: selected by number, and joined to the bytes of one uncut run.
#include <gtest/gtest.h>

#include <memory>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/media/frame_reader.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::pieces_test {
namespace {

namespace fs = std::filesystem;
using testing::constant_times;
using testing::contents_of;
using testing::kBFrames;
using testing::TemporaryFolder;
using testing::variable_times;
using testing::View;
using testing::whole;
using testing::work_of;
using testing::write_view;

constexpr int kFrames = 100;  // further than a reader decodes without a seek
const Progress kNoProgress;

struct File {
  const char* name;  // of the case
  std::string coding;
  const char* extension;
  bool variable_rate = false;
  bool all_products = false;
};

void PrintTo(const File& file, std::ostream* out) { *out << file.name; }

const std::string kH264 = kBFrames;
const std::string kOpenGop =
    "x264enc bframes=3 b-adapt=false key-int-max=25 option-string=open-gop=1 "
    "speed-preset=veryfast bitrate=300 ! h264parse";

class Pieces : public ::testing::TestWithParam<File> {
 protected:
  static void SetUpTestSuite() { videos_ = std::make_unique<TemporaryFolder>(); }
  static void TearDownTestSuite() { videos_.reset(); }
  // The video of a view, which the tests share.
  static fs::path video_of(View view) {
    const std::string name = std::string(view == View::kLeft ? "left" : "right") + GetParam().name;
    const fs::path file = *videos_ / (name + "." + GetParam().extension);
    if (fs::exists(file)) return file;
    const auto times = GetParam().variable_rate ? variable_times(kFrames) : constant_times(kFrames);
    write_view(file, view, GetParam().coding, times);
    return file;
  }

  TemporaryFolder folder_;

 private:
  static inline std::unique_ptr<TemporaryFolder> videos_;
};

// The luma of a frame.
std::string pixels_of(const DecodedFrame& frame) {
  GstMapInfo map;
  EXPECT_TRUE(gst_buffer_map(frame.buffer.get(), &map, GST_MAP_READ));
  std::string bytes(reinterpret_cast<const char*>(map.data), map.size);
  gst_buffer_unmap(frame.buffer.get(), &map);
  return bytes;
}

// Feature: long recordings in pieces
TEST_P(Pieces, FramesAreThoseOfTheirNumbers) {
  const fs::path left = video_of(View::kLeft);
  const FrameIndex index = index_frames({left, {}, {}}, 0);
  ASSERT_GE(index.times.size(), static_cast<std::size_t>(kFrames - 3));
  const auto in_order = open_video(left, index);
  std::vector<std::string> frames;
  for (std::size_t i = 0; i < index.times.size(); ++i) {
    const DecodedFrame frame = in_order->read(static_cast<std::int64_t>(i));
    ASSERT_EQ(frame.state, FrameState::kDecoded) << i << in_order->problem();
    frames.push_back(pixels_of(frame));
    ASSERT_TRUE(i == 0 || frames[i] != frames[i - 1]) << i;
  }
  const auto jumping = open_video(left, index);
  for (const std::int64_t number : {75, 76, 2, 93, 94, 95, 30, 83, 29, 96, 60, 0, 90}) {
    const DecodedFrame frame = jumping->read(number);
    ASSERT_EQ(frame.state, FrameState::kDecoded) << number << jumping->problem();
    EXPECT_EQ(pixels_of(frame), frames[static_cast<std::size_t>(number)]) << number;
  }
}

// Feature: long recordings in pieces
TEST_P(Pieces, JoinedAreEqualToTheWhole) {
  WorkOptions options;
  if (GetParam().all_products) {
    options.products = {Product::kDisparity, Product::kColor, Product::kConfidence,
                        Product::kRectifiedLeft, Product::kRectifiedRight};
  }
  const Work work = work_of(video_of(View::kLeft), video_of(View::kRight), options);
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  const PieceReport uncut = process(work, whole(work), folder_ / "whole", kNoProgress);
  EXPECT_EQ(uncut.frames.size(), work.pairs.pairs.size());
  EXPECT_EQ(uncut.damage, "");
  const std::vector<Range> ranges{{0, 67}, {67, 1}, {68, pairs - 68}};
  std::vector<fs::path> folders;
  // A task reads the work from a file, in any order.
  write_work(work, folder_ / "work.json");
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    folders.push_back(folder_ / ("piece" + std::to_string(i)));
    Work read = read_work(folder_ / "work.json");
    read.options.threads = static_cast<int>(i) + 1;  // as many matchers, with the same bytes
    process(read, ranges[i], folders[i], kNoProgress);
  }
  const PieceReport joined = join(work, ranges, folders, folder_ / "joined");
  EXPECT_EQ(contents_of(folder_ / "joined"), contents_of(folder_ / "whole"));
  ASSERT_EQ(joined.frames.size(), uncut.frames.size());
  for (std::size_t i = 0; i < joined.frames.size(); ++i) {
    EXPECT_EQ(joined.frames[i].pair, uncut.frames[i].pair);
    EXPECT_EQ(joined.frames[i].median_disparity, uncut.frames[i].median_disparity) << i;
    EXPECT_NEAR(joined.frames[i].density, uncut.frames[i].density, 1e-8) << i;
  }
  EXPECT_EQ(joined.files, uncut.files);
}

INSTANTIATE_TEST_SUITE_P(
    Files, Pieces,
    ::testing::Values(
        File{"Mp4BFrames", kH264 + " ! mp4mux", "mp4"},
        File{"MatroskaBFrames", kH264 + " ! matroskamux", "mkv", false, true},
        File{"TransportStream", kH264 + " ! mpegtsmux", "ts"},
        File{"VariableRate", kH264 + " ! matroskamux", "mkv", true},
        File{"VariableRateMp4", kH264 + " ! mp4mux", "mp4", true},
        File{"VariableRateTransportStream", kH264 + " ! mpegtsmux", "ts", true},
        File{"OpenGop", kOpenGop + " ! matroskamux", "mkv"},
        File{"OpenGopTransportStream", kOpenGop + " ! mpegtsmux", "ts"},
        File{"H265", "x265enc key-int-max=25 speed-preset=ultrafast ! h265parse ! mp4mux", "mp4"},
        File{"Vp8", "vp8enc keyframe-max-dist=25 deadline=1 ! webmmux", "webm"},
        File{"Avi", "avenc_mpeg4 gop-size=20 max-bframes=2 bitrate=400000 ! avimux", "avi"},
        File{"MotionJpeg", "jpegenc ! avimux", "avi"}),
    [](const auto& info) { return info.param.name; });

TEST(PieceRange, BeyondTheRecordingIsAnError) {
  Work work;
  work.pairs.pairs.resize(10);
  TemporaryFolder folder;
  for (const Range range : {Range{-1, 2}, Range{0, 0}, Range{9, 2}, Range{0, 11}}) {
    EXPECT_THROW(process(work, range, folder / "piece", kNoProgress), UserError);
  }
}

class Joining : public ::testing::Test {
 protected:
  void SetUp() override {
    write_view(folder_ / "left.mkv", View::kLeft, kH264 + " ! matroskamux", constant_times(12));
    write_view(folder_ / "right.mkv", View::kRight, kH264 + " ! matroskamux", constant_times(12));
    work_ = work_of(folder_ / "left.mkv", folder_ / "right.mkv", {});
    process(work_, {0, 6}, folder_ / "a", kNoProgress);
    process(work_, {6, 6}, folder_ / "b", kNoProgress);
  }
  std::string refusal(const std::vector<Range>& ranges, const std::vector<fs::path>& pieces) {
    return test::error_of<UserError>([&] { join(work_, ranges, pieces, folder_ / "joined"); });
  }
  TemporaryFolder folder_;
  Work work_;
};

TEST_F(Joining, AcceptsPiecesInAnyOrder) {
  EXPECT_EQ(refusal({{6, 6}, {0, 6}}, {folder_ / "b", folder_ / "a"}), "");
}

TEST_F(Joining, RefusesAGap) {
  EXPECT_NE(refusal({{6, 6}}, {folder_ / "b"}).find("no piece begins with pair 0"),
            std::string::npos);
  EXPECT_NE(refusal({{0, 6}}, {folder_ / "a"}).find("end before"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "joined" / kPieceFile));
}

TEST_F(Joining, RefusesAnotherPiece) {
  EXPECT_NE(refusal({{0, 6}, {6, 6}}, {folder_ / "a", folder_ / "a"}).find("other pairs"),
            std::string::npos);
}

TEST_F(Joining, RefusesAPieceThatWasChanged) {
  const fs::path file = folder_ / "b" / "disparity.mkv";
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_NE(refusal({{0, 6}, {6, 6}}, {folder_ / "a", folder_ / "b"}).find("its report states 6"),
            std::string::npos);
  fs::remove(file);
  EXPECT_NE(refusal({{0, 6}, {6, 6}}, {folder_ / "a", folder_ / "b"}).find("other files"),
            std::string::npos);
}

}  // namespace
}  // namespace mtstereo::run::pieces_test

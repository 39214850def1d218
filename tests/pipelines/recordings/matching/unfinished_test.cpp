// SPDX-License-Identifier: LGPL-2.1-or-later
// Pieces that were interrupted, and recordings that end early.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/media/frame_reader.hpp"
#include "recordings/support/stereo_files.hpp"
#include "recordings/support/video_files.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::unfinished_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::constant_times;
using testing::contents_of;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::kBFrames;
using testing::TemporaryFolder;
using testing::View;
using testing::whole;
using testing::work_of;
using testing::write_view;

constexpr std::int64_t kFrames = 20;
const Progress kNoProgress;

class Interrupted : public ::testing::TestWithParam<MapFormat> {
 protected:
  // All tests have the same videos and uninterrupted results.
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const std::string coding = kBFrames + std::string(" ! matroskamux");
    write_view(*shared_ / "left.mkv", View::kLeft, coding, constant_times(kFrames));
    write_view(*shared_ / "right.mkv", View::kRight, coding, constant_times(kFrames));
  }
  static void TearDownTestSuite() { shared_.reset(); }
  void SetUp() override {
    WorkOptions options;
    options.products = {Product::kDisparity, Product::kConfidence};
    options.format = GetParam();
    work_ = work_of(*shared_ / "left.mkv", *shared_ / "right.mkv", options);
    whole_ = *shared_ / (GetParam() == MapFormat::kPng ? "png" : "matroska");
    if (!fs::exists(whole_)) process(work_, whole(work_), whole_, kNoProgress);
  }

  // Processes the pairs into the folder "piece"; returns the numbers of those that were done.
  std::vector<std::int64_t> run(std::int64_t stop_after, Existing existing) {
    std::vector<std::int64_t> done;
    const Progress progress = [&](std::int64_t count, std::int64_t total, double) {
      EXPECT_EQ(total, kFrames);
      done.push_back(count);
      const fs::path journal = folder_ / "piece" / "unfinished" / "journal";
      if (count == kFrames) fs::copy_file(journal, folder_ / "journal");
      return count < stop_after;
    };
    try {
      process(work_, whole(work_), folder_ / "piece", progress, existing);
      EXPECT_GT(stop_after, kFrames);
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find("stopped after"), std::string::npos) << error.what();
    }
    return done;
  }

  // Why nothing is processed into the folder "piece".
  std::string refusal(Existing existing) {
    return test::error_of<UserError>(
        [&] { process(work_, whole(work_), folder_ / "piece", kNoProgress, existing); });
  }

  // Only the folder of unfinished files is in the folder.
  void expect_no_results() {
    for (const auto& entry : fs::directory_iterator(folder_ / "piece")) {
      EXPECT_EQ(entry.path().filename(), "unfinished");
    }
  }
  void expect_whole() {
    EXPECT_EQ(contents_of(folder_ / "piece"), contents_of(whole_));
    Range range;
    const PieceReport report = read_piece(folder_ / "piece" / kPieceFile, range);
    EXPECT_EQ(report.frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(range.count, kFrames);
  }

  TemporaryFolder folder_;
  fs::path whole_;
  Work work_;

 private:
  static inline std::unique_ptr<TemporaryFolder> shared_;
};

// Feature: interruptions and damaged files
TEST_P(Interrupted, ContinuesWhereItWas) {
  EXPECT_EQ(run(7, Existing::kReplace).size(), 7u);
  expect_no_results();
  EXPECT_EQ(run(12, Existing::kContinue), (std::vector<std::int64_t>{8, 9, 10, 11, 12}));
  expect_no_results();
  EXPECT_EQ(run(kFrames + 1, Existing::kContinue).front(), 13);
  expect_whole();
}

TEST_P(Interrupted, LeavesNothingOfAFileThatWasCutOff) {
  run(7, Existing::kReplace);
  const fs::path images = folder_ / "piece" / "unfinished" / "disparity";
  fs::create_directories(images);
  std::ofstream(images / "000007.png.123-4.part") << "cut";
  run(kFrames + 1, Existing::kContinue);
  expect_whole();
  EXPECT_FALSE(fs::exists(folder_ / "piece" / "disparity" / "000007.png.123-4.part"));
}

TEST_P(Interrupted, LeavesNothingIfTheFirstPairCannotBeWritten) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small = {200, before.rlim_max};  // bytes; enough for the journal
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal(Existing::kRefuse);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(message, HasSubstr("cannot be written: File too large"));
  EXPECT_FALSE(fs::exists(folder_ / "piece" / "unfinished"));
  run(kFrames + 1, Existing::kRefuse);
  expect_whole();
}

TEST_P(Interrupted, StartsOverUnlessAskedToContinue) {
  run(7, Existing::kReplace);
  EXPECT_EQ(run(kFrames + 1, Existing::kReplace).front(), 1);
  expect_whole();
}

TEST_P(Interrupted, IsKeptFromAnotherWorkUnlessItIsReplaced) {
  run(7, Existing::kReplace);
  work_.options.parameters.emplace_back("mode", "sparse");
  EXPECT_THAT(refusal(Existing::kContinue), HasSubstr("interrupted run of another input or other"));
  EXPECT_THAT(refusal(Existing::kRefuse), HasSubstr("has a run that was interrupted: --resume"));
  EXPECT_EQ(run(9, Existing::kReplace).front(), 1);
}

TEST_P(Interrupted, WhileItsFilesArePublishedIsFinished) {
  run(kFrames + 1, Existing::kReplace);
  // As if the program had been killed before the last steps.
  const fs::path piece = folder_ / "piece", unfinished = piece / "unfinished";
  const std::string journal = testing::bytes_of(folder_ / "journal");
  fs::create_directories(unfinished);
  fs::rename(piece / kPieceFile, unfinished / kPieceFile);
  const char* const last = GetParam() == MapFormat::kMatroska ? "confidence.mkv" : "confidence";
  fs::rename(piece / last, unfinished / last);
  testing::write_text(unfinished / "journal", journal);
  EXPECT_TRUE(run(kFrames + 1, Existing::kContinue).empty());
  expect_whole();
}

// Feature: files of the user are kept
TEST_P(Interrupted, RemovesNoForeignFile) {
  const fs::path piece = folder_ / "piece", unfinished = piece / "unfinished";
  run(7, Existing::kReplace);
  for (const char* name : {"notes.txt", "disparity/notes.png", "000000.png"}) {
    fs::create_directories((unfinished / name).parent_path());
    testing::write_text(unfinished / name, "mine");
    for (const Existing existing : {Existing::kContinue, Existing::kReplace}) {
      EXPECT_THAT(refusal(existing), AllOf(HasSubstr(name), HasSubstr("no earlier run wrote it")));
    }
    EXPECT_EQ(testing::bytes_of(unfinished / name), "mine");
    fs::remove(unfinished / name);
  }
  EXPECT_EQ(run(kFrames + 1, Existing::kContinue).front(), 8);
}

TEST_P(Interrupted, TakesNoForeignFolderForItsOwn) {
  const fs::path unfinished = folder_ / "piece" / "unfinished";
  fs::create_directories(unfinished);
  testing::write_text(unfinished / "journal", "Dear diary\n");
  for (const Existing existing : {Existing::kRefuse, Existing::kContinue, Existing::kReplace}) {
    EXPECT_THAT(refusal(existing), AllOf(HasSubstr("unfinished"), HasSubstr("no journal")));
  }
  EXPECT_EQ(testing::bytes_of(unfinished / "journal"), "Dear diary\n");
}

TEST_P(Interrupted, ResultsAreReplacedOnlyIfTheyAreListedAndUnchanged) {
  run(kFrames + 1, Existing::kReplace);
  EXPECT_THAT(refusal(Existing::kRefuse), HasSubstr("has results already"));
  const bool video = GetParam() == MapFormat::kMatroska;
  const fs::path file = folder_ / "piece" / (video ? "disparity.mkv" : "disparity/000003.png");
  testing::write_text(file, "mine");
  EXPECT_THAT(refusal(Existing::kReplace), HasSubstr("was changed since it was written"));
  EXPECT_EQ(testing::bytes_of(file), "mine");
  fs::remove(file);
  const fs::path other = folder_ / "piece" / (video ? "disparity.mkv/mine" : "disparity/mine");
  fs::create_directories(other.parent_path());
  testing::write_text(other, "mine");
  EXPECT_THAT(refusal(Existing::kReplace), HasSubstr("no earlier run wrote it"));
  EXPECT_EQ(testing::bytes_of(other), "mine");
}

TEST_P(Interrupted, ContinuesAfterTheLastWholeFrame) {
  run(7, Existing::kReplace);
  const fs::path unfinished = folder_ / "piece" / "unfinished";
  // As if the program had been killed in the middle of a line, or of a frame.
  std::ofstream(unfinished / "journal", std::ios::app) << "7 7 7 0.5";
  std::int64_t next = 8;
  if (GetParam() == MapFormat::kMatroska) {
    const fs::path video = unfinished / "confidence.mkv";
    fs::resize_file(video, fs::file_size(video) - 10);
    next = 7;
  }
  EXPECT_EQ(run(kFrames + 1, Existing::kContinue).front(), next);
  expect_whole();
}

TEST_P(Interrupted, AfterTheLastPairIsFinished) {
  const Progress progress = [](std::int64_t count, std::int64_t, double) {
    return count < kFrames;
  };
  EXPECT_THROW(process(work_, whole(work_), folder_ / "piece", progress), UserError);
  EXPECT_TRUE(run(kFrames + 1, Existing::kContinue).empty());
  expect_whole();
}

INSTANTIATE_TEST_SUITE_P(Formats, Interrupted,
                         ::testing::Values(MapFormat::kMatroska, MapFormat::kPng),
                         [](const auto& info) {
                           return info.param == MapFormat::kPng ? "Png" : "Matroska";
                         });

class Truncated : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

// Feature: interruptions and damaged files
TEST_P(Truncated, GivesWhatCanBeRead) {
  const auto& [extension, muxer] = GetParam();
  const TemporaryFolder folder;
  const std::string coding = std::string(kBFrames) + " ! " + muxer;
  const fs::path left = folder / (std::string("left.") + extension);
  const fs::path right = folder / (std::string("right.") + extension);
  const fs::path cut = folder / (std::string("cut.") + extension);
  write_view(left, View::kLeft, coding, constant_times(40));
  write_view(right, View::kRight, coding, constant_times(40));
  testing::write_beginning(right, cut, 0.6);
  const Work work = work_of(left, cut, {});
  // A transport stream has no end that could be missing.
  if (std::string(extension) != "ts") {
    EXPECT_NE(work.right.damage, "");
  }
  ASSERT_GT(work.pairs.pairs.size(), 10u);
  ASSERT_LT(work.pairs.pairs.size(), 40u);
  const PieceReport report = process(work, whole(work), folder / "cut", kNoProgress);
  EXPECT_EQ(report.frames.size(), work.pairs.pairs.size());
  // What is there is as in the whole recording, but for the last frames.
  const Work uncut = work_of(left, right, {});
  const PieceReport all = process(uncut, whole(uncut), folder / "whole", kNoProgress);
  for (std::size_t i = 0; i + 5 < report.frames.size(); ++i) {
    EXPECT_EQ(report.frames[i].median_disparity, all.frames[i].median_disparity) << i;
    EXPECT_EQ(report.frames[i].density, all.frames[i].density) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Truncated,
                         ::testing::Values(std::pair{"mkv", "matroskamux"},
                                           std::pair{"mp4", "mp4mux faststart=true"},
                                           std::pair{"ts", "mpegtsmux"}),
                         [](const auto& info) { return std::string(info.param.first); });

// Replaced after they were indexed.
TEST(DamagedPiece, OfFilesThatAreNoVideosSaysWhyAtOnce) {
  const TemporaryFolder folder;
  const fs::path whole = folder / "whole.mp4";
  write_view(whole, View::kLeft, std::string(kBFrames) + " ! mp4mux", constant_times(10));
  const FrameIndex index = index_frames({whole, {}, {}}, 0);
  testing::write_text(folder / "empty.mp4", "");
  testing::write_text(folder / "text.mkv", "This is no video.\n");
  testing::write_text(folder / "noise.ts", std::string(100'000, 'x'));
  testing::write_text(folder / "head.mkv", "\x1a\x45\xdf\xa3" + std::string(5'000, 'x'));
  testing::write_beginning(whole, folder / "part.mp4", 0.5);
  for (const char* name :
       {"empty.mp4", "text.mkv", "noise.ts", "head.mkv", "part.mp4", "none.mp4"}) {
    const auto start = std::chrono::steady_clock::now();
    const auto reader = open_video(folder / name, index);
    EXPECT_EQ(reader->read(3).state, FrameState::kEnd) << name;
    EXPECT_NE(reader->problem(), "") << name;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60)) << name;
  }
}

TEST(DamagedPiece, EndsWhereItsFramesEndAndSaysWhy) {
  const TemporaryFolder folder;
  const std::string coding = kBFrames + std::string(" ! matroskamux");
  write_view(folder / "left.mkv", View::kLeft, coding, constant_times(60));
  write_view(folder / "right.mkv", View::kRight, coding, constant_times(60));
  const Work work = work_of(folder / "left.mkv", folder / "right.mkv", {});
  // Damaged after it was indexed.
  fs::resize_file(folder / "right.mkv", fs::file_size(folder / "right.mkv") / 2);
  const PieceReport report = process(work, whole(work), folder / "piece", kNoProgress);
  EXPECT_GT(report.frames.size(), 5u);
  EXPECT_LT(report.frames.size(), 50u);
  EXPECT_NE(report.damage.find("of the right view"), std::string::npos) << report.damage;
  EXPECT_NE(report.damage.find("cannot be decoded"), std::string::npos) << report.damage;
}

// A recording whose decoders report errors from its middle on.
class DamagedRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string coding = "jpegenc ! qtmux";  // frames that do not refer to others
    const fs::path right = folder_ / "right.mov";
    write_view(folder_ / "left.mov", View::kLeft, coding, constant_times(kAll));
    write_view(right, View::kRight, coding, constant_times(kAll));
    work_ = work_of(folder_ / "left.mov", right, {});
    std::string bytes = testing::bytes_of(right);
    for (std::size_t i = bytes.size() / 3; i < 2 * bytes.size() / 3; i += 997) bytes[i] ^= 0x55;
    testing::write_text(right, bytes);
    uncut_ = process(work_, whole(work_), folder_ / "whole", kNoProgress);
    ASSERT_THAT(uncut_.damage, HasSubstr(kDecoded));
    ASSERT_GT(uncut_.frames.size(), 10U);
  }

  static constexpr int kAll = 90;
  static constexpr const char* kDecoded = "frames of the right view cannot be decoded without";
  TemporaryFolder folder_;
  Work work_;
  PieceReport uncut_;
};

TEST_F(DamagedRecording, KeepsItsDamageOverInterruptions) {
  for (const std::int64_t stop : {kAll / 3, kAll / 2, 2 * kAll / 3, kAll - 1}) {
    const Progress progress = [stop](std::int64_t count, std::int64_t, double) {
      return count < stop;
    };
    EXPECT_THROW(process(work_, whole(work_), folder_ / "piece", progress, Existing::kContinue),
                 UserError);
  }
  const PieceReport report =
      process(work_, whole(work_), folder_ / "piece", kNoProgress, Existing::kContinue);
  const std::string decoded = uncut_.damage.substr(uncut_.damage.find("; ") + 2);
  EXPECT_THAT(report.damage, EndsWith("; " + decoded));
  EXPECT_THAT(report.damage, HasSubstr(" pairs could not be decoded before the run was"));
  EXPECT_EQ(report.frames.size(), uncut_.frames.size());
}

TEST_F(DamagedRecording, KeepsTheDamageOfAllPieces) {
  const std::vector<Range> ranges{{0, 20}, {20, 25}, {45, kAll - 45}};
  std::vector<fs::path> folders;
  std::string expected;
  int damaged = 0;
  for (const Range& range : ranges) {
    folders.push_back(folder_ / std::to_string(range.first));
    const std::string damage = process(work_, range, folders.back(), kNoProgress).damage;
    if (damage.empty()) continue;
    expected += (expected.empty() ? "" : "; ") + damage;
    ++damaged;
  }
  EXPECT_GE(damaged, 2);
  EXPECT_EQ(join(work_, ranges, folders, folder_ / "joined").damage, expected);
}

TEST(DamagedPiece, WithoutAnyFrameHasNoFile) {
  const TemporaryFolder folder;
  const std::string coding = kBFrames + std::string(" ! matroskamux");
  write_view(folder / "left.mkv", View::kLeft, coding, constant_times(100));
  write_view(folder / "right.mkv", View::kRight, coding, constant_times(100));
  const Work work = work_of(folder / "left.mkv", folder / "right.mkv", {});
  fs::resize_file(folder / "right.mkv", fs::file_size(folder / "right.mkv") / 2);
  const PieceReport report = process(work, {90, 10}, folder / "piece", kNoProgress);
  EXPECT_TRUE(report.frames.empty());
  EXPECT_TRUE(report.files.empty());
  EXPECT_NE(report.damage, "");
  EXPECT_TRUE(fs::exists(folder / "piece" / kPieceFile));
}

}  // namespace
}  // namespace mtstereo::run::unfinished_test

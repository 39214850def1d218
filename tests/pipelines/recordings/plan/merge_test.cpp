// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "fake_pieces.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/archive.hpp"
#include "recordings/plan/task.hpp"

namespace mtstereo::run::merge_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class Merge : public ::testing::Test {
 protected:
  Merge() : files_(folder_.path()) {
    write_fake_plan(folder_.path());
    options_.functions = fake_functions();
    options_.functions.join = [this](const Work& work, const std::vector<Range>& ranges,
                                     const std::vector<fs::path>& pieces, const fs::path& folder) {
      ++joins_;
      return fake_join(work, ranges, pieces, folder);
    };
  }

  void do_tasks(std::initializer_list<std::size_t> numbers) const {
    for (const std::size_t number : numbers) {
      do_task(folder_.path(), number, TaskOptions{fake_functions(), 0}, nullptr);
    }
  }
  MergeResult merge_all() const { return merge(folder_.path(), options_); }
  std::string joined(const std::string& name) const {
    return read_text(files_.recording(name) / kFakeFile);
  }
  nlohmann::json summary() const { return nlohmann::json::parse(read_text(files_.summary())); }

  TemporaryFolder folder_;
  PlanFolder files_;
  MergeOptions options_;
  std::atomic<int> joins_{0};
};

// Feature: archives on a cluster
TEST_F(Merge, GivesTheBytesOfAnUncutRun) {
  do_tasks({0, 1, 2, 3, 4});
  const MergeResult result = merge_all();
  EXPECT_THAT(result.missing, IsEmpty());
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.joined, 2U);
  EXPECT_EQ(joined("a"), uncut("a", 10));
  EXPECT_EQ(joined("b"), uncut("b", 7));
  EXPECT_TRUE(fs::exists(files_.recording("a") / kRunFile));
  EXPECT_FALSE(fs::exists(files_.unfinished()));
}

TEST_F(Merge, LinksARecordingOfOneTask) {
  Plan plan;
  plan.recordings = {"b"};
  plan.tasks = divide("b", 7, 7);
  write_plan_of({fake_work("b", 7)}, plan, folder_.path());
  do_tasks({0});
  EXPECT_EQ(merge_all().joined, 1U);
  EXPECT_EQ(joins_, 0);
  EXPECT_EQ(joined("b"), uncut("b", 7));
  EXPECT_TRUE(fs::equivalent(files_.piece(0) / kFakeFile, files_.recording("b") / kFakeFile));
  options_.remove_pieces = true;
  EXPECT_EQ(merge_all().sum.pairs, 7);
  EXPECT_EQ(joined("b"), uncut("b", 7));
}

TEST_F(Merge, SumsTheFigures) {
  do_tasks({0, 1, 2, 3, 4});
  const MergeResult result = merge_all();
  EXPECT_EQ(result.sum.pairs, 17);
  EXPECT_DOUBLE_EQ(result.sum.density, 0.5);
  EXPECT_DOUBLE_EQ(result.sum.median_disparity, (45.0 + 21.0) / 17);  // 0 to 9 and 0 to 6
  const nlohmann::json text = summary();
  EXPECT_EQ(text.at("pairs"), 17);
  EXPECT_EQ(text.at("recordings").at(0).at("pairs"), 10);
  EXPECT_DOUBLE_EQ(text.at("recordings").at(0).at("median_disparity"), 4.5);
  EXPECT_THAT(text.at("missing_tasks"), IsEmpty());
}

TEST_F(Merge, ReportsMissingTasksAndJoinsTheOtherRecordings) {
  do_tasks({0, 2, 3, 4});
  const MergeResult result = merge_all();
  EXPECT_THAT(result.missing, ElementsAre(1));
  EXPECT_FALSE(fs::exists(files_.recording("a")));
  EXPECT_EQ(joined("b"), uncut("b", 7));
  EXPECT_THAT(summary().at("missing_tasks"), ElementsAre(1));
  EXPECT_EQ(summary().at("recordings").at(0).at("whole"), false);
}

TEST_F(Merge, RemovesADamagedPieceAndReportsItsTask) {
  do_tasks({0, 1, 2, 3, 4});
  std::string text = read_text(files_.piece(1) / kFakeFile);
  text[0] ^= 1;
  write_text(files_.piece(1) / kFakeFile, text);
  const MergeResult result = merge_all();
  EXPECT_THAT(result.missing, ElementsAre(1));
  ASSERT_THAT(result.problems, SizeIs(1));
  EXPECT_EQ(result.problems[0].input, files_.piece(1).string());
  EXPECT_THAT(result.problems[0].reason, HasSubstr("disparity.txt has changed"));
  EXPECT_THAT(missing_tasks(folder_.path(), read_plan(folder_.path())), ElementsAre(1));
  do_tasks({1});
  EXPECT_THAT(merge_all().problems, IsEmpty());
  EXPECT_EQ(joined("a"), uncut("a", 10));
}

TEST_F(Merge, NamesRecordingsOfWhichNotAllCouldBeRead) {
  TaskOptions damaged{fake_functions(), 0};
  damaged.functions.process = [](const Work& work, Range range, const fs::path& folder,
                                 const Progress& progress) {
    PieceReport report = fake_process(work, range, folder, progress);
    report.frames.erase(report.frames.begin() + 1);
    report.damage = "1 frame after pair " + std::to_string(range.first) + " cannot be decoded";
    write_piece(report, range, folder / kPieceFile);
    return report;
  };
  Plan plan = read_plan(folder_.path());
  plan.damaged = {{"/archive/b.mkv", "the file is truncated after 12.3 s"}};
  write_plan(plan, folder_.path());
  do_tasks({2, 3, 4});
  for (const std::size_t task : {0, 1}) {
    EXPECT_EQ(do_task(folder_.path(), task, damaged, nullptr), TaskResult::kDone);
  }
  const MergeResult result = merge_all();
  const std::string kDamage =
      "1 frame after pair 0 cannot be decoded; 1 frame after pair 4 cannot be decoded";
  EXPECT_THAT(result.missing, IsEmpty());
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.joined, 2U);
  EXPECT_EQ(result.sum.pairs, 15);
  ASSERT_THAT(result.damaged, SizeIs(1));
  EXPECT_EQ(result.damaged[0].input, "a");
  EXPECT_EQ(result.damaged[0].reason, kDamage);
  const nlohmann::json text = summary();
  EXPECT_EQ(text.at("recordings").at(0).at("damage"), kDamage);
  EXPECT_EQ(text.at("recordings").at(1).at("damage"), "");
  ASSERT_THAT(text.at("damaged"), SizeIs(2));
  EXPECT_EQ(text.at("damaged").at(0).at("input"), "/archive/b.mkv");
  EXPECT_EQ(text.at("damaged").at(1).at("input"), "a");
  // A second merge states the same.
  EXPECT_THAT(merge_all().damaged, SizeIs(1));
}

TEST_F(Merge, JoinsNothingTwice) {
  do_tasks({0, 1, 2, 3, 4});
  merge_all();
  EXPECT_EQ(merge_all().sum.pairs, 17);
  EXPECT_EQ(joins_, 2);
}

TEST_F(Merge, JoinsADamagedRecordingAgain) {
  do_tasks({0, 1, 2, 3, 4});
  merge_all();
  fs::resize_file(files_.recording("a") / kFakeFile, 3);
  merge_all();
  EXPECT_EQ(joins_, 3);
  EXPECT_EQ(joined("a"), uncut("a", 10));
}

TEST_F(Merge, RemovesPiecesAndTheirTasksStayDone) {
  do_tasks({0, 1, 2, 3, 4});
  options_.remove_pieces = true;
  merge_all();
  EXPECT_THAT(missing_tasks(folder_.path(), read_plan(folder_.path())), IsEmpty());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_FALSE(fs::exists(files_.piece(i)));
  EXPECT_EQ(do_task(folder_.path(), 0, TaskOptions{fake_functions(), 0}, nullptr),
            TaskResult::kWasDone);
  EXPECT_EQ(merge_all().sum.pairs, 17);
  EXPECT_EQ(joins_, 2);
}

TEST_F(Merge, ReportsARecordingThatCannotBeJoinedAndJoinsTheOthers) {
  do_tasks({0, 1, 2, 3, 4});
  options_.functions.join = [](const Work& work, const std::vector<Range>& ranges,
                               const std::vector<fs::path>& pieces, const fs::path& folder) {
    write_text(folder / kFakeFile, "half");
    if (work.recording.name == "a") throw UserError("the disk is full");
    return fake_join(work, ranges, pieces, folder);
  };
  const MergeResult result = merge_all();
  EXPECT_THAT(result.missing, IsEmpty());
  ASSERT_THAT(result.problems, SizeIs(1));
  EXPECT_EQ(result.problems[0].input, "a");
  EXPECT_EQ(result.problems[0].reason, "the disk is full");
  EXPECT_FALSE(fs::exists(files_.recording("a")));
  EXPECT_EQ(joined("b"), uncut("b", 7));
  EXPECT_EQ(summary().at("problems").at(0).at("reason"), "the disk is full");
}

TEST_F(Merge, MayRunTwiceAtTheSameTime) {
  do_tasks({0, 1, 2, 3, 4});
  for (int round = 0; round < 10; ++round) {
    fs::remove_all(files_.path() / "recordings");
    std::vector<std::thread> threads;
    std::atomic<std::size_t> whole{0};
    for (int i = 0; i < 3; ++i) threads.emplace_back([&] { whole += merge_all().joined; });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(whole, 6U);
    ASSERT_EQ(joined("a"), uncut("a", 10));
    ASSERT_EQ(joined("b"), uncut("b", 7));
  }
}

TEST_F(Merge, WithSeveralJobsGivesTheSameBytes) {
  do_tasks({0, 1, 2, 3, 4});
  options_.jobs = 4;
  EXPECT_EQ(merge_all().joined, 2U);
  EXPECT_EQ(joined("a"), uncut("a", 10));
  EXPECT_EQ(joined("b"), uncut("b", 7));
}

TEST_F(Merge, WithoutAPlanIsAnError) {
  fs::remove(files_.plan());
  EXPECT_THROW(merge_all(), UserError);
}

}  // namespace
}  // namespace mtstereo::run::merge_test

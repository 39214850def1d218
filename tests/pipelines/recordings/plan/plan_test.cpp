// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "fake_pieces.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/archive.hpp"
#include "recordings/plan/plan_contents.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::plan_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::vector<std::int64_t> counts(const std::vector<Task>& tasks) {
  std::vector<std::int64_t> result;
  for (const Task& task : tasks) result.push_back(task.range.count);
  return result;
}

TEST(Divide, CoversARecordingWithoutAGap) {
  for (std::int64_t pairs = 0; pairs < 60; ++pairs) {
    for (std::int64_t most = 1; most < 20; ++most) {
      std::int64_t next = 0;
      for (const Task& task : divide("a", pairs, most)) {
        EXPECT_EQ(task.recording, "a");
        ASSERT_EQ(task.range.first, next) << pairs << " in " << most;
        ASSERT_GE(task.range.count, 1);
        ASSERT_LE(task.range.count, most);
        next += task.range.count;
      }
      EXPECT_EQ(next, pairs);
    }
  }
}

TEST(Divide, MakesTasksOfEqualLength) {
  EXPECT_THAT(counts(divide("a", 10, 4)), ElementsAre(4, 3, 3));
  EXPECT_THAT(counts(divide("a", 8, 4)), ElementsAre(4, 4));
  EXPECT_THAT(counts(divide("a", 5, 4)), ElementsAre(3, 2));
  EXPECT_THAT(counts(divide("a", 0, 4)), IsEmpty());
}

TEST(Divide, RefusesTasksWithoutPairs) {
  EXPECT_THROW(divide("a", 10, 0), UserError);
  EXPECT_THROW(divide("a", 10, -1), UserError);
  EXPECT_THROW(divide("a", -1, 10), UserError);
}

TEST(PlanFile, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  Plan plan;
  plan.recordings = {"street 1",
                     "stra\xc3\x9f"
                     "e"};
  plan.tasks = {{"street 1", {0, 3}},
                {"street 1", {3, 2}},
                {"stra\xc3\x9f"
                 "e",
                 {0, 1}}};
  plan.problems = {{"/archive/x.mkv", "it has no frame"}};
  plan.damaged = {{"/archive/y.mkv", "the file is truncated after 12.3 s"}};
  write_plan(plan, folder.path());
  const Plan found = read_plan(folder.path());
  EXPECT_EQ(found.recordings, plan.recordings);
  ASSERT_THAT(found.tasks, SizeIs(3));
  EXPECT_EQ(found.tasks[1].recording, "street 1");
  EXPECT_EQ(found.tasks[1].range.first, 3);
  EXPECT_EQ(found.tasks[1].range.count, 2);
  ASSERT_THAT(found.problems, SizeIs(1));
  EXPECT_EQ(found.problems[0].reason, "it has no frame");
  ASSERT_THAT(found.damaged, SizeIs(1));
  EXPECT_EQ(found.damaged[0].input, "/archive/y.mkv");
}

TEST(PlanFile, ThatIsMissingIsReportedWithItsName) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { read_plan(folder.path()); }),
              HasSubstr((folder.path() / "plan.json").string() + ": there is no plan"));
}

TEST(PlanFile, ThatIsDamagedIsRefused) {
  const TemporaryFolder folder;
  write_fake_plan(folder.path());
  const fs::path file = PlanFolder(folder.path()).plan();
  const std::string text = read_text(file);
  for (const std::size_t length : {std::size_t{0}, text.size() / 3, text.size() - 4}) {
    write_text(file, text.substr(0, length));
    EXPECT_THAT(error_of([&] { read_plan(folder.path()); }), HasSubstr("is damaged"));
  }
  write_text(file, R"({"version": 2})");
  EXPECT_THAT(error_of([&] { read_plan(folder.path()); }), HasSubstr("another version"));
  write_text(file, "[]");
  EXPECT_THAT(error_of([&] { read_plan(folder.path()); }), HasSubstr("is damaged"));
}

TEST(PlanFile, OfAnotherVersionOfTheProgramIsRefused) {
  const TemporaryFolder folder;
  write_fake_plan(folder.path());
  const fs::path file = PlanFolder(folder.path()).plan();
  std::string text = read_text(file);
  const std::string start = "\"program\": \"";
  text.insert(text.find(start) + start.size(), "1");
  write_text(file, text);
  EXPECT_THAT(error_of([&] { read_plan(folder.path()); }),
              AllOf(HasSubstr("was written by mtstereo-run 1"), HasSubstr("--overwrite")));
}

TEST(PlanFile, WhoseTasksDoNotCoverARecordingIsRefused) {
  const TemporaryFolder folder;
  const auto error = [&](std::vector<Task> tasks) {
    return error_of([&] { write_plan({{"a"}, std::move(tasks), {}}, folder.path()); });
  };
  EXPECT_THAT(error({}), HasSubstr("'a' has no task"));
  EXPECT_THAT(error({{"a", {1, 4}}}), HasSubstr("do not cover"));
  EXPECT_THAT(error({{"a", {0, 2}}, {"a", {3, 2}}}), HasSubstr("do not cover"));
  EXPECT_THAT(error({{"a", {0, 0}}}), HasSubstr("do not cover"));
  EXPECT_THAT(error({{"b", {0, 5}}}), HasSubstr("not in order"));
}

TEST(PlanFile, RefusesNamesThatLeaveItsFolder) {
  const TemporaryFolder folder;
  for (const std::string name : {"", ".", "..", "../x", "x/y", "/x"}) {
    EXPECT_THAT(error_of([&] {
                  write_plan({{name}, {{name, {0, 5}}}, {}}, folder.path());
                }),
                HasSubstr("cannot be the name"));
  }
  EXPECT_THAT(error_of([&] {
                write_plan({{"a", "a"}, {{"a", {0, 5}}}, {}}, folder.path());
              }),
              HasSubstr("two recordings"));
}

TEST(PlanFile, InAFolderThatCannotBeWrittenIsReported) {
  EXPECT_THROW(write_plan({{"a"}, {{"a", {0, 5}}}, {}}, "/proc/no/such/folder"), UserError);
}

class Archive : public ::testing::Test {
 protected:
  Archive() {
    options_.folder = folder_.path();
    options_.jobs = 2;
    options_.settings = "settings";
    options_.prepare = [this](const Recording& recording) {
      ++prepared_;
      if (recording.name == "broken") throw UserError("it has no frame");
      Work work = fake_work(recording.name, recording.name == "empty" ? 0 : 1000);
      work.recording = recording;
      return work;
    };
  }

  static Recording recording(const std::string& name) {
    Recording result;
    result.name = name;
    result.left.video = name + ".mkv";
    return result;
  }

  // A recording whose left video is a file in `folder`.
  static Recording recording_of_file(const fs::path& folder, const std::string& name) {
    Recording result = recording(name);
    result.left.video = folder / (name + ".mkv");
    write_text(result.left.video, "video");
    return result;
  }

  TemporaryFolder folder_;
  ArchiveOptions options_;
  std::atomic<int> prepared_{0};
};

TEST_F(Archive, LeavesOutWhatCannotBePrepared) {
  options_.pairs_per_task = 400;
  plan_archive({recording("a"), recording("broken"), recording("empty"), recording("z")},
               {{"/archive/x", "no calibration"}}, options_);
  const Plan plan = read_plan(folder_.path());
  EXPECT_THAT(plan.recordings, ElementsAre("a", "z"));
  EXPECT_THAT(counts(plan.tasks), ElementsAre(334, 333, 333, 334, 333, 333));
  ASSERT_THAT(plan.problems, SizeIs(3));
  EXPECT_EQ(plan.problems[0].input, "/archive/x");
  EXPECT_THAT(plan.problems[1].input, "broken.mkv");
  EXPECT_EQ(plan.problems[1].reason, "it has no frame");
  EXPECT_THAT(plan.problems[2].reason, HasSubstr("belong together"));
}

TEST_F(Archive, WithoutAnyRecordingIsAnError) {
  EXPECT_THAT(error_of([&] { plan_archive({recording("broken")}, {}, options_); }),
              HasSubstr("broken.mkv: it has no frame"));
  EXPECT_THAT(error_of([&] { plan_archive({}, {}, options_); }),
              HasSubstr("there is no recording"));
  EXPECT_FALSE(fs::exists(folder_.path() / "plan.json"));
}

TEST_F(Archive, RefusesNamesThatLeaveItsFolderBeforeItWritesAnything) {
  EXPECT_THAT(error_of([&] {
                plan_archive({recording("a"), recording("../b")}, {}, options_);
              }),
              HasSubstr("cannot be the name"));
  EXPECT_THAT(error_of([&] {
                plan_archive({recording("a"), recording("a")}, {}, options_);
              }),
              HasSubstr("two recordings"));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Archive, DividesForTheNumberOfProcessesButNotIntoTinyTasks) {
  options_.least_tasks = 4;
  EXPECT_THAT(counts(plan_archive({recording("a")}, {}, options_).tasks),
              ElementsAre(250, 250, 250, 250));
  options_.least_tasks = 1000;
  EXPECT_THAT(plan_archive({recording("a")}, {}, options_).tasks, SizeIs(10));
}

TEST_F(Archive, ThatCannotBeWrittenIsAnErrorOfTheFolder) {
  fs::create_directories(PlanFolder(folder_.path()).work("b") / "x");
  EXPECT_THAT(error_of([&] {
                plan_archive({recording("a"), recording("b")}, {}, options_);
              }),
              AllOf(HasSubstr("b.json: cannot be written: "), Not(HasSubstr("recording"))));
  EXPECT_FALSE(fs::exists(folder_.path() / "plan.json"));
}

TEST_F(Archive, DoesNotRepeatTheInputOfAProblem) {
  const Plan plan =
      plan_archive({recording("a")}, {{"/archive/x", "/archive/x: is damaged"}}, options_);
  ASSERT_THAT(plan.problems, SizeIs(1));
  EXPECT_EQ(plan.problems[0].reason, "is damaged");
}

TEST_F(Archive, NamesDamagedFiles) {
  options_.prepare = [](const Recording& recording) {
    Work work = fake_work(recording.name, 1000);
    work.recording = recording;
    if (recording.name == "b") {
      work.right.damage = "the file is truncated after 12.3 s";
      work.remarks = {"right view: " + work.right.damage, "The clocks differ."};
    }
    return work;
  };
  options_.progress = [](const PlannedRecording& planned) {
    if (planned.name == "b") {
      EXPECT_THAT(planned.remarks, ElementsAre("The clocks differ."));
    }
  };
  Recording damaged = recording("b");
  damaged.right.video = "/archive/right.mkv";
  plan_archive({recording("a"), damaged}, {}, options_);
  for (int i = 0; i < 2; ++i) {  // also if the work was kept
    const Plan plan = read_plan(folder_.path());
    EXPECT_THAT(plan.recordings, ElementsAre("a", "b"));
    EXPECT_THAT(plan.problems, IsEmpty());
    ASSERT_THAT(plan.damaged, SizeIs(1));
    EXPECT_EQ(plan.damaged[0].input, "/archive/right.mkv");
    EXPECT_EQ(plan.damaged[0].reason, "the file is truncated after 12.3 s");
    plan_archive({recording("a"), damaged}, {}, options_);
  }
}

TEST_F(Archive, KeepsWhatWasPreparedFromTheSame) {
  const TemporaryFolder files;
  const std::vector<Recording> recordings{recording_of_file(files.path(), "a"),
                                          recording_of_file(files.path(), "b")};
  const auto plan_again = [&] {
    prepared_ = 0;
    plan_archive(recordings, {}, options_);
    return prepared_.load();
  };
  EXPECT_EQ(plan_again(), 2);
  const std::string work = read_text(PlanFolder(folder_.path()).work("a"));
  EXPECT_EQ(plan_again(), 0);
  write_text(files.path() / "a.mkv", "longer video");
  EXPECT_EQ(plan_again(), 1);
  fs::last_write_time(files.path() / "b.mkv", fs::file_time_type::clock::now() - 1h);
  EXPECT_EQ(plan_again(), 1);
  write_text(PlanFolder(folder_.path()).work("a"), work.substr(0, work.size() / 2));
  EXPECT_EQ(plan_again(), 1);
  EXPECT_EQ(read_text(PlanFolder(folder_.path()).work("a")), work);
  options_.settings = "others";
  EXPECT_EQ(plan_again(), 2);
  EXPECT_EQ(plan_again(), 0);
}

TEST_F(Archive, IsComparedWithItsPlan) {
  const TemporaryFolder files;
  std::vector<Recording> recordings{recording_of_file(files.path(), "a"),
                                    recording_of_file(files.path(), "b")};
  const Plan plan = plan_archive(recordings, {}, options_);
  EXPECT_EQ(compare(plan, recordings, options_), PlanMatch::kSame);
  recordings.push_back(recording_of_file(files.path(), "c"));
  EXPECT_EQ(compare(plan, recordings, options_), PlanMatch::kGrown);
  write_text(files.path() / "b.mkv", "longer video");
  EXPECT_EQ(compare(plan, recordings, options_), PlanMatch::kOther);
  EXPECT_EQ(compare(plan, {recordings.front()}, options_), PlanMatch::kOther);
  options_.settings = "others";
  EXPECT_EQ(compare(plan, recordings, options_), PlanMatch::kOther);
}

TEST_F(Archive, IsRemovedWithItsResultsButNothingElse) {
  plan_archive({recording("a")}, {}, options_);
  fs::create_directories(PlanFolder(folder_.path()).piece(0));
  write_text(folder_.path() / "notes.txt", "mine");
  remove_plan(folder_.path());
  EXPECT_THAT(error_of([&] { read_plan(folder_.path()); }), HasSubstr("there is no plan"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
  EXPECT_EQ(read_text(folder_.path() / "notes.txt"), "mine");
}

TEST_F(Archive, HasAbsolutePaths) {
  Recording relative = recording("a");
  relative.calibration = "rig.yml#wide";
  plan_archive({relative}, {}, options_);
  const Recording found = read_work(PlanFolder(folder_.path()).work("a")).recording;
  EXPECT_EQ(found.left.video, fs::current_path() / "a.mkv");
  EXPECT_EQ(found.calibration, (fs::current_path() / "rig.yml").string() + "#wide");
  relative.calibration = "left.yml,right.yml";
  EXPECT_EQ(with_absolute_paths(relative).calibration,
            (fs::current_path() / "left.yml").string() + "," +
                (fs::current_path() / "right.yml").string());
  relative.calibration = "/rig.yml";
  EXPECT_EQ(with_absolute_paths(relative).calibration, "/rig.yml");
}

}  // namespace
}  // namespace mtstereo::run::plan_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/task.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "fake_pieces.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/work_key.hpp"
#include "support/error_of.hpp"

namespace mtstereo::run::task_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Tasks : public ::testing::Test {
 protected:
  Tasks() : files_(folder_.path()) {
    write_fake_plan(folder_.path());
    options_.functions = fake_functions();
    options_.functions.process = [this](const Work& work, Range range, const fs::path& folder,
                                        const Progress& progress) {
      ++calls_;
      return fake_process(work, range, folder, progress);
    };
  }

  TaskResult do_one(std::size_t number) {
    return do_task(folder_.path(), number, options_, nullptr);
  }
  void do_all() {
    for (std::size_t i = 0; i < 5; ++i) do_one(i);
  }
  std::vector<std::size_t> missing() const {
    return missing_tasks(folder_.path(), read_plan(folder_.path()));
  }
  std::string error_of(std::size_t number) {
    return test::error_of<UserError>([&] { do_one(number); });
  }
  fs::path fake_file(std::size_t number) const { return files_.piece(number) / kFakeFile; }
  bool nothing_is_unfinished() const {
    return !fs::exists(files_.unfinished()) || fs::is_empty(files_.unfinished());
  }

  TemporaryFolder folder_;
  PlanFolder files_;
  TaskOptions options_;
  std::atomic<int> calls_{0};
};

TEST_F(Tasks, AreDoneOnce) {
  EXPECT_THAT(missing(), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(do_one(1), TaskResult::kDone);
  EXPECT_EQ(do_one(1), TaskResult::kWasDone);
  EXPECT_EQ(calls_, 1);
  EXPECT_THAT(missing(), ElementsAre(0, 2, 3, 4));
  EXPECT_EQ(read_text(fake_file(1)), "a 4: 4 11\na 5: 5 12\na 6: 6 13\n");
  EXPECT_TRUE(nothing_is_unfinished());
}

TEST_F(Tasks, OutsideOfThePlanAreRefused) {
  EXPECT_THAT(error_of(5), HasSubstr("there is no task 5: the plan has 5 tasks, numbered from 0"));
  EXPECT_EQ(calls_, 0);
}

TEST_F(Tasks, TakeTheThreadsOfTheirProcess) {
  int threads = -1;
  options_.functions.process = [&](const Work& work, Range range, const fs::path& folder,
                                   const Progress& progress) {
    threads = work.options.threads;
    return fake_process(work, range, folder, progress);
  };
  do_one(0);
  EXPECT_EQ(threads, 0);
  options_.threads = 3;
  do_one(1);
  EXPECT_EQ(threads, 3);
}

TEST_F(Tasks, WhosePieceIsTruncatedAreDoneAgain) {
  do_all();
  const std::string text = read_text(fake_file(2));
  fs::resize_file(fake_file(2), 5);
  EXPECT_THAT(missing(), ElementsAre(2));
  EXPECT_EQ(do_one(2), TaskResult::kDone);
  EXPECT_EQ(read_text(fake_file(2)), text);
  EXPECT_THAT(missing(), IsEmpty());
}

TEST_F(Tasks, WhosePieceHasAChangedByteAreDoneAgain) {
  do_all();
  const std::string text = read_text(fake_file(2));
  std::string changed = text;
  changed[3] ^= 1;
  write_text(fake_file(2), changed);
  EXPECT_EQ(do_one(2), TaskResult::kDone);
  EXPECT_EQ(read_text(fake_file(2)), text);
}

TEST_F(Tasks, WhosePieceLacksAFileAreDoneAgain) {
  do_all();
  fs::remove(fake_file(0));
  fs::remove(files_.piece(3) / "whole.json");
  write_text(files_.piece(4) / "whole.json", "{\"version\": 1");
  EXPECT_THAT(missing(), ElementsAre(0, 3, 4));
  do_all();
  EXPECT_EQ(calls_, 8);
  EXPECT_THAT(missing(), IsEmpty());
}

TEST_F(Tasks, OfAnotherPlanDoNotCount) {
  do_all();
  Plan plan;
  plan.recordings = {"a"};
  plan.tasks = divide("a", 10, 4);
  Work work = fake_work("a", 10);
  work.pairs.pairs[5].right = 99;
  write_plan_of({work}, plan, folder_.path());
  EXPECT_THAT(missing(), ElementsAre(0, 1, 2));
  EXPECT_EQ(do_one(1), TaskResult::kDone);
  EXPECT_THAT(read_text(fake_file(1)), HasSubstr("a 5: 5 99"));
}

TEST_F(Tasks, OfAPlanWithOtherRangesDoNotCount) {
  do_all();
  Plan plan;
  plan.recordings = {"a"};
  plan.tasks = divide("a", 10, 5);
  write_plan_of({fake_work("a", 10)}, plan, folder_.path());
  EXPECT_THAT(missing(), ElementsAre(0, 1));
}

TEST_F(Tasks, ThatFailLeaveNothing) {
  options_.functions.process = [](const Work&, Range, const fs::path& folder,
                                  const Progress&) -> PieceReport {
    write_text(folder / kFakeFile, "half");
    throw UserError("left.mkv: cannot be read");
  };
  EXPECT_THAT(error_of(0), HasSubstr("task 0 (a): left.mkv: cannot be read"));
  EXPECT_FALSE(fs::exists(files_.piece(0)));
  EXPECT_TRUE(nothing_is_unfinished());
}

TEST_F(Tasks, ThatAreStoppedLeaveNothing) {
  EXPECT_THROW(do_task(folder_.path(), 0, options_,
                       [](std::int64_t done, std::int64_t, double) { return done < 2; }),
               UserError);
  EXPECT_FALSE(fs::exists(files_.piece(0)));
  EXPECT_TRUE(nothing_is_unfinished());
}

TEST_F(Tasks, AreShortOnlyIfTheInputIsDamaged) {
  std::string damage;
  options_.functions.process = [&](const Work& work, Range range, const fs::path& folder,
                                   const Progress& progress) {
    PieceReport report = fake_process(work, range, folder, progress);
    report.frames.pop_back();
    report.damage = damage;
    return report;
  };
  EXPECT_THAT(error_of(0), HasSubstr("stopped after 3 of 4 pairs"));
  damage = "the file is truncated after 12.3 s";
  EXPECT_EQ(do_one(0), TaskResult::kDone);
  EXPECT_EQ(read_figures(files_.piece(0)).pairs, 3);
  EXPECT_EQ(read_figures(files_.piece(0)).damage, damage);
}

TEST_F(Tasks, WhoseInputIsLostMeanwhileAreNoDamagedOnes) {
  Work work = read_work(files_.work("a"));
  const fs::path video = folder_.path() / "a.mkv";
  work.recording.left.video = video;
  write_text(video, "frames");
  write_work(work, files_.work("a"));
  write_key(work_key(work.recording, ""), files_.key("a"));
  options_.functions.process = [&](const Work& work, Range range, const fs::path& folder,
                                   const Progress& progress) {
    PieceReport report = fake_process(work, range, folder, progress);
    report.damage = "no frame can be read after 12.3 s";
    fs::remove(video);
    return report;
  };
  EXPECT_THAT(error_of(0), HasSubstr("a.mkv: is missing"));
  EXPECT_THAT(missing(), ElementsAre(0, 1, 2, 3, 4));
}

TEST_F(Tasks, WithPairsInAnotherOrderAreRefused) {
  options_.functions.process = [](const Work& work, Range range, const fs::path& folder,
                                  const Progress& progress) {
    PieceReport report = fake_process(work, range, folder, progress);
    std::swap(report.frames[1], report.frames[2]);
    return report;
  };
  EXPECT_THAT(error_of(0), HasSubstr("pair 1 was not processed in its order"));
}

TEST_F(Tasks, WithoutTheirWorkAreReported) {
  fs::remove(files_.work("a"));
  EXPECT_THAT(error_of(0), HasSubstr(files_.work("a").string()));
}

// Feature: archives on a cluster
TEST_F(Tasks, MayBeDoneBySeveralProcessesAtTheSameTime) {
  std::atomic<int> waiting{0};
  options_.functions.process = [&](const Work& work, Range range, const fs::path& folder,
                                   const Progress& progress) {
    PieceReport report = fake_process(work, range, folder, progress);
    ++waiting;
    while (waiting < 8) std::this_thread::yield();  // all of them publish now
    return report;
  };
  std::atomic<int> first{0};
  std::atomic<int> twice{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      const TaskResult result = do_one(0);
      first += result == TaskResult::kDone ? 1 : 0;
      twice += result == TaskResult::kDoneTwice ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(first, 1);
  EXPECT_EQ(twice, 7);
  EXPECT_THAT(missing(), ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(nothing_is_unfinished());
}

TEST_F(Tasks, MayReplaceADamagedPieceAtTheSameTime) {
  do_one(0);
  const std::string text = read_text(fake_file(0));
  for (int round = 0; round < 20; ++round) {
    fs::resize_file(fake_file(0), 1);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back([&] { do_one(0); });
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(read_text(fake_file(0)), text);
    ASSERT_TRUE(nothing_is_unfinished());
  }
}

// The recording is never whole: task 1 is missing.
TEST_F(Tasks, MayReplaceADamagedPieceWhileItIsMerged) {
  do_one(0);
  const std::string text = read_text(fake_file(0));
  for (int round = 0; round < 20; ++round) {
    fs::resize_file(fake_file(0), 1);
    std::vector<std::thread> threads;
    for (int i = 0; i < 2; ++i) threads.emplace_back([&] { do_one(0); });
    for (int i = 0; i < 2; ++i) {
      threads.emplace_back([&] { merge(folder_.path(), {fake_functions(), 1, false}); });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(read_text(fake_file(0)), text);
    ASSERT_THAT(missing(), ElementsAre(1, 2, 3, 4));
    ASSERT_TRUE(nothing_is_unfinished());
  }
}

TEST_F(Tasks, DoNotReplaceADamagedPieceWithAFileOfTheUser) {
  do_one(0);
  fs::resize_file(fake_file(0), 1);
  write_text(files_.piece(0) / "notes.txt", "mine");
  EXPECT_THAT(error_of(0), HasSubstr((files_.piece(0) / "notes.txt").string() + " is in the way"));
  EXPECT_EQ(read_text(files_.piece(0) / "notes.txt"), "mine");
  EXPECT_EQ(read_text(fake_file(0)).size(), 1U);
  EXPECT_TRUE(nothing_is_unfinished());
  fs::remove(files_.piece(0) / "notes.txt");
  EXPECT_EQ(do_one(0), TaskResult::kDone);
}

TEST_F(Tasks, ThatAreKilledDoNotCountAndAreDoneByTheNextProcess) {
  const pid_t child = fork();
  if (child == 0) {
    options_.functions.process = [](const Work& work, Range range, const fs::path& folder,
                                    const Progress& progress) {
      fake_process(work, range, folder, progress);
      raise(SIGKILL);
      return PieceReport{};
    };
    do_one(0);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(nothing_is_unfinished());
  EXPECT_THAT(missing(), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(do_one(0), TaskResult::kDone);
  EXPECT_THAT(missing(), ElementsAre(1, 2, 3, 4));
}

TEST_F(Tasks, AreDoneIfAnotherProcessMergedInTheMeantime) {
  options_.functions.process = [&](const Work& work, Range range, const fs::path& folder,
                                   const Progress& progress) {
    const PieceReport report = fake_process(work, range, folder, progress);
    TaskOptions other{fake_functions(), 0};
    for (std::size_t i = 0; i < 5; ++i) do_task(folder_.path(), i, other, nullptr);
    merge(folder_.path(), {fake_functions(), 1, true});
    return report;
  };
  EXPECT_EQ(do_one(0), TaskResult::kDoneTwice);
  EXPECT_EQ(read_text(files_.recording("a") / kFakeFile), uncut("a", 10));
}

}  // namespace
}  // namespace mtstereo::run::task_test

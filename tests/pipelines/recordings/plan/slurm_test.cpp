// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/slurm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_pieces.hpp"
#include "recordings/inputs/run_error.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/task.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Arguments = std::vector<std::string>;

TEST(ArrayText, HasRangesAndNumbers) {
  EXPECT_EQ(array_text({}), "");
  EXPECT_EQ(array_text({4}), "4");
  EXPECT_EQ(array_text({0, 1, 2, 3}), "0-3");
  EXPECT_EQ(array_text({0, 2, 3, 9}), "0,2-3,9");
}

TEST(Quoted, IsOneWordOfTheShell) {
  for (const std::string word : {"plain", "with space", "it's", "$(touch x)", "a\nb", "", "\\"}) {
    EXPECT_EQ(run_program({"/bin/sh", "-c", "printf %s " + quoted(word)}).output, word);
  }
}

TEST(RunProgram, ReturnsStatusAndOutput) {
  const ProgramResult result = run_program({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.output, "out\n");
  EXPECT_EQ(result.errors, "err\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}).status, 137);
  try {
    run_program({"mtstereo-there-is-no-such-program"});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(),
                 "mtstereo-there-is-no-such-program: is not installed, or not in PATH");
  }
}

// Slurm in place of a cluster: it answers, and notes what was submitted.
class FakeSlurm {
 public:
  ProgramResult operator()(const Arguments& arguments) {
    if (arguments[0] == "scontrol") return {0, config, ""};
    if (arguments[0] == "squeue") return {0, queue, ""};
    if (refusal.empty()) submitted.push_back(arguments);
    if (!refusal.empty()) return {1, "", refusal};
    return {0, std::to_string(100 + submitted.size()) + answer_end, ""};
  }

  std::string config = "Configuration data as of now\nMaxArraySize            = 1001\n";
  std::string queue, refusal;
  std::string answer_end = "\n";
  std::vector<Arguments> submitted;
};

class Slurm : public testing::Test {
 protected:
  Slurm() : files_(folder_.path()) {
    write_fake_plan(folder_.path());
    options_.program = "/opt/mt stereo/mtstereo-run";
    options_.run = [this](const Arguments& arguments) { return slurm_(arguments); };
  }

  Submission submit_all() const { return submit(folder_.path(), options_); }
  void do_tasks(std::initializer_list<std::size_t> numbers) const {
    for (const std::size_t number : numbers) {
      do_task(folder_.path(), number, TaskOptions{fake_functions(), 0}, nullptr);
    }
  }
  // A line of squeue for a job of this plan.
  std::string line(const std::string& suffix, const std::string& index, const std::string& number,
                   const std::string& state) const {
    return job_name(folder_.path()) + "-" + suffix + "|" + index + "|" + number + "|" + state +
           "\n";
  }
  std::string folder() const { return fs::canonical(folder_.path()).string(); }

  TemporaryFolder folder_;
  PlanFolder files_;
  FakeSlurm slurm_;
  SlurmOptions options_;
};

TEST_F(Slurm, ThatIsNotInstalledIsReportedWithWhatToDo) {
  options_.run = [](const Arguments& arguments) {
    return run_program({"mtstereo-no-" + arguments.front()});
  };
  try {
    submit_all();
    FAIL();
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("mtstereo-no-squeue: is not installed"),
                                    HasSubstr("'mtstereo-run task N'")));
  }
}

TEST_F(Slurm, GetsAnArrayAndAMergeAfterIt) {
  const Submission submission = submit_all();
  EXPECT_EQ(submission.tasks, 5U);
  EXPECT_EQ(submission.done, 0U);
  EXPECT_THAT(submission.arrays, ElementsAre("101"));
  EXPECT_EQ(submission.merge, "102");
  ASSERT_THAT(slurm_.submitted, SizeIs(2));
  EXPECT_THAT(slurm_.submitted[0],
              AllOf(Contains("--array=0-4"), Contains("--requeue"),
                    Contains("--job-name=" + job_name(folder_.path()) + "-0"),
                    Contains("--output=" + folder() + "/log/%x-%a.log"),
                    Contains("--wrap=exec '/opt/mt stereo/mtstereo-run' task --plan '" + folder() +
                             "' --first 0")));
  EXPECT_THAT(slurm_.submitted[1],
              AllOf(Contains("--dependency=afterany:101"),
                    Contains("--wrap=exec '/opt/mt stereo/mtstereo-run' merge --plan '" + folder() +
                             "' --jobs 1")));
  EXPECT_TRUE(fs::is_directory(files_.logs()));
}

TEST_F(Slurm, GetsOnlyWhatIsMissing) {
  do_tasks({0, 3});
  const Submission submission = submit_all();
  EXPECT_EQ(submission.tasks, 3U);
  EXPECT_EQ(submission.done, 2U);
  EXPECT_THAT(slurm_.submitted[0], Contains("--array=1-2,4"));
}

TEST_F(Slurm, GetsNothingThatIsQueuedOrRunning) {
  do_tasks({0});
  slurm_.queue = line("0", "1", "77", "R") + line("0", "2", "77", "PD") +
                 line("merge", "N/A", "78", "PD") + "other-0|3|9|R\n";
  const Submission submission = submit_all();
  EXPECT_EQ(submission.active, 2U);
  EXPECT_EQ(submission.tasks, 2U);
  EXPECT_THAT(slurm_.submitted[0], Contains("--array=3-4"));
  EXPECT_THAT(slurm_.submitted[1], Contains("--dependency=afterany:101:77"));
}

TEST_F(Slurm, GetsNothingWhileAllTasksAndAMergeAreQueued) {
  for (int i = 0; i < 5; ++i) slurm_.queue += line("0", std::to_string(i), "77", "PD");
  slurm_.queue += line("merge", "N/A", "78", "PD");
  const Submission submission = submit_all();
  EXPECT_EQ(submission.active, 5U);
  EXPECT_EQ(submission.merge, "");
  EXPECT_THAT(slurm_.submitted, IsEmpty());
}

TEST_F(Slurm, GetsAMergeIfItsMergeWasCancelled) {
  for (int i = 0; i < 5; ++i) slurm_.queue += line("0", std::to_string(i), "77", "R");
  EXPECT_EQ(submit_all().merge, "101");
  ASSERT_THAT(slurm_.submitted, SizeIs(1));
  EXPECT_THAT(slurm_.submitted[0], Contains("--dependency=afterany:77"));
}

TEST_F(Slurm, GetsOnlyTheMergeIfAllTasksAreDone) {
  do_tasks({0, 1, 2, 3, 4});
  EXPECT_EQ(submit_all().merge, "101");
  ASSERT_THAT(slurm_.submitted, SizeIs(1));
  EXPECT_THAT(slurm_.submitted[0], Not(Contains(HasSubstr("--dependency"))));
  merge(folder_.path(), {fake_functions(), 1, false});
  EXPECT_EQ(submit_all().merge, "");
  EXPECT_THAT(slurm_.submitted, SizeIs(1));
}

TEST_F(Slurm, GetsATaskAgainThatIsOnlyCompleting) {
  slurm_.queue = line("0", "0", "77", "CG") + line("0", "1", "77", "RQ");
  submit_all();
  EXPECT_THAT(slurm_.submitted[0], Contains("--array=0,2-4"));
}

TEST_F(Slurm, GetsArraysOfTheSizeThatItAccepts) {
  slurm_.config = "MaxArraySize = 2\n";
  slurm_.queue = line("2", "1", "77", "R");  // task 3
  const Submission submission = submit_all();
  EXPECT_THAT(submission.arrays, ElementsAre("101", "102", "103"));
  EXPECT_THAT(slurm_.submitted[0],
              AllOf(Contains("--array=0-1"), Contains(HasSubstr("--first 0"))));
  EXPECT_THAT(slurm_.submitted[1], AllOf(Contains("--array=0"), Contains(HasSubstr("--first 2"))));
  EXPECT_THAT(slurm_.submitted[2], AllOf(Contains("--array=0"), Contains(HasSubstr("--first 4"))));
  EXPECT_THAT(slurm_.submitted[3], Contains("--dependency=afterany:101:102:103:77"));
}

TEST_F(Slurm, GetsTheOptionsOfTheUser) {
  options_.limit = 8;
  options_.merge_jobs = 4;
  options_.remove_pieces = true;
  options_.options = {"--partition=long", "--cpus-per-task=4"};
  submit_all();
  EXPECT_THAT(slurm_.submitted[0], AllOf(Contains("--array=0-4%8"), Contains("--partition=long"),
                                         Contains("--cpus-per-task=4")));
  EXPECT_THAT(slurm_.submitted[1],
              AllOf(Contains(HasSubstr("--jobs 4 --remove-pieces")), Contains("--partition=long")));
}

TEST_F(Slurm, OfSeveralClustersIsUnderstood) {
  slurm_.answer_end = ";north\n";
  EXPECT_THAT(submit_all().arrays, ElementsAre("101"));
}

TEST_F(Slurm, IsQuotedIfItRefuses) {
  slurm_.refusal = "sbatch: error: invalid partition specified: long\n";
  try {
    submit_all();
    ADD_FAILURE() << "no error";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("invalid partition specified: long"));
  }
}

TEST_F(Slurm, WithoutArraysOrWithAnotherAnswerIsAnError) {
  slurm_.config = "MaxArraySize = 0\n";
  EXPECT_THROW(submit_all(), RunError);
  slurm_.config.clear();
  slurm_.answer_end = " is not a number\n";
  EXPECT_THROW(submit_all(), RunError);
}

TEST_F(Slurm, ThatIsNotInstalledIsAnError) {
  options_.run = [](const Arguments& arguments) {
    return run_program({"mtstereo-no-" + arguments[0]});
  };
  EXPECT_THROW(submit_all(), RunError);
}

TEST_F(Slurm, HasOneNameForAFolderHoweverItIsWritten) {
  EXPECT_EQ(job_name(folder_.path()), job_name(folder_.path() / "x" / ".."));
  EXPECT_NE(job_name(folder_.path()), job_name(folder_.path() / "x"));
}

}  // namespace
}  // namespace mtstereo::run

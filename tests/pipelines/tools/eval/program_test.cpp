// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval as a process: exit status, messages, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "mtstereo/parameters.hpp"
#include "support.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval::program_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::make_pair;
using ::testing::Not;
using testing::Outcome;
using testing::read_file;
using testing::run_eval;
using testing::write_file;
using testing::write_pair_folder;

class Program : public testing::TwoPairs {};

TEST_F(Program, EvaluatesAllPairsAndExitsWith0) {
  const Outcome run = run_eval({set(), "--json", folder_ / "out/r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "") << "no progress bar if stderr is no terminal";
  EXPECT_THAT(run.out, HasSubstr("mean of 2"));
  const json report = json::parse(read_file(folder_ / "out/r.json"));
  EXPECT_EQ(report["dataset"], "middlebury");
  ASSERT_EQ(report["pairs"].size(), 2U);
  EXPECT_EQ(report["pairs"][0]["max_disparity"], 32);
  EXPECT_LT(report["pairs"][0]["results"]["mtstereo"]["all"]["avgerr"], 1.0);
  EXPECT_GT(report["mean"]["mtstereo"]["density"], 5.0);
  EXPECT_TRUE(report["failures"].empty());
  // Without their options:
  EXPECT_THAT(run.out, Not(HasSubstr("equal density")));
  EXPECT_FALSE(report.contains("curve"));
}

TEST_F(Program, NamesCorruptFilesRunsOtherPairsAndExitsWith1) {
  const std::string pfm = read_file(folder_ / "set/A/disp0GT.pfm");
  write_file(folder_ / "set/A/disp0GT.pfm", pfm.substr(0, pfm.size() - 100));
  write_pair_folder(folder_ / "set/C", make_pair(200, 100, 5), 16);
  std::filesystem::remove(folder_ / "set/C/im1.png");
  const Outcome run = run_eval({set(), "--json", folder_ / "r.json"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("A/disp0GT.pfm: ends too early"));
  EXPECT_THAT(run.err, HasSubstr("C/im1.png: no such file"));
  EXPECT_THAT(run.out, HasSubstr("mean of 1"));
  const json report = this->report();
  EXPECT_EQ(report["pairs"].size(), 1U);
  EXPECT_EQ(report["failures"].size(), 2U);
}

TEST_F(Program, ExitsWith2IfThereIsNothingToDo) {
  EXPECT_EQ(run_eval({folder_ / "none"}).status, 2);
  EXPECT_THAT(run_eval({folder_ / "none"}).err, HasSubstr("none: no such folder"));
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_EQ(run_eval({folder_ / "empty"}).status, 2);
  EXPECT_EQ(run_eval({set(), "--dataset", "kitti2015"}).status, 2);
  const Outcome run = run_eval({set(), "--only", "nothing-like-this"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("nothing-like-this"));
}

TEST_F(Program, ExitsWith2AndNamesTheInvalidOption) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{}, "FOLDER"},
      {{set(), "--no-such-option"}, "--no-such-option"},
      {{set(), "--dataset", "kitti2013"}, "--dataset"},
      {{set(), "--compare", "sgbm,elas"}, "elas"},
      {{set(), "--repeat", "0"}, "--repeat"},
      {{set(), "--warm-up", "-1"}, "--warm-up"},
      {{set(), "--dmap", "meters"}, "--dmap"},
      {{set(), "--json"}, "--json"},
  };
  for (const auto& [arguments, name] : wrong) {
    const Outcome run = run_eval(arguments);
    EXPECT_EQ(run.status, 2) << name;
    EXPECT_THAT(run.err, HasSubstr(name));
  }
}

TEST_F(Program, NamesValueAndRangeOfAnInvalidParameter) {
  const Outcome run = run_eval({set(), "--max-disparity", "99999"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("max-disparity"));
  EXPECT_THAT(run.err, HasSubstr("99999"));
  EXPECT_THAT(run.err, HasSubstr(std::to_string(kLargestMaxDisparity)));
  EXPECT_THAT(run_eval({set(), "--mode", "denser"}).err, HasSubstr("semi-dense"));
}

TEST_F(Program, HasAnOptionForEveryParameter) {
  const Outcome help = run_eval({"--help"});
  EXPECT_EQ(help.status, 0);
  // Each is passed to the matcher: the defaults of another preset are accepted and reported.
  std::vector<std::string> arguments{set(), "--only", "B", "--json", folder_ / "r.json"};
  const auto value_of = [](Parameter id) -> std::string {
    if (id == Parameter::kMode) return "sparse";
    return parameter_default(id, Preset::kPaper, Mode::kSparse);
  };
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_THAT(help.out, HasSubstr(std::string("--") + info.name + " "));
    if (info.id == Parameter::kPreset) continue;  // the default stays: all are set one by one
    arguments.insert(arguments.end(), {std::string("--") + info.name, value_of(info.id)});
  }
  const Outcome run = run_eval(arguments);
  ASSERT_EQ(run.status, 0) << run.err;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.id == Parameter::kPreset) continue;
    EXPECT_EQ(report()["parameters"][info.name], value_of(info.id)) << info.name;
  }
}

TEST_F(Program, PrintsItsVersion) {
  const Outcome run = run_eval({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("."));
}

TEST_F(Program, LimitsTheRequestedRangeToTheWidth) {
  const Outcome run = run_eval({set(), "--only", "B", "--max-disparity", "1000"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("B: the search range is 200 px, not 1000 px"));
}

TEST_F(Program, RunsTheRivalsOnTheSamePairs) {
  const Outcome run = run_eval(
      {set(), "--compare", "sgbm,sgbm-3way,bm", "--threads", "1", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = this->report();
  for (const char* method : {"mtstereo", "sgbm", "sgbm-3way", "bm"}) {
    EXPECT_EQ(report["mean"][method]["pairs"], 2) << method;
    EXPECT_GT(report["mean"][method]["time_ratio"], 0.0) << method;
  }
  EXPECT_THAT(run.out, HasSubstr("times as long as mtstereo"));
}

TEST_F(Program, WritesDisparityMapsAndImages) {
  const Outcome pfm = run_eval({set(), "--only", "A", "--write-disparity", folder_ / "maps",
                                "--write-pictures", folder_ / "images"});
  ASSERT_EQ(pfm.status, 0) << pfm.err;
  EXPECT_EQ(read_pfm(folder_ / "maps/A.pfm").size(), cv::Size(240, 120));
  EXPECT_EQ(cv::imread(folder_ / "images/A.png").size(), cv::Size(480, 240));
}

TEST_F(Program, RejectsAnUnwritableFileBeforeTheEvaluation) {
  write_file(folder_ / "file", "");
  const Outcome run = run_eval({set(), "--json", folder_ / "file/r.json"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("file"));
  EXPECT_EQ(run.out, "");
}

TEST_F(Program, NeverOverwritesAnInput) {
  const std::string before = read_file(folder_ / "set/A/disp0GT.pfm");
  // The file may belong to a pair that is not requested.
  const Outcome run = run_eval({set(), "--only", "B", "--json", folder_ / "set/A/disp0GT.pfm"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("belongs to the data set"));
  EXPECT_EQ(read_file(folder_ / "set/A/disp0GT.pfm"), before);
}

TEST_F(Program, ReplacesOnlyItsOwnFiles) {
  write_file(folder_ / "a.json", "mine");
  const Outcome refused = run_eval({set(), "--only", "A", "--json", folder_ / "a.json"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("mtstereo-eval did not write it"));
  EXPECT_EQ(read_file(folder_ / "a.json"), "mine");
  write_file(folder_ / "a.json", "");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(run_eval({set(), "--only", "A", "--json", folder_ / "a.json"}).status, 0);
  }
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_EQ(run_eval({set(), "--only", "A", "--json", folder_ / "folder"}).status, 2);
  write_file(folder_ / "maps/A.pfm", "mine");
  const Outcome maps = run_eval({set(), "--write-disparity", folder_ / "maps"});
  EXPECT_EQ(maps.status, 1);
  EXPECT_THAT(maps.err, HasSubstr("A.pfm is in the way"));
  EXPECT_EQ(read_file(folder_ / "maps/A.pfm"), "mine");
  EXPECT_EQ(read_pfm(folder_ / "maps/B.pfm").size(), cv::Size(200, 100));
}

TEST_F(Program, ListsWithoutRunning) {
  const Outcome run = run_eval({set(), "--list"});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, HasSubstr("2 pairs of middlebury"));
  EXPECT_THAT(run.out, HasSubstr("A/im0.png"));
  EXPECT_THAT(run.out, Not(HasSubstr("mean")));
  EXPECT_THAT(run_eval({set(), "--limit", "1", "--list"}).out, HasSubstr("1 pairs of middlebury"));
}

TEST_F(Program, KeepsTheMeanIfOneMapHasNoEstimate) {
  // Two flat images have no nodes that end inside the image, so nothing can be matched.
  testing::TestPair flat = make_pair(240, 120, 9);
  flat.left.setTo(80);
  flat.right.setTo(80);
  write_pair_folder(folder_ / "set/F", flat, 32);
  const Outcome run = run_eval({set(), "--json", folder_ / "r.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const json report = this->report();
  EXPECT_EQ(report["pairs"][2]["results"]["mtstereo"]["density"], 0.0);
  EXPECT_TRUE(report["pairs"][2]["results"]["mtstereo"]["all"]["avgerr"].is_null());
  EXPECT_LT(report["mean"]["mtstereo"]["all"]["avgerr"], 1.0);
}

}  // namespace
}  // namespace mtstereo::eval::program_test

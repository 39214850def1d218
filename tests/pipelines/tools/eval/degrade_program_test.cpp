// SPDX-License-Identifier: LGPL-2.1-or-later

// mtstereo-eval --degrade and --flicker as a process, and several folders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support.hpp"
#include "tools/eval/flicker.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval::degrade_program_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_eval;

class DegradeProgram : public testing::TwoPairs {};

TEST_F(DegradeProgram, EvaluatesEachKindWithEachMethod) {
  const Outcome run = run_eval({set(), "--degrade", "noise=20,lower-right=3", "--compare", "bm",
                                "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* line : {"clean          mtstereo", "clean          bm",
                           "noise=20       mtstereo", "lower-right=3  bm"}) {
    EXPECT_THAT(run.out, HasSubstr(line));
  }
  EXPECT_EQ(report()["pairs"].size(), 6U);
  const json clean = report()["mean"]["mtstereo"];
  const json degraded = report()["degraded"];
  ASSERT_EQ(degraded.size(), 2U);
  EXPECT_EQ(degraded[1]["kind"], "lower-right=3");
  for (const json& kind : degraded) {
    EXPECT_EQ(kind["mean"]["bm"]["pairs"], 2);
    EXPECT_LT(kind["mean"]["mtstereo"]["density"], clean["density"]);
  }
}

TEST_F(DegradeProgram, LeavesTheFiguresOfTheCleanImagesAlone) {
  ASSERT_EQ(run_eval({set(), "--json", folder_ / "r.json"}).status, 0);
  const json before = report()["mean"]["mtstereo"]["all"];
  EXPECT_FALSE(report().contains("degraded"));
  ASSERT_EQ(run_eval({set(), "--degrade", "noise=20", "--json", folder_ / "r.json"}).status, 0);
  EXPECT_EQ(report()["mean"]["mtstereo"]["all"], before);
}

TEST_F(DegradeProgram, WritesTheMapsOfEachKindToItsOwnFolder) {
  const Outcome run = run_eval({set(), "--only", "B", "--degrade", "noise=20", "--compare", "bm",
                                "--write-disparity", folder_ / "maps"});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* file : {"B.pfm", "bm/B.pfm", "noise=20/B.pfm", "noise=20/bm/B.pfm"}) {
    EXPECT_TRUE(fs::exists(folder_ / "maps" / file)) << file;
  }
}

TEST_F(DegradeProgram, NamesAWrongKindAndItsRange) {
  const Outcome run = run_eval({set(), "--degrade", "noise=5,dark=2"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--degrade"));
  EXPECT_THAT(run.err, HasSubstr("dark=0 .. 1"));
  EXPECT_EQ(run.out, "");
}

TEST_F(DegradeProgram, CountsErrorsOfEnlargedImagesInPixelsOfTheOriginal) {
  const Outcome run = run_eval({set(), "--only", "A", "--degrade", "soft2x,cam1.5x", "--compare",
                                "sgbm-hh", "--min-disparity", "3", "--json", folder_ / "r.json",
                                "--write-disparity", folder_ / "maps"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("errors of enlarged images in px of the original"));
  const json pairs = report()["pairs"];
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0]["scale"], 1);
  EXPECT_EQ(pairs[0]["width"], 240);
  EXPECT_EQ(pairs[1]["scale"], 2);
  EXPECT_EQ(pairs[1]["width"], 480);
  EXPECT_EQ(pairs[1]["max_disparity"], 64);
  EXPECT_EQ(pairs[2]["scale"], 1.5);
  EXPECT_EQ(pairs[2]["height"], 180);
  EXPECT_EQ(pairs[2]["max_disparity"], 48);
  for (const json& pair : pairs) {
    for (const char* method : {"mtstereo", "sgbm-hh"}) {
      const json& all = pair["results"][method]["all"];
      // A disparity of 9 px that is found everywhere: an error of half a pixel at most.
      EXPECT_LT(all["avgerr"], 0.5) << pair["kind"] << method;
      EXPECT_EQ(all["d_all"], 0) << pair["kind"] << method;
    }
  }
  EXPECT_EQ(read_pfm(folder_ / "maps/soft2x/A.pfm").size(), cv::Size(480, 240));
}

TEST_F(DegradeProgram, EnlargesARequestedRangeToo) {
  const Outcome run = run_eval({set(), "--only", "B", "--degrade", "soft2x,cam1.5x",
                                "--max-disparity", "199", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(report()["pairs"][1]["max_disparity"], 398);
  EXPECT_EQ(report()["pairs"][2]["max_disparity"], 299);

  // The true disparity is 5 px. A range from 6 px on excludes it in all images.
  ASSERT_EQ(run_eval({set(), "--only", "B", "--degrade", "soft2x", "--min-disparity", "6", "--json",
                      folder_ / "r.json"})
                .status,
            0);
  const json pairs = report()["pairs"];
  for (const json& pair : pairs) {
    const json& avgerr = pair["results"]["mtstereo"]["all"]["avgerr"];
    EXPECT_TRUE(avgerr.is_null() || avgerr >= 0.9) << pair["kind"] << avgerr;
  }
}

TEST_F(DegradeProgram, TakesOneArgumentOfEachListBeforeTheFolder) {
  for (const auto& [option, value] :
       {std::pair("--degrade", "noise=5"), {"--compare", "bm"}, {"--only", "A,B"}}) {
    const Outcome run = run_eval({option, value, set(), "--list"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("2 pairs of middlebury")) << option;
  }
}

TEST_F(DegradeProgram, NamesThePackageOfAMissingEncoder) {
  const Outcome run =
      run_eval({set(), "--degrade", "h264=30"},
               {"GST_PLUGIN_SYSTEM_PATH_1_0=" + (folder_ / "none").string(),
                "GST_PLUGIN_PATH_1_0=", "GST_REGISTRY=" + (folder_ / "registry.bin").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--degrade h264=30: "));
  EXPECT_THAT(run.err, HasSubstr("the Debian package "));
  EXPECT_EQ(run.out, "");
}

TEST_F(DegradeProgram, MeasuresTheFlickerOfEachMethod) {
  const Outcome run =
      run_eval({set(), "--flicker", "8", "--compare", "bm", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("flicker, 6 frames with fresh noise of standard deviation 8"));
  const json flicker = report()["flicker"];
  EXPECT_EQ(flicker["noise"], 8);
  for (const char* method : {"mtstereo", "bm"}) {
    EXPECT_GT(flicker["mean"][method]["come_and_go"], 0.0) << method;
    EXPECT_LE(flicker["mean"][method]["come_and_go"], 100.0) << method;
    EXPECT_GT(flicker["mean"][method]["spread"], 0.0) << method;
  }
  EXPECT_EQ(report()["pairs"][0]["flicker"].size(), 2U);
  EXPECT_EQ(run_eval({set(), "--flicker", "0"}).status, 2);
  EXPECT_EQ(run_eval({set(), "--flicker", "much"}).status, 2);
}

TEST_F(DegradeProgram, MeasuresTheFlickerOfAStream) {
  fs::remove_all(folder_ / "set");
  for (int i = 0; i < kFlickerFrames + 2; ++i) {
    testing::TestPair pair = testing::make_pair(240, 120, 9);
    add_flicker_noise(8, i, pair.left, pair.right);
    testing::write_pair_folder(folder_ / "set" / std::to_string(i), pair, 32);
  }
  const auto run = [&](const char* temporal) {
    const Outcome outcome = run_eval({set(), "--stream", "--temporal", temporal, "--compare", "bm",
                                      "--json", folder_ / "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("flicker, 6 frames of the stream up to each"));
    return report();
  };
  const json off = run("off"), hold = run("hold");
  EXPECT_TRUE(off["flicker"]["noise"].is_null());
  EXPECT_FALSE(off["pairs"][kFlickerFrames - 2].contains("flicker"));
  EXPECT_EQ(off["pairs"][kFlickerFrames - 1]["flicker"].size(), 2U);
  const auto own = [](const json& each) { return each["flicker"]["mean"]["mtstereo"]; };
  EXPECT_LT(own(hold)["come_and_go"], own(off)["come_and_go"]);
  EXPECT_GE(own(off)["d_all"], 0);
  EXPECT_EQ(off["pairs"][0]["results"]["mtstereo"]["density"],
            hold["pairs"][0]["results"]["mtstereo"]["density"]);
  for (const char* const other : {"--flicker=3", "--degrade=noise=5", "--repeat=3"}) {
    EXPECT_EQ(run_eval({set(), "--stream", other}).status, 2) << other;
  }
}

TEST_F(DegradeProgram, DrawsTheCurveOfEachKind) {
  const Outcome run =
      run_eval({set(), "--degrade", "noise=5,bright=1.5", "--curve", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("errors at equal density, middlebury, noise=5, unweighted"));
  const json degraded = report()["degraded"];
  ASSERT_EQ(degraded.size(), 2U);
  for (const json& kind : degraded) EXPECT_EQ(kind["curve"]["pairs"], 2);
  EXPECT_EQ(report()["curve"]["kind"], "clean");
}

TEST_F(DegradeProgram, EvaluatesSeveralFoldersTogether) {
  testing::write_pair_folder(folder_ / "eth/forest_1s", testing::make_pair(200, 100, 5), 16);
  const Outcome run = run_eval({set(), folder_ / "eth", "--json", folder_ / "r.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("middlebury + eth3d in "));
  EXPECT_THAT(run.out, HasSubstr("mean of 3"));
  const json pairs = report()["pairs"];
  EXPECT_EQ(pairs[0]["name"], "set/A");
  EXPECT_EQ(pairs[2]["name"], "eth/forest_1s");

  const Outcome some = run_eval({set(), folder_ / "eth", "--only", "forest,B", "--list"});
  EXPECT_THAT(some.out, HasSubstr("2 pairs of"));
  EXPECT_THAT(some.out, Not(HasSubstr("set/A")));
  const Outcome twice = run_eval({set(), set()});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("two pairs have the name set/A"));
}

}  // namespace
}  // namespace mtstereo::eval::degrade_program_test

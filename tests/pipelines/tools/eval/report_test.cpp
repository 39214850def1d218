// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace mtstereo::eval::report_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

MethodResult result_of(const std::string& method, double avgerr, double seconds) {
  MethodResult result;
  result.method = method;
  result.evaluation.density = 40;
  result.evaluation.all.known = 100;
  result.evaluation.all.compared = 50;
  result.evaluation.all.avgerr = avgerr;
  result.evaluation.all.rms = 2 * avgerr;
  result.evaluation.all.d_all = 3;
  result.evaluation.all.bad = {9, 8, 7, 6};
  result.evaluation.all.known_density = 50;
  result.seconds = seconds;
  result.seconds_per_megapixel = 2 * seconds;
  return result;
}

// Two pairs; the second has a mask and no result of OpenCV.
Report small_report() {
  Report report;
  report.dataset = "middlebury";
  report.folder = "some/folder";
  report.parameters = {{"mode", "sparse"}, {"threads", "2"}};
  report.methods = {"mtstereo", "bm"};
  report.opencv_settings = {{"bm", "block 15"}};
  PairReport a;
  a.pair.name = "A, \"the first\"";
  a.size = {640, 480};
  a.max_disparity = 64;
  a.results = {result_of("mtstereo", 1, 0.5), result_of("bm", 3, 0.25)};
  PairReport b = a;
  b.pair.name = "B";
  b.pair.weight = 0.5;
  b.results = {result_of("mtstereo", 4, 1.5)};
  b.results[0].evaluation.noc = b.results[0].evaluation.all;
  b.results[0].evaluation.noc->avgerr = 2;
  report.pairs = {a, b};
  report.failures = {{"C", "C/im0.png: no such file"}};
  return report;
}

TEST(Summary, IsWeightedAndComparesTimesOfTheSamePairs) {
  const std::vector<Summary> means = summarize(small_report());
  ASSERT_EQ(means.size(), 2U);
  EXPECT_EQ(means[0].pairs, 2);
  EXPECT_DOUBLE_EQ(means[0].evaluation.all.avgerr, (1 + 4 * 0.5) / 1.5);
  EXPECT_DOUBLE_EQ(means[0].seconds_per_megapixel, 2);
  EXPECT_DOUBLE_EQ(means[0].time_ratio, 1);
  EXPECT_EQ(means[1].pairs, 1);
  EXPECT_DOUBLE_EQ(means[1].time_ratio, 0.5);
}

TEST(Summary, ComputesTheRatioOnlyOverPairsOfBoth) {
  Report report = small_report();
  PairReport opencv_only = report.pairs[0];
  opencv_only.results = {result_of("bm", 3, 100)};
  report.pairs.push_back(opencv_only);
  const std::vector<Summary> means = summarize(report);
  EXPECT_EQ(means[1].pairs, 2);
  EXPECT_DOUBLE_EQ(means[1].time_ratio, 0.5);
}

TEST(Summary, SeparatesKinds) {
  Report report = small_report();
  report.kinds.emplace_back("noise=5");
  PairReport noisy = report.pairs[0];
  noisy.kind = "noise=5";
  noisy.results[0].evaluation.all.avgerr = 7;
  report.pairs.push_back(noisy);
  EXPECT_EQ(summarize(report)[0].pairs, 2);
  EXPECT_EQ(summarize(report, "noise=5")[0].pairs, 1);
  EXPECT_EQ(summarize(report, "noise=5")[0].evaluation.all.avgerr, 7);
  EXPECT_EQ(summarize(report, "fog=1")[0].pairs, 0);
}

TEST(Json, ParsesBackToTheFigures) {
  const json parsed = json::parse(to_json(small_report()).dump());
  EXPECT_EQ(parsed["dataset"], "middlebury");
  EXPECT_EQ(parsed["parameters"]["mode"], "sparse");
  ASSERT_EQ(parsed["pairs"].size(), 2U);
  const json& a = parsed["pairs"][0];
  EXPECT_EQ(a["name"], "A, \"the first\"");
  EXPECT_EQ(a["width"], 640);
  EXPECT_EQ(a["results"]["mtstereo"]["all"]["avgerr"], 1.0);
  EXPECT_EQ(a["results"]["mtstereo"]["all"]["bad0.5"], 9.0);
  EXPECT_EQ(a["results"]["mtstereo"]["all"]["bad4"], 6.0);
  EXPECT_EQ(a["results"]["bm"]["seconds"], 0.25);
  EXPECT_TRUE(a["results"]["bm"]["noc"].is_null());
  EXPECT_EQ(parsed["pairs"][1]["results"]["mtstereo"]["noc"]["avgerr"], 2.0);
  EXPECT_EQ(parsed["mean"]["bm"]["time_ratio"], 0.5);
  ASSERT_EQ(parsed["failures"].size(), 1U);
  EXPECT_EQ(parsed["failures"][0]["reason"], "C/im0.png: no such file");
}

TEST(Json, HasNullForMissingFigures) {
  Report report = small_report();
  report.pairs[0].results[0].evaluation.all.avgerr = kNone;
  const json parsed = json::parse(to_json(report).dump());
  EXPECT_TRUE(parsed["pairs"][0]["results"]["mtstereo"]["all"]["avgerr"].is_null());
}

TEST(Table, ShowsPairsMeansRegionsAndRatio) {
  std::ostringstream out;
  print_table(out, small_report());
  EXPECT_THAT(out.str(), HasSubstr("middlebury in some/folder, mode sparse"));
  EXPECT_THAT(out.str(), HasSubstr("mean of 2"));
  EXPECT_THAT(out.str(), HasSubstr("visible in both views"));
  EXPECT_THAT(out.str(), HasSubstr("bm: OpenCV, block 15; takes 0.50 times as long as mtstereo"));
  EXPECT_THAT(out.str(), Not(HasSubstr("nan")));
}

TEST(Table, ShowsOnlyPairsWithAMaskInTheSecondPart) {
  std::ostringstream out;
  print_table(out, small_report());
  const std::string second = out.str().substr(out.str().find("visible in both views"));
  EXPECT_THAT(second, Not(HasSubstr("the first")));
  EXPECT_THAT(second, HasSubstr("B     "));
  EXPECT_THAT(second, HasSubstr("2.000"));
}

TEST(Table, ShowsADashForMissingFigures) {
  Report report = small_report();
  for (PairReport& pair : report.pairs) pair.results.resize(1);
  report.pairs[0].results[0].evaluation.all = Metrics{};
  std::ostringstream out;
  print_table(out, report);
  EXPECT_THAT(out.str(), HasSubstr("  -  "));
  EXPECT_THAT(out.str(), Not(HasSubstr("nan")));
}

TEST(Table, ReportsThatNothingCouldBeEvaluated) {
  Report report = small_report();
  report.pairs.clear();
  std::ostringstream out;
  print_table(out, report);
  EXPECT_THAT(out.str(), HasSubstr("no pair could be evaluated"));
}

}  // namespace
}  // namespace mtstereo::eval::report_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/eval/opencv_sweep.hpp"

namespace mtstereo::eval::curve_report_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The library at 60 and 20 %, and a matcher of OpenCV whose second ratio is better with filters.
CurveMeans small_means() {
  CurveMeans means;
  means.pairs = 2;
  means.left_out = {{"F", "sgbm has no result for it"}};
  means.methods.push_back({"mtstereo", {{0}, {1, 2}, {{60, 2, 8, 20}, {20, 1, 4, 10}}}});
  means.methods.push_back(
      {"sgbm",
       {{0, 50}, {0, 1}, {{80, 4, 9, 30}, {70, 3, 8, 20}, {40, 3, 8, 25}, {30, 0.5, 2, 5}}}});
  return means;
}

CurveReport small_report() {
  FilterSettings filters;
  filters.speckle_size = 170;
  return make_curves("eth3d", {{"mode", "sparse"}, {"threads", "2"}}, filters, small_means());
}

std::string table_of(const CurveReport& report) {
  std::ostringstream out;
  print_curves(out, report);
  print_curve_settings(out, report);
  return out.str();
}

// The fields of the line of the table with this prefix.
std::vector<std::string> fields_of(const std::string& table, const std::string& begin) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(begin + "  ", 0) != 0) continue;
    std::istringstream words(line.substr(begin.size()));
    return {std::istream_iterator<std::string>(words), {}};
  }
  return {};
}

const json& at_density(const json& curve, double density) {
  for (const json& entry : curve["at_density"]) {
    if (entry["density"] == density) return entry;
  }
  throw std::runtime_error("no such density");
}

TEST(MakeCurves, HasOneLineForTheLibraryAndTwoForEachMethodOfOpenCv) {
  const CurveReport report = small_report();
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_EQ(report.mode, "sparse");
  EXPECT_EQ(report.curves[0].name, "mtstereo");
  EXPECT_EQ(report.curves[1].name, "sgbm");
  EXPECT_EQ(report.curves[2].name, "sgbm + filters");
  EXPECT_EQ(report.curves[1].sweep.thresholds, std::vector<int>{0}) << "unfiltered";
  EXPECT_EQ(report.curves[1].method, report.curves[2].method);
  EXPECT_FALSE(report.curves[1].envelope);
  EXPECT_TRUE(report.curves[2].envelope);
}

TEST(MakeCurves, ListsAllSettings) {
  const CurveReport report = small_report();
  EXPECT_THAT(report.curves[0].settings,
              AllOf(HasSubstr("1 .. 255"), HasSubstr("mode sparse, threads 2")));
  EXPECT_THAT(report.curves[1].settings,
              AllOf(HasSubstr(uniqueness_ratios_text()), HasSubstr("speckleWindowSize 100")));
  EXPECT_THAT(report.curves[2].settings, AllOf(HasSubstr("170 px"), HasSubstr("9x9")));
}

TEST(PrintCurves, ShowsTheErrorsAtEqualDensity) {
  const std::string table = table_of(small_report());
  EXPECT_THAT(table, HasSubstr("eth3d, unweighted mean of 2 pairs"));
  EXPECT_THAT(
      fields_of(table, "avgerr px  mtstereo"),
      ::testing::ElementsAre("-", "1.000", "1.250", "1.500", "1.750", "2.000", "-", "-", "-"));
  EXPECT_THAT(
      fields_of(table, "D-all %    sgbm"),
      ::testing::ElementsAre("-", "-", "-", "8.00", "8.25", "8.50", "8.75", "8.88", "9.00"));
  EXPECT_THAT(fields_of(table, "bad1 %     sgbm + filters"),
              ::testing::ElementsAre("-", "-", "5.00", "8.75", "12.50", "16.25", "20.00", "25.00",
                                     "30.00"));
  EXPECT_THAT(table, HasSubstr("left out: F: sgbm has no result"));
}

TEST(PrintCurves, ShowsTheDensitiesAtEqualDAll) {
  CurveMeans means = small_means();
  means.methods[0].sweep.points = {{60, 2, 3, 20}, {20, 1, 1, 10}};
  const std::string table = table_of(make_curves("eth3d", {}, {}, means));
  EXPECT_THAT(table, HasSubstr("densities at equal D-all"));
  EXPECT_THAT(table, ::testing::ContainsRegex("\nD-all % +0.5 +1.0 +2.0 +5.0\n"));
  EXPECT_THAT(fields_of(table, "density %  mtstereo"),
              ::testing::ElementsAre("-", "20.0", "40.0", "60.0"));
  EXPECT_THAT(fields_of(table, "density %  sgbm"), ::testing::ElementsAre("-", "-", "-", "-"));
  EXPECT_THAT(fields_of(table, "density %  sgbm + filters"),
              ::testing::ElementsAre("-", "-", "30.0", "50.0"));
}

TEST(PrintCurves, ReportsThatThereIsNoPair) {
  CurveReport report = make_curves("eth3d", {}, {}, {0, {{"F", "it is broken"}}, {}});
  EXPECT_THAT(table_of(report),
              AllOf(HasSubstr("0 pairs"), HasSubstr("F: it is broken"), Not(HasSubstr("avgerr"))));
  EXPECT_TRUE(curves_json(report)["curves"].empty());
}

TEST(CurvesJson, HasTheSameFigures) {
  const json result = curves_json(small_report());
  EXPECT_EQ(result["pairs"], 2);
  EXPECT_EQ(result["left_out"][0]["pair"], "F");
  ASSERT_EQ(result["curves"].size(), 3U);
  EXPECT_EQ(at_density(result["curves"][0], 40)["avgerr"], 1.5);
  EXPECT_EQ(at_density(result["curves"][0], 40)["d_all"], 6);
  EXPECT_TRUE(at_density(result["curves"][0], 10)["avgerr"].is_null());
  EXPECT_EQ(at_density(result["curves"][1], 75)["bad1"], 29.375);
  const json& filtered = result["curves"][2]["at_d_all"];
  ASSERT_EQ(filtered.size(), 4U);
  EXPECT_EQ(filtered[1]["d_all"], 1);
  EXPECT_TRUE(filtered[1]["density"].is_null());
  EXPECT_EQ(filtered[2]["density"], 30);
}

TEST(CurvesJson, HasThePointsWithTheirSettings) {
  const json result = curves_json(small_report());
  const json& own = result["curves"][0]["points"];
  ASSERT_EQ(own.size(), 2U);
  EXPECT_EQ(own[1]["threshold"], 2);
  EXPECT_EQ(own[1]["density"], 20);
  EXPECT_FALSE(own[1].contains("uniqueness_ratio"));
  const json& opencv = result["curves"][1]["points"];
  ASSERT_EQ(opencv.size(), 2U);
  EXPECT_EQ(opencv[1]["uniqueness_ratio"], 50);
  EXPECT_EQ(opencv[1]["avgerr"], 3);
  EXPECT_FALSE(opencv[1].contains("threshold"));
}

TEST(CurvesJson, HasTheDataForTitleAndCaptionsOfAPlot) {
  const json result = curves_json(small_report());
  EXPECT_EQ(result["dataset"], "eth3d");
  EXPECT_EQ(result["mode"], "sparse");
  EXPECT_THAT(result["filters"].get<std::string>(), HasSubstr("170 px"));
  EXPECT_EQ(result["curves"][0]["method"], 0);
  EXPECT_EQ(result["curves"][1]["method"], 1);
  EXPECT_EQ(result["curves"][2]["method"], 1);
}

TEST(CurvesJson, SamplesAnEnvelopeAtBothEndsAndAtEveryPercent) {
  CurveMeans means = small_means();
  means.methods[1].sweep.points = {
      {80.5, 4, 9, 30}, {70, 3, 8, 20}, {40, 3, 8, 25}, {30.25, 0.5, 2, 5}};
  const json points = curves_json(make_curves("eth3d", {}, {}, means))["curves"][2]["points"];
  ASSERT_EQ(points.size(), 52U);
  EXPECT_EQ(points[0]["density"], 30.25);
  EXPECT_EQ(points[0]["avgerr"], 0.5);
  EXPECT_EQ(points[1]["density"], 31);
  EXPECT_EQ(points[50]["density"], 80);
  EXPECT_EQ(points[51]["density"], 80.5);
  EXPECT_EQ(points[51]["avgerr"], 4);
}

}  // namespace
}  // namespace mtstereo::eval::curve_report_test

// SPDX-License-Identifier: LGPL-2.1-or-later

// plot.py as a process: the image of the curves, and invalid input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "support.hpp"

namespace mtstereo::eval::plot_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Outcome;
using testing::run_plot;

// The colors of plot.py (blue, green, red), by method.
const std::vector<cv::Scalar> kColors{
    {40, 40, 210}, {190, 100, 20}, {70, 140, 30}, {170, 50, 130}, {0, 140, 230}};

json point(double density, const json& error) {
  return {{"density", density}, {"avgerr", error}, {"d_all", error}, {"bad1", error}};
}

using List = std::vector<json>;

json curve_of(int method, const List& points, bool envelope = false) {
  return {{"name", "method " + std::to_string(method)},
          {"settings", "some"},
          {"method", method},
          {"envelope", envelope},
          {"points", points}};
}

json report_of(const List& curves) {
  return {{"curve",
           {{"dataset", "middlebury"},
            {"mode", "semi-dense"},
            {"filters", "the filters"},
            {"pairs", 3},
            {"curves", curves}}}};
}

// Whether the color occurs within 2 px of a density and a fraction of the height of an axis.
bool has_color(const cv::Mat& image, int panel, double density, double height,
               const cv::Scalar& color) {
  const cv::Rect area(panel == 0 ? 60 : 665, 120, 510, 375);
  const cv::Point at(static_cast<int>(std::lround(area.x + area.width * density / 100)),
                     static_cast<int>(std::lround(area.y + area.height * (1 - height))));
  cv::Mat mask;
  const cv::Rect around(at.x - 2, at.y - 2, 5, 5);
  cv::inRange(image(around), color - cv::Scalar::all(3), color + cv::Scalar::all(3), mask);
  return cv::countNonZero(mask) > 0;
}

class Plot : public ::testing::Test {
 protected:
  std::string file(const json& report) const { return file_of(report.dump()); }
  std::string file_of(const std::string& text) const {
    testing::write_file(folder_ / "report.json", text);
    return folder_ / "report.json";
  }
  std::string image() const { return folder_ / "curve.png"; }

  // The image of a valid report.
  cv::Mat plotted(const json& report) const {
    const Outcome run = run_plot({"curve", file(report), image()});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    cv::Mat result = cv::imread(image());
    EXPECT_EQ(result.size(), cv::Size(1200, 600));
    return result;
  }

  void expect_rejection(const std::string& text, const std::string& words) const {
    const Outcome run = run_plot({"curve", file_of(text), image()});
    EXPECT_EQ(run.status, 2) << text;
    EXPECT_THAT(run.err,
                AllOf(HasSubstr("report.json: "), HasSubstr(words), Not(HasSubstr("Traceback"))))
        << text;
    EXPECT_FALSE(fs::exists(image())) << text;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(Plot, DrawsPointsAtTheirCoordinates) {
  // 1 px is the top of the left axis, and 1 % of the right one; the line at 0.5 is 1 px wide.
  const cv::Mat image = plotted(report_of(
      {curve_of(0, {point(60, 1), point(20, 1)}), curve_of(1, {point(90, 0.5), point(10, 0.5)})}));
  for (const int panel : {0, 1}) {
    for (const double density : {21.0, 40.0, 59.0}) {
      EXPECT_TRUE(has_color(image, panel, density, 1, kColors[0])) << density;
    }
    for (const double density : {5.0, 15.0, 65.0, 90.0}) {
      EXPECT_FALSE(has_color(image, panel, density, 1, kColors[0])) << density;
    }
    EXPECT_TRUE(has_color(image, panel, 10, 0.5, kColors[1])) << "the dot at a point";
    EXPECT_FALSE(has_color(image, panel, 40, 0.5, kColors[0]));
  }
}

TEST_F(Plot, InterruptsALineAtMissingErrors) {
  json gap = point(50, 1);
  gap["avgerr"] = nullptr;
  const cv::Mat image = plotted(
      report_of({curve_of(0, {point(90, 1), point(70, 1), gap, point(30, 1), point(10, 1)})}));
  EXPECT_TRUE(has_color(image, 0, 80, 1, kColors[0]));
  EXPECT_TRUE(has_color(image, 0, 20, 1, kColors[0]));
  EXPECT_FALSE(has_color(image, 0, 50, 1, kColors[0]));
  EXPECT_TRUE(has_color(image, 1, 50, 1, kColors[0])) << "D-all is not missing";
}

TEST_F(Plot, DrawsDotsOnlyForFewPointsOfASweep) {
  List many;
  for (int i = 0; i <= 40; ++i) many.push_back(point(90 - 2 * i, 0.5));
  const auto pixels = [&](const List& points, bool envelope) {
    const cv::Mat image = plotted(
        report_of({curve_of(0, {point(5, 1), point(1, 1)}), curve_of(1, points, envelope)}));
    cv::Mat mask;
    cv::inRange(image(cv::Rect(60, 290, 510, 35)), kColors[1] - cv::Scalar::all(3),
                kColors[1] + cv::Scalar::all(3), mask);
    return cv::countNonZero(mask);
  };
  const List few{point(90, 0.5), point(50, 0.5), point(10, 0.5)};
  const int dots = pixels(few, false);
  EXPECT_GT(dots, 2 * 15) << "three dots and a thin line";
  EXPECT_LT(pixels(many, false), dots);
  EXPECT_GT(pixels(few, true), 300) << "an envelope is a thick line";
}

TEST_F(Plot, HasAColorAndALegendForEachMethod) {
  List curves;
  for (int i = 0; i < 5; ++i) curves.push_back(curve_of(i, {}));
  const cv::Mat image = plotted(report_of(curves));
  const cv::Mat legend = image.rowRange(30, 90);
  for (std::size_t i = 0; i < 5; ++i) {
    cv::Mat mask;
    cv::inRange(legend, kColors[i] - cv::Scalar::all(2), kColors[i] + cv::Scalar::all(2), mask);
    EXPECT_GT(cv::countNonZero(mask), 20) << i;
  }
}

TEST_F(Plot, DrawsAPanelForEachKindOfImages) {
  json report = report_of({curve_of(0, {point(100, 1), point(0, 1)})});
  for (const char* kind : {"noise=5", "dark=0.15", "jpeg=20", "bright=2", "blur-right=1"}) {
    const json curve = report_of({curve_of(1, {point(100, 1), point(0, 1)})});
    report["degraded"].push_back({{"kind", kind}, {"curve", curve["curve"]}});
  }
  // A kind whose pairs no method completed has no panel.
  report["degraded"].push_back({{"kind", "dark=0"}, {"curve", report_of({})["curve"]}});
  report["degraded"].push_back({{"kind", "without a curve"}});
  const Outcome run = run_plot({"curve", file(report), image()});
  ASSERT_EQ(run.status, 0) << run.err;
  const cv::Mat drawn = cv::imread(image());
  ASSERT_EQ(drawn.size(), cv::Size(1200, 120 + 2 * 250 + 45));
  // The lines at the top of the six panels.
  for (int i = 0; i < 8; ++i) {
    const cv::Rect top(50 + 292 * (i % 4), 120 + 250 * (i / 4) - 3, 245, 7);
    cv::Mat mask;
    const cv::Scalar& color = kColors[i == 0 ? 0 : 1];
    cv::inRange(drawn(top), color - cv::Scalar::all(3), color + cv::Scalar::all(3), mask);
    EXPECT_EQ(cv::countNonZero(mask) > 200, i < 6) << i;
  }
}

TEST_F(Plot, DrawsTheRequestedMeasureOfEachKind) {
  json report = report_of({curve_of(0, {point(60, 1), point(20, 1)})});
  json curve = report["curve"];
  for (json& each : curve["curves"][0]["points"]) each["d_all"] = 7;
  report["degraded"] = {{{"kind", "noise=5"}, {"curve", curve}}};
  ASSERT_EQ(run_plot({"curve", file(report), image()}).status, 0);
  const std::string avgerr = testing::read_file(image());
  ASSERT_EQ(run_plot({"curve", file(report), image(), "--measure", "d_all"}).status, 0);
  EXPECT_NE(testing::read_file(image()), avgerr);
  EXPECT_EQ(run_plot({"curve", file(report), image(), "--measure", "beauty"}).status, 2);
}

TEST_F(Plot, ReadsTheReportFromStandardInput) {
  // The tests start programs with an empty standard input.
  const Outcome run = run_plot({"curve", "-", image()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("plot.py: standard input: is not JSON"));
}

TEST_F(Plot, RejectsFilesThatAreNoReports) {
  for (const char* text : {"", "{", "[]", "7", "{\"curve\": "}) expect_rejection(text, "JSON");
  expect_rejection("{}", "it has no curve");
  for (const char* text : {"{\"curve\": 1}", "{\"curve\": {}}", "{\"curve\": {\"curves\": [1]}}"}) {
    expect_rejection(text, "is not a curve plot");
  }
  expect_rejection(report_of({}).dump(), "the curve has no lines");
}

TEST_F(Plot, RejectsReportsWithWrongOrMissingValues) {
  const json good = report_of({curve_of(0, {point(60, 1), point(20, 1)})});
  for (const char* key : {"dataset", "mode", "pairs", "curves"}) {
    json report = good;
    report["curve"].erase(key);
    expect_rejection(report.dump(), key);
  }
  for (const char* key : {"name", "method", "envelope", "points"}) {
    json report = good;
    report["curve"]["curves"][0].erase(key);
    expect_rejection(report.dump(), key);
  }
  for (const json& value : {json("1"), json(true), json::array()}) {
    json report = good;
    report["curve"]["curves"][0]["points"][1]["avgerr"] = value;
    expect_rejection(report.dump(), "is not a number");
  }
  expect_rejection("{\"curve\": {\"curves\": [{\"name\": 3}]}}", "3 is not a text");
}

TEST_F(Plot, NamesUnreadableAndUnwritableFiles) {
  const Outcome unread = run_plot({"curve", folder_ / "none.json", image()});
  EXPECT_EQ(unread.status, 2);
  EXPECT_THAT(unread.err, HasSubstr("none.json: cannot be read"));
  const Outcome unwritten =
      run_plot({"curve", file(report_of({curve_of(0, {point(60, 1)})})), folder_ / "none/c.png"});
  EXPECT_EQ(unwritten.status, 1);
  EXPECT_THAT(unwritten.err, HasSubstr("none/c.png: cannot be written"));
}

TEST_F(Plot, RejectsAnInvalidCommand) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{}, {"curve"}, {"curve", "a"}, {"pie", "a", "b"}}) {
    const Outcome run = run_plot(arguments);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("usage: "));
  }
}

TEST_F(Plot, NamesThePackageIfMatplotlibIsMissing) {
  const std::string hidden = testing::without_matplotlib(folder_ / "modules");
  const std::string report = file(report_of({curve_of(0, {point(60, 1)})}));
  const Outcome run = run_plot({"curve", report, image()}, {hidden});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("python3-matplotlib"), Not(HasSubstr("Traceback"))));
  EXPECT_FALSE(fs::exists(image()));
}

}  // namespace
}  // namespace mtstereo::eval::plot_test

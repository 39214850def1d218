// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/curve_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "eval/plot_panel.hpp"

namespace mtstereo::eval {
namespace {

using ::testing::ElementsAre;

CurvePoint flat(double density) { return {density, 1, 1, 1}; }

Curve curve_of(std::size_t method, std::vector<CurvePoint> points) {
  Curve curve;
  curve.name = "method";
  curve.method = method;
  curve.sweep.ratios = {0};
  curve.sweep.thresholds.resize(points.size());
  curve.sweep.points = std::move(points);
  return curve;
}

CurveReport report_of(std::vector<Curve> curves) {
  return {"middlebury", "semi-dense", "the filters", 3, {}, std::move(curves)};
}

// Whether the color is found within 2 px of a density and a share of the axis' height.
bool has_color(const cv::Mat& picture, int panel, double density, double height,
               const cv::Scalar& color) {
  const cv::Rect area = panel_area(panel);
  const cv::Point at(static_cast<int>(std::lround(area.x + area.width * density / 100)),
                     static_cast<int>(std::lround(area.y + area.height * (1 - height))));
  cv::Mat mask;
  const cv::Rect around(at.x - 2, at.y - 2, 5, 5);
  cv::inRange(picture(around), color - cv::Scalar::all(3), color + cv::Scalar::all(3), mask);
  return cv::countNonZero(mask) > 0;
}

TEST(AxisTicks, AreRoundNumbersThatReachTheLargestValue) {
  EXPECT_THAT(axis_ticks(1), ElementsAre(0, 0.2, 0.4, ::testing::DoubleNear(0.6, 1e-9), 0.8, 1));
  EXPECT_THAT(axis_ticks(7), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(axis_ticks(30), ElementsAre(0, 5, 10, 15, 20, 25, 30));
  for (double most = 1e-6; most < 1e6; most *= 1.37) {
    const std::vector<double> ticks = axis_ticks(most);
    EXPECT_GE(ticks.back(), most * (1 - 1e-9));
    EXPECT_GE(ticks.size(), 3U) << most;
    EXPECT_LE(ticks.size(), 9U) << most;
  }
}

TEST(AxisTicks, AreThereWithoutAValueToo) {
  for (const double most : {0.0, -1.0, kNone, HUGE_VAL}) {
    EXPECT_EQ(axis_ticks(most).front(), 0) << most;
    EXPECT_EQ(axis_ticks(most).back(), 1) << most;
  }
}

TEST(DrawCurves, PutsPointsWhereTheAxesSay) {
  // 1 px is the top of the left axis, and 1 % of the right one.
  const cv::Mat picture = draw_curves(report_of({curve_of(0, {flat(60), flat(20)})}));
  ASSERT_EQ(picture.type(), CV_8UC3);
  EXPECT_EQ(picture.size(), cv::Size(1200, 600));
  for (const int panel : {0, 1}) {
    for (const double density : {21.0, 40.0, 59.0}) {
      EXPECT_TRUE(has_color(picture, panel, density, 1, curve_color(0))) << density;
    }
    for (const double density : {5.0, 15.0, 65.0, 90.0}) {
      EXPECT_FALSE(has_color(picture, panel, density, 1, curve_color(0))) << density;
    }
    EXPECT_FALSE(has_color(picture, panel, 40, 0.5, curve_color(0)));
  }
}

TEST(DrawCurves, InterruptsALineWhereThereIsNoError) {
  CurvePoint gap = flat(50);
  gap.avgerr = kNone;
  const cv::Mat picture =
      draw_curves(report_of({curve_of(0, {flat(90), flat(70), gap, flat(30), flat(10)})}));
  EXPECT_TRUE(has_color(picture, 0, 80, 1, curve_color(0)));
  EXPECT_TRUE(has_color(picture, 0, 20, 1, curve_color(0)));
  EXPECT_FALSE(has_color(picture, 0, 50, 1, curve_color(0)));
  EXPECT_TRUE(has_color(picture, 1, 50, 1, curve_color(0))) << "D-all is there";
}

TEST(DrawCurves, DrawsTheLeastOfAnEnvelope) {
  Curve best = curve_of(1, {flat(80), flat(20)});
  best.envelope = true;
  best.sweep.ratios = {0, 50};
  best.sweep.points = {flat(80), flat(20), {80, 0.5, 0.5, 0.5}, {20, 0.5, 0.5, 0.5}};
  // Another line keeps the axes at 1.
  const cv::Mat picture =
      draw_curves(report_of({curve_of(0, {flat(5), flat(1)}), std::move(best)}));
  EXPECT_TRUE(has_color(picture, 0, 50, 0.5, curve_color(1)));
  EXPECT_FALSE(has_color(picture, 0, 50, 1, curve_color(1)));
}

TEST(DrawCurves, GivesEachMethodItsColorAndALegend) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < 5; ++i) curves.push_back(curve_of(i, {}));
  const cv::Mat picture = draw_curves(report_of(curves));
  const cv::Mat legend = picture.rowRange(30, 90);
  for (std::size_t i = 0; i < 5; ++i) {
    cv::Mat mask;
    cv::inRange(legend, curve_color(i), curve_color(i), mask);
    EXPECT_GT(cv::countNonZero(mask), 20) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(curve_color(i), curve_color(j));
  }
}

TEST(DrawCurves, HasAxesWithoutAnyCurve) {
  const cv::Mat picture = draw_curves(report_of({}));
  EXPECT_FALSE(has_color(picture, 0, 50, 1, curve_color(0)));
  EXPECT_TRUE(has_color(picture, 0, 50, 0, cv::Scalar(40, 40, 40)));
}

}  // namespace
}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/curve_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "eval/plot_panel.hpp"
#include "eval/rival_sweep.hpp"

namespace mtstereo::eval {
namespace {

constexpr int kWidth = 1200;
constexpr int kHeight = 600;
constexpr int kPanelTop = 120;
constexpr int kPanelHeight = 375;
constexpr int kPanelWidth = 510;
constexpr std::array<int, 2> kPanelLeft{60, 665};

// A line as drawn: where a value is NaN it is interrupted.
struct Line {
  const Curve* curve;
  std::vector<cv::Point2d> points;  // density, error
};

// An envelope has no points of its own, so it is sampled; others are drawn from point to point.
Line line_of(const Curve& curve, const CurveMeasure& measure) {
  constexpr double kStep = 0.5;  // [%]
  Line line{&curve, {}};
  if (!curve.envelope) {
    for (const CurvePoint& point : curve.sweep.points) {
      line.points.emplace_back(point.density, point.*measure.value);
    }
    return line;
  }
  const DensityRange range = density_range(curve.sweep);
  for (double density = range.least; density < range.most; density += kStep) {
    line.points.emplace_back(density, error_at(curve.sweep, density, measure));
  }
  line.points.emplace_back(range.most, error_at(curve.sweep, range.most, measure));
  return line;
}

double largest_error(const std::vector<Line>& lines) {
  double largest = 0;
  for (const Line& line : lines) {
    for (const cv::Point2d& point : line.points) largest = std::fmax(largest, point.y);
  }
  return largest;
}

// Dots mark the settings of a line that is swept in few steps.
bool has_dots(const Curve& curve) {
  return !curve.envelope && curve.sweep.points.size() <= kUniquenessRatios.size();
}

int thickness_of(const Curve& curve) {
  if (curve.method == 0) return 3;
  return curve.envelope ? 2 : 1;
}

std::vector<double> density_ticks() {
  std::vector<double> ticks;
  for (int density = 0; density <= 100; density += 10) ticks.push_back(density);
  return ticks;
}

void draw_legend(cv::Mat& picture, const std::vector<Curve>& curves) {
  constexpr int kSample = 34, kGap = 22, kRow = 22;
  cv::Point at(kPanelLeft[0], 50);
  for (const Curve& curve : curves) {
    const int wide = kSample + 8 + text_size(curve.name, kLargeText).width + kGap;
    if (at.x + wide > kWidth) at = {kPanelLeft[0], at.y + kRow};
    const cv::Scalar color = curve_color(curve.method);
    const cv::Point middle(at.x + kSample / 2, at.y - 5);
    cv::line(picture, {at.x, middle.y}, {at.x + kSample, middle.y}, color, thickness_of(curve),
             cv::LINE_AA);
    if (has_dots(curve)) cv::circle(picture, middle, 3, color, cv::FILLED, cv::LINE_AA);
    put_text(picture, curve.name, {at.x + kSample + 8, at.y}, kLargeText);
    at.x += wide;
  }
}

void draw_captions(cv::Mat& picture, const CurveReport& report) {
  put_text(picture,
           report.dataset + ", plain mean of " + std::to_string(report.pairs) +
               " pairs, all pixels with ground truth, mode " + report.mode,
           {kPanelLeft[0], 26}, kLargeText + 0.05);
  const std::string thresholds = "1 .. " + std::to_string(kMostConfidence);
  std::string text = "mtstereo: threshold on its confidence, " + thresholds + ".";
  const bool has_rivals = std::any_of(report.curves.begin(), report.curves.end(),
                                      [](const Curve& curve) { return curve.envelope; });
  if (has_rivals) {
    text += " Dots: uniquenessRatio " + std::to_string(kUniquenessRatios.front()) + " .. " +
            std::to_string(kUniquenessRatios.back()) +
            ". + filters: the least error over these and the library's filters at " + thresholds +
            ":";
    put_text(picture, report.filters, {kPanelLeft[0], 589}, kSmallText);
  }
  put_text(picture, text, {kPanelLeft[0], 569}, kSmallText);
}

}  // namespace

cv::Scalar curve_color(std::size_t method) {
  static const std::array<cv::Scalar, 5> kColors{cv::Scalar(40, 40, 210), cv::Scalar(190, 100, 20),
                                                 cv::Scalar(70, 140, 30), cv::Scalar(170, 50, 130),
                                                 cv::Scalar(0, 140, 230)};
  return kColors[method % kColors.size()];
}

cv::Rect panel_area(int panel) {
  return {kPanelLeft.at(static_cast<std::size_t>(panel)), kPanelTop, kPanelWidth, kPanelHeight};
}

cv::Mat draw_curves(const CurveReport& report) {
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));
  draw_captions(picture, report);
  draw_legend(picture, report.curves);
  for (int i = 0; i < static_cast<int>(kPanelLeft.size()); ++i) {
    const CurveMeasure& measure = kCurveMeasures[static_cast<std::size_t>(i)];
    std::vector<Line> lines;
    for (const Curve& curve : report.curves) lines.push_back(line_of(curve, measure));
    PlotPanel panel(picture, panel_area(i), density_ticks(), axis_ticks(largest_error(lines)));
    panel.draw_axes("density [%]", std::string(measure.name) + " [" + measure.unit + "]");
    // The library's own last, so that it lies above.
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
      const cv::Scalar color = curve_color(line->curve->method);
      if (has_dots(*line->curve)) panel.draw_dots(line->points, color);
      panel.draw_line(line->points, color, thickness_of(*line->curve));
    }
  }
  return picture;
}

}  // namespace mtstereo::eval

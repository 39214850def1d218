// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/curve_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "eval/rival_sweep.hpp"

namespace mtstereo::eval {
namespace {

constexpr int kWidth = 1200;
constexpr int kHeight = 600;
constexpr int kPanelTop = 120;
constexpr int kPanelHeight = 375;
constexpr int kPanelWidth = 510;
constexpr std::array<int, 2> kPanelLeft{60, 665};
constexpr double kLargeText = 0.55;
constexpr double kMediumText = 0.48;
constexpr double kSmallText = 0.42;
// Points of lines in 1/16 px, for smooth ones.
constexpr int kShift = 4;

const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kGrid(225, 225, 225);

void put_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
              const cv::Scalar& color = kInk) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

cv::Size text_size(const std::string& text, double size) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, nullptr);
}

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

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

class Panel {
 public:
  Panel(cv::Mat& picture, cv::Rect area, double most)
      : picture_(picture), area_(area), ticks_(axis_ticks(most)) {}

  void draw_axes(const CurveMeasure& measure) {
    for (int density = 0; density <= 100; density += 10) {
      const int x = at(density, 0).x;
      cv::line(picture_, {x, area_.y}, {x, bottom()}, kGrid);
      const std::string number = std::to_string(density);
      const cv::Size size = text_size(number, kMediumText);
      put_text(picture_, number, {x - size.width / 2, bottom() + 18}, kMediumText);
    }
    for (const double tick : ticks_) {
      const int y = at(0, tick).y;
      cv::line(picture_, {area_.x, y}, {right(), y}, kGrid);
      const std::string number = short_number(tick);
      const cv::Size size = text_size(number, kMediumText);
      put_text(picture_, number, {area_.x - size.width - 7, y + size.height / 2}, kMediumText);
    }
    cv::rectangle(picture_, {area_.x, area_.y}, {right(), bottom()}, kInk);
    put_text(picture_, std::string(measure.name) + " [" + measure.unit + "]",
             {area_.x, area_.y - 9}, kLargeText);
    const std::string label = "density [%]";
    put_text(picture_, label, {right() - text_size(label, kLargeText).width, bottom() + 40},
             kLargeText);
  }

  void draw(const Line& line) {
    const cv::Scalar color = curve_color(line.curve->method);
    std::vector<cv::Point> run;
    const auto finish_run = [&] {
      if (run.size() > 1) {
        cv::polylines(picture_, run, false, color, thickness_of(*line.curve), cv::LINE_AA, kShift);
      }
      run.clear();
    };
    for (const cv::Point2d& point : line.points) {
      if (std::isnan(point.y)) {
        finish_run();
        continue;
      }
      if (has_dots(*line.curve)) {
        cv::circle(picture_, at(point.x, point.y), 3, color, cv::FILLED, cv::LINE_AA);
      }
      run.push_back(at(point.x, point.y, 1 << kShift));
    }
    finish_run();
  }

 private:
  int right() const { return area_.x + area_.width; }
  int bottom() const { return area_.y + area_.height; }

  cv::Point at(double density, double error, int scale = 1) const {
    const double x = area_.x + density / 100 * area_.width;
    const double y = bottom() - error / ticks_.back() * area_.height;
    return {static_cast<int>(std::lround(x * scale)), static_cast<int>(std::lround(y * scale))};
  }

  cv::Mat& picture_;
  cv::Rect area_;
  std::vector<double> ticks_;
};

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

std::vector<double> axis_ticks(double most) {
  constexpr int kMostSteps = 7;
  if (!(most > 0) || !std::isfinite(most)) most = 1;
  const double power = std::pow(10, std::floor(std::log10(most)) - 1);
  double step = power;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    step = factor * power;
    if (most / step <= kMostSteps) break;
  }
  std::vector<double> ticks{0};
  for (int i = 1; ticks.back() < most; ++i) ticks.push_back(i * step);
  return ticks;
}

cv::Mat draw_curves(const CurveReport& report) {
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));
  draw_captions(picture, report);
  draw_legend(picture, report.curves);
  for (int i = 0; i < static_cast<int>(kPanelLeft.size()); ++i) {
    const CurveMeasure& measure = kCurveMeasures[static_cast<std::size_t>(i)];
    std::vector<Line> lines;
    for (const Curve& curve : report.curves) lines.push_back(line_of(curve, measure));
    Panel panel(picture, panel_area(i), largest_error(lines));
    panel.draw_axes(measure);
    // The library's own last, so that it lies above.
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) panel.draw(*line);
  }
  return picture;
}

}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/plot_panel.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

namespace mtstereo::eval {
namespace {

// Points of lines in 1/16 px, for smooth ones.
constexpr int kShift = 4;
const cv::Scalar kGrid(225, 225, 225);

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

void put_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
              const cv::Scalar& color) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, 1, cv::LINE_AA);
}

cv::Size text_size(const std::string& text, double size) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, nullptr);
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

PlotPanel::PlotPanel(cv::Mat& picture, cv::Rect area, std::vector<double> x_ticks,
                     std::vector<double> y_ticks)
    : picture_(picture), area_(area), x_ticks_(std::move(x_ticks)), y_ticks_(std::move(y_ticks)) {}

void PlotPanel::draw_axes(const std::string& x_label, const std::string& y_label) {
  for (const double tick : x_ticks_) {
    const int x = at({tick, 0}).x;
    cv::line(picture_, {x, area_.y}, {x, bottom()}, kGrid);
    const std::string number = short_number(tick);
    const cv::Size size = text_size(number, kMediumText);
    put_text(picture_, number, {x - size.width / 2, bottom() + 18}, kMediumText);
  }
  for (const double tick : y_ticks_) {
    const int y = at({0, tick}).y;
    cv::line(picture_, {area_.x, y}, {right(), y}, kGrid);
    const std::string number = short_number(tick);
    const cv::Size size = text_size(number, kMediumText);
    put_text(picture_, number, {area_.x - size.width - 7, y + size.height / 2}, kMediumText);
  }
  cv::rectangle(picture_, {area_.x, area_.y}, {right(), bottom()}, kInk);
  put_text(picture_, y_label, {area_.x, area_.y - 9}, kLargeText);
  put_text(picture_, x_label, {right() - text_size(x_label, kLargeText).width, bottom() + 40},
           kLargeText);
}

void PlotPanel::draw_line(const std::vector<cv::Point2d>& points, const cv::Scalar& color,
                          int thickness) {
  std::vector<cv::Point> run;
  const auto finish_run = [&] {
    if (run.size() > 1) {
      cv::polylines(picture_, run, false, color, thickness, cv::LINE_AA, kShift);
    }
    run.clear();
  };
  for (const cv::Point2d& point : points) {
    if (std::isnan(point.y)) {
      finish_run();
    } else {
      run.push_back(at(point, 1 << kShift));
    }
  }
  finish_run();
}

void PlotPanel::draw_dots(const std::vector<cv::Point2d>& points, const cv::Scalar& color) {
  for (const cv::Point2d& point : points) {
    if (std::isnan(point.y)) continue;
    cv::circle(picture_, at(point), 3, color, cv::FILLED, cv::LINE_AA);
  }
}

cv::Point PlotPanel::at(cv::Point2d value, int scale) const {
  const double x = area_.x + value.x / x_ticks_.back() * area_.width;
  const double y = bottom() - value.y / y_ticks_.back() * area_.height;
  return {static_cast<int>(std::lround(x * scale)), static_cast<int>(std::lround(y * scale))};
}

}  // namespace mtstereo::eval

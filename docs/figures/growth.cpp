// SPDX-License-Identifier: LGPL-2.1-or-later
#include "growth.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/input_error.hpp"
#include "eval/plot_panel.hpp"

namespace mtstereo::figures {
namespace {

constexpr int kHeight = 420;
constexpr int kPanelWidth = 500;
constexpr int kPanelPitch = 600;  // from one panel to the next
constexpr int kPanelLeft = 65;
constexpr int kPanelTop = 110;
constexpr int kPanelHeight = 250;
constexpr std::size_t kMostPanels = 2;

const cv::Scalar kMeasured(40, 40, 210);
const cv::Scalar kProportional(150, 150, 150);

GrowthPanel panel_of(const nlohmann::json& json) {
  GrowthPanel panel{json.at("x"), json.at("y"), json.at("caption"), {}};
  double last = 0;
  for (const nlohmann::json& point : json.at("points")) {
    const cv::Point2d value(point.at(0).get<double>(), point.at(1).get<double>());
    if (!(value.x > last) || !(value.y > 0) || !std::isfinite(value.x) || !std::isfinite(value.y)) {
      throw eval::InputError("all points have to be above 0, with a growing x");
    }
    last = value.x;
    panel.points.push_back(value);
  }
  if (panel.points.size() < 2) throw eval::InputError("a panel needs 2 points at least");
  return panel;
}

/// A sample of a line, and what it is; gives where the next one begins.
cv::Point put_legend(cv::Mat& picture, cv::Point at, const std::string& text,
                     const cv::Scalar& color, int thickness) {
  constexpr int kSample = 34, kGap = 22;
  const cv::Point middle(at.x + kSample / 2, at.y - 5);
  cv::line(picture, {at.x, middle.y}, {at.x + kSample, middle.y}, color, thickness, cv::LINE_AA);
  eval::put_text(picture, text, {at.x + kSample + 8, at.y}, eval::kLargeText);
  return {at.x + kSample + 8 + eval::text_size(text, eval::kLargeText).width + kGap, at.y};
}

void draw_panel(cv::Mat& picture, int left, const GrowthPanel& panel) {
  const cv::Point2d first = panel.points.front();
  const cv::Point2d last = panel.points.back();
  const cv::Point2d proportional(last.x, first.y / first.x * last.x);
  double most = proportional.y;
  for (const cv::Point2d& point : panel.points) most = std::max(most, point.y);
  eval::PlotPanel axes(picture, {left, kPanelTop, kPanelWidth, kPanelHeight},
                       eval::axis_ticks(last.x), eval::axis_ticks(most));
  axes.draw_axes(panel.x_label, panel.y_label);
  axes.draw_line({{0, 0}, proportional}, kProportional, 1);
  axes.draw_line(panel.points, kMeasured, 2);
  axes.draw_dots(panel.points, kMeasured);
  const int width = eval::text_size(panel.caption, eval::kLargeText).width;
  eval::put_text(picture, panel.caption, {left + kPanelWidth - width, kPanelTop - 9},
                 eval::kLargeText);
}

}  // namespace

GrowthPlot read_growth(const std::filesystem::path& file) {
  try {
    std::ifstream stream(file);
    if (!stream) throw eval::InputError("cannot be read");
    const nlohmann::json json = nlohmann::json::parse(stream);
    GrowthPlot plot{json.at("title"), {}};
    for (const nlohmann::json& panel : json.at("panels")) plot.panels.push_back(panel_of(panel));
    if (plot.panels.empty() || plot.panels.size() > kMostPanels) {
      throw eval::InputError("wanted are 1 or 2 panels");
    }
    return plot;
  } catch (const nlohmann::json::exception& error) {
    throw eval::InputError(file, std::string("is no plot: ") + error.what());
  } catch (const eval::InputError& error) {
    throw eval::InputError(file, error.what());
  }
}

cv::Mat draw_growth(const GrowthPlot& plot) {
  cv::Mat picture(kHeight, kPanelPitch * static_cast<int>(plot.panels.size()), CV_8UC3,
                  cv::Scalar::all(255));
  eval::put_text(picture, plot.title, {kPanelLeft, 28}, eval::kLargeText + 0.05);
  const cv::Point next = put_legend(picture, {kPanelLeft, 56}, "measured", kMeasured, 2);
  put_legend(picture, next, "in proportion from the first point on", kProportional, 1);
  int left = kPanelLeft;
  for (const GrowthPanel& panel : plot.panels) {
    draw_panel(picture, left, panel);
    left += kPanelPitch;
  }
  return picture;
}

}  // namespace mtstereo::figures

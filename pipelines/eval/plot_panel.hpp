// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::eval {

/// Sizes of text in plots.
inline constexpr double kLargeText = 0.55;
inline constexpr double kMediumText = 0.48;
inline constexpr double kSmallText = 0.42;

/// The color of axes and text (blue, green, red).
inline const cv::Scalar kInk(40, 40, 40);

/// Writes text whose line begins at this point.
void put_text(cv::Mat& picture, const std::string& text, cv::Point at, double size,
              const cv::Scalar& color = kInk);
cv::Size text_size(const std::string& text, double size);

/// The steps of an axis from 0: at most 7 of them of 1, 2 or 5 times a power of ten, the last one
/// not below `most`.
std::vector<double> axis_ticks(double most);

/// Two axes in a picture (CV_8UC3), both from 0 to their last tick, and what is drawn between them.
/// The picture has to live as long.
class PlotPanel {
 public:
  PlotPanel(cv::Mat& picture, cv::Rect area, std::vector<double> x_ticks,
            std::vector<double> y_ticks);

  void draw_axes(const std::string& x_label, const std::string& y_label);
  /// From point to point; where a value is NaN the line is interrupted.
  void draw_line(const std::vector<cv::Point2d>& points, const cv::Scalar& color, int thickness);
  void draw_dots(const std::vector<cv::Point2d>& points, const cv::Scalar& color);

 private:
  int right() const { return area_.x + area_.width; }
  int bottom() const { return area_.y + area_.height; }
  cv::Point at(cv::Point2d value, int scale = 1) const;

  cv::Mat& picture_;
  cv::Rect area_;
  std::vector<double> x_ticks_, y_ticks_;
};

}  // namespace mtstereo::eval

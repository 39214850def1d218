// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::figures {

/// What grows with what.
struct GrowthPanel {
  std::string x_label;
  std::string y_label;
  std::string caption;
  std::vector<cv::Point2d> points;  ///< at least 2, all above 0, x growing
};

struct GrowthPlot {
  std::string title;
  std::vector<GrowthPanel> panels;  ///< 1 or 2
};

/// Reads {"title": TEXT, "panels": [{"x": LABEL, "y": LABEL, "caption": TEXT, "points":
/// [[X, Y], ...]}, ...]}. Throws eval::InputError, naming the file, where it is no such plot.
GrowthPlot read_growth(const std::filesystem::path& file);

/// The panels beside each other (CV_8UC3): the points, and the line on which they would lie if they
/// grew from the first one in proportion.
cv::Mat draw_growth(const GrowthPlot& plot);

}  // namespace mtstereo::figures

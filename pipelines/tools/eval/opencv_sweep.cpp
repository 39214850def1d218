// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/opencv_sweep.hpp"

#include <exception>
#include <numeric>
#include <vector>

namespace mtstereo::eval {

std::string uniqueness_ratios_text() {
  std::string text;
  for (const int ratio : kUniquenessRatios) {
    text += (text.empty() ? "" : " ") + std::to_string(ratio);
  }
  return text;
}

namespace {

// The points at one ratio: unfiltered, then filtered at all thresholds.
std::vector<CurvePoint> points_at(OpenCvMatcher& matcher, const LoadedPair& images,
                                  const FilterSettings& filters) {
  matcher.compute(images.left, images.right);
  const cv::Mat disparity = matcher.disparity();
  const cv::Mat filtered = remove_speckles(disparity, filters);
  std::vector<CurvePoint> points{point_of(evaluate(disparity, images.truth))};
  const std::vector<CurvePoint> rest =
      threshold_points(filtered, support_confidence(filtered, filters), images.truth);
  points.insert(points.end(), rest.begin(), rest.end());
  return points;
}

}  // namespace

Sweep sweep_opencv(OpenCvMethod method, int max_disparity, const LoadedPair& images,
                   const FilterSettings& filters) {
  Sweep sweep;
  sweep.ratios.assign(kUniquenessRatios.begin(), kUniquenessRatios.end());
  sweep.thresholds.resize(kMostConfidence + 1);
  std::iota(sweep.thresholds.begin(), sweep.thresholds.end(), 0);
  std::vector<std::vector<CurvePoint>> rows(sweep.ratios.size());
  std::vector<std::exception_ptr> errors(rows.size());
  // Most of OpenCV's matchers have one thread; the ratios are independent of each other.
  cv::parallel_for_(cv::Range(0, static_cast<int>(rows.size())), [&](const cv::Range& range) {
    for (auto i = static_cast<std::size_t>(range.start); i < static_cast<std::size_t>(range.end);
         ++i) {
      try {
        OpenCvMatcher matcher(method, max_disparity, sweep.ratios[i]);
        rows[i] = points_at(matcher, images, filters);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (errors[i]) std::rethrow_exception(errors[i]);
    sweep.points.insert(sweep.points.end(), rows[i].begin(), rows[i].end());
  }
  return sweep;
}

}  // namespace mtstereo::eval

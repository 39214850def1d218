// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/rival_sweep.hpp"

#include <numeric>

namespace mtstereo::eval {

std::string uniqueness_ratios_text() {
  std::string text;
  for (const int ratio : kUniquenessRatios) {
    text += (text.empty() ? "" : " ") + std::to_string(ratio);
  }
  return text;
}

Sweep sweep_rival(Rival rival, int max_disparity, const LoadedPair& images,
                  const FilterSettings& filters) {
  const cv::Mat& truth = images.truth.disparity;
  Sweep sweep;
  sweep.ratios.assign(kUniquenessRatios.begin(), kUniquenessRatios.end());
  sweep.thresholds.resize(kMostConfidence + 1);
  std::iota(sweep.thresholds.begin(), sweep.thresholds.end(), 0);
  for (const int ratio : sweep.ratios) {
    RivalMatcher matcher(rival, max_disparity, ratio);
    matcher.compute(images.left, images.right);
    const cv::Mat disparity = matcher.disparity();
    sweep.points.push_back(point_of(evaluate(disparity, images.truth)));
    const cv::Mat filtered = remove_speckles(disparity, filters);
    const std::vector<CurvePoint> points =
        threshold_points(filtered, support_confidence(filtered, filters), truth);
    sweep.points.insert(sweep.points.end(), points.begin(), points.end());
  }
  return sweep;
}

}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

namespace mtstereo::run {

/// The width of the images that are matched [px]. Their rows may differ by 8 px, which are some
/// 20 px of the frames.
inline constexpr int kMatchedWidth = 480;

/// The rows of matches that may be wrong: a fraction at each end.
inline constexpr double kRowOutliers = 0.05;

/// The disparities that are searched [px]. Those below `least` count as none.
struct SearchRange {
  int least = 0, most = 0;
};

/// How well views match: the corners of the left view that are found in the right one. Views of a
/// scene reach 0.4 to 0.9; views that do not belong together, or in the other order, 0 to 0.05.
struct ViewMatch {
  int corners = 0;
  int agreeing = 0;                ///< found in the range, in rows that a smooth field explains
  std::vector<float> disparities;  ///< of those that agree, and of those below the range [px]
  std::vector<float> rows;         ///< the same: row in the right view minus that in the left one

  double share() const;
  /// The views show the same.
  bool confirmed() const;
  /// The views show the same along rows: the rows of nearly all points differ alike.
  bool aligned() const;
  /// The value below which this fraction of the rows, or of the disparities, is; 0 without any.
  double row_at(double fraction) const;
  double disparity_at(double fraction) const;
};

/// Whether views match clearly better in the other order: along rows, where they do not now, or at
/// twice as many points. Views that are not rectified match along rows in neither order.
bool is_better_order(const ViewMatch& other, const ViewMatch& now);

/// Matches small gray images, several pairs together. Images below 96x64 px have no corners.
class ViewMatcher {
 public:
  ViewMatcher();
  ~ViewMatcher();
  ViewMatcher(const ViewMatcher&) = delete;
  ViewMatcher& operator=(const ViewMatcher&) = delete;

  /// Matches a pair, and adds what is found. Images that are empty or of different sizes
  /// add nothing.
  void add(const cv::Mat& left, const cv::Mat& right, SearchRange range, ViewMatch& match);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mtstereo::run

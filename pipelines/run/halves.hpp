// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run/recording.hpp"

namespace mtstereo::run {

/// The arrangement of two views that the shape of a frame suggests; none for the shape of one view.
std::optional<Arrangement> arrangement_by_shape(int width, int height);

/// How well the halves of frames match.
struct HalvesMatch {
  double forward = 0;    ///< density with the first half as the left view [0 .. 1]
  double backward = 0;   ///< density with the second half as the left view [0 .. 1]
  double unrelated = 0;  ///< density with views that do not belong together [0 .. 1]

  /// The halves are two views of a scene.
  bool confirmed() const;
  /// The first half is the right view.
  bool swapped() const;
};

/// Matches the halves of gray frames with each other. Throws RunError if the matcher fails.
HalvesMatch match_halves(const std::vector<cv::Mat>& frames, Arrangement arrangement);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include "recordings/clocks/frame_pairs.hpp"

namespace mtstereo {
class PairInspector;
}

namespace mtstereo::run {

class GrayFrames;

/// A point of the scene in a left frame and in a right frame, with its motion. Of two frames taken
/// at the same time, the row in the right view depends on the place in the view only; otherwise it
/// also depends on the speed.
struct RowMatch {
  double x = 0, y = 0;     ///< place in the right view; see RowField, with u and v [half widths]
  double rows = 0;         ///< row in the right view minus row in the left view [px]
  double left_speed = 0;   ///< downwards, measured in the left view [px/s]
  double right_speed = 0;  ///< the same, measured in the right view [px/s]
  double variance = 0;     ///< predicted, of `rows` [px^2]
};

/// The matches of one pair of frames.
struct MatchedPair {
  double time = 0;      ///< of the left frame [s]
  double lateness = 0;  ///< of the right frame, after the relation is applied [s]
  int corners = 0;      ///< points of the left frame that were searched
  int inliers = 0;      ///< points that agree with a smooth field of row displacements
  std::vector<RowMatch> matches;
};

/// Matches frames of two sources.
class RowMatcher {
 public:
  /// The frames must outlive the matcher.
  RowMatcher(GrayFrames& left, GrayFrames& right);
  ~RowMatcher();
  RowMatcher(const RowMatcher&) = delete;
  RowMatcher& operator=(const RowMatcher&) = delete;

  /// Which right frame.
  enum class Partner {
    kNearest,      ///< by the relation
    kOnOtherSide,  ///< the one on the other side of the right time, which is farther
  };
  /// Matches a left frame with a right frame. No matches if one of them or a neighbor of them
  /// cannot be decoded.
  MatchedPair match(std::int64_t number, const ClockRelation& relation, Partner partner);

 private:
  GrayFrames& left_;
  GrayFrames& right_;
  std::unique_ptr<PairInspector> inspector_;
};

/// The number of the frame whose time is nearest [s].
std::int64_t nearest_frame(const FrameIndex& index, double time);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "programs/calibrate/coverage.hpp"

namespace mtstereo::calibrate {

/// The outcome for a pair of images.
enum class Verdict {
  kNoBoard,  ///< not enough of the board is visible in both
  kMoving,   ///< the board moves
  kSimilar,  ///< a view like it was taken before
  kTaken,    ///< it is one of the views of the calibration
};

/// How views are chosen.
enum class Choice {
  kVideo,   ///< the board must be still, and the views must differ clearly
  kStills,  ///< each image shows a board at rest; only repetitions are left out
};

/// Captures a pair automatically if it is worth it.
class ViewChoice {
 public:
  ViewChoice(const BoardOptions& board, cv::Size left, cv::Size right, Choice choice);

  /// A pair of images at a time [s].
  Verdict offer(const CornerPair& pair, double time);
  /// What the views that were taken cover.
  const Coverage& coverage() const { return coverage_; }

 private:
  struct Seen {
    CornerPair pair;
    double time;
  };
  bool still(const CornerPair& pair, double time) const;

  BoardOptions board_;
  cv::Size left_, right_;
  Choice choice_;
  Coverage coverage_;
  std::optional<Seen> last_;
};

/// The median distance that the corners of both images have moved [px]; std::nullopt if they
/// share none.
std::optional<double> movement(const Corners& before, const Corners& after);

}  // namespace mtstereo::calibrate

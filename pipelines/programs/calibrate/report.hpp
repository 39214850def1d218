// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <ostream>

#include "programs/calibrate/options.hpp"
#include "programs/calibrate/quality.hpp"
#include "programs/calibrate/view_choice.hpp"

namespace mtstereo::calibrate {

/// Counts of the pairs of images by outcome.
struct PairCounts {
  int pairs = 0;
  int without_board = 0;
  int with_markers = 0;  ///< of those without a board: markers of its dictionary were seen
  int moving = 0;
  int similar = 0;

  void count(Verdict verdict, const CornerPair& corners);
};

/// All that a report states.
struct Report {
  const Options* options = nullptr;
  const Calibrated* calibrated = nullptr;
  const Quality* quality = nullptr;
  PairCounts counts;
  std::vector<std::string> names;  ///< of the views that were given to calibrate()
  std::string date;                ///< ISO 8601

  /// The source of the left or the right camera, in the right order.
  std::string source(bool left) const;
};

/// The figures and warnings, for the user.
void print_report(std::ostream& out, const Report& report);

/// The same as JSON.
std::string json_of(const Report& report);

/// Why there are too few views, and what to do, as a sentence.
std::string too_few_views(const PairCounts& counts, std::size_t views, const BoardOptions& board,
                          bool video);

}  // namespace mtstereo::calibrate

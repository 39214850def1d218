// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/eval/curve_report.hpp"
#include "tools/eval/runner.hpp"

namespace mtstereo::eval {

/// The mean of one method over the pairs that it completed.
struct Summary {
  std::string method;
  int pairs = 0;
  Evaluation evaluation;
  double seconds_per_megapixel = kNone;
  /// its time divided by the library's, mean over the pairs that both completed
  double time_ratio = kNone;
};

/// The results of a run.
struct Report {
  std::string dataset;
  std::string folder;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< effective values: name and text
  int warm_up = 1;
  int repeat = 1;
  std::vector<std::string> methods;                                  ///< the library's first
  std::vector<std::pair<std::string, std::string>> opencv_settings;  ///< method and its settings
  std::vector<std::string> kinds{kCleanKind};                        ///< of images, see kinds_of()
  std::optional<double> flicker;  ///< with --flicker: standard deviation of the noise [gray values]
  bool stream = false;            ///< with --stream: the pairs are successive frames
  std::vector<PairReport> pairs;  ///< of all kinds
  std::vector<Problem> failures;
  std::vector<CurveReport> curves;  ///< with --curve only, one for each kind
};

}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "eval/curve_report.hpp"
#include "eval/runner.hpp"

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
  std::vector<std::string> methods;                                 ///< the library's first
  std::vector<std::pair<std::string, std::string>> rival_settings;  ///< method and its settings
  std::vector<PairReport> pairs;
  std::vector<Problem> failures;
  std::optional<CurveReport> curve;  ///< with --curve only
};

/// The means, one for each of the report's methods.
std::vector<Summary> summarize(const Report& report);

/// Prints a table of all pixels and, if there are masks, one of the non-occluded pixels.
void print_table(std::ostream& out, const Report& report);

/// All figures; null if one could not be measured.
nlohmann::json to_json(const Report& report);

/// All figures, one line per pair, method and region, followed by the means. A figure that could
/// not be measured is empty. Fields with a comma or a quote are quoted (RFC 4180).
std::string to_csv(const Report& report);

}  // namespace mtstereo::eval

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

/// The mean of one method over the pairs that it could do.
struct Summary {
  std::string method;
  int pairs = 0;
  Evaluation evaluation;
  double seconds_per_megapixel = kNone;
  /// its time by that of the library, mean over the pairs that both could do
  double time_ratio = kNone;
};

/// All that a run has to tell.
struct Report {
  std::string dataset;
  std::string folder;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< in force, name and text
  int warm_up = 1;
  int repeat = 1;
  std::vector<std::string> methods;                                 ///< the library's first
  std::vector<std::pair<std::string, std::string>> rival_settings;  ///< method and its settings
  std::vector<PairReport> pairs;
  std::vector<Problem> failures;
  std::optional<CurveReport> curve;  ///< where it is asked for
};

/// The means, one for each of the report's methods.
std::vector<Summary> summarize(const Report& report);

/// A table for people: one of all pixels, and where masks are there one of the non-occluded ones.
void print_table(std::ostream& out, const Report& report);

/// All figures; what could not be measured is null.
nlohmann::json to_json(const Report& report);

/// All figures, one line for each pair, method and region, the means at the end; what could not be
/// measured is empty. Fields with a comma or a quote are quoted (RFC 4180).
std::string to_csv(const Report& report);

}  // namespace mtstereo::eval

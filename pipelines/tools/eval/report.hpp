// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
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

/// The text of a parameter; empty if the report has none of this name.
std::string parameter_text(const Report& report, const std::string& name);

/// The means over the pairs of one kind, one for each of the report's methods.
std::vector<Summary> summarize(const Report& report, const std::string& kind = kCleanKind);

/// The flicker of each method that has a result, mean over the pairs.
std::vector<MethodFlicker> summarize_flicker(const Report& report);

/// Prints a table of all pixels and, if there are masks, one of the non-occluded pixels. They have
/// the results of the images as they are.
void print_table(std::ostream& out, const Report& report);

/// Prints the means of all kinds and methods.
void print_kinds(std::ostream& out, const Report& report);

/// Prints the flicker of all pairs and methods, and the means.
void print_flicker(std::ostream& out, const Report& report);

/// All figures; null if one could not be measured.
nlohmann::json to_json(const Report& report);

}  // namespace mtstereo::eval

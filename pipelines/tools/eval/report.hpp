// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/eval/results.hpp"

namespace mtstereo::eval {

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

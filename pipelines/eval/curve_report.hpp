// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "eval/curve_means.hpp"
#include "eval/rival_filters.hpp"

namespace mtstereo::eval {

/// One line of the picture and the table.
struct Curve {
  std::string name;
  std::string settings;    ///< what was swept, and all that was held
  std::size_t method = 0;  ///< lines of the same matcher have the same number
  bool envelope = false;   ///< the best of a sweep in two settings, not one sweep's own line
  Sweep sweep;
};

/// What --curve has to tell.
struct CurveReport {
  std::string dataset;
  std::string mode;     ///< of the library
  std::string filters;  ///< the settings of those that the rivals' maps go through
  int pairs = 0;
  std::vector<Problem> left_out;
  std::vector<Curve> curves;
};

/// The library's parameters, name and value.
using ParameterTexts = std::vector<std::pair<std::string, std::string>>;

/// The curves of these means, for which the library's comes first: one for it; two for each rival,
/// of its uniquenessRatio alone, and the best with the library's filters too.
CurveReport make_curves(const std::string& dataset, const ParameterTexts& parameters,
                        const FilterSettings& filters, const CurveMeans& means);

/// The errors at equal density as a table for people, and what was run.
void print_curves(std::ostream& out, const CurveReport& report);

/// The same for programs, with the points of all lines; what is not reached is null.
nlohmann::json curves_json(const CurveReport& report);

}  // namespace mtstereo::eval

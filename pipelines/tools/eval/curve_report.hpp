// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/eval/curve_means.hpp"
#include "tools/eval/degradation.hpp"
#include "tools/eval/map_filters.hpp"

namespace mtstereo::eval {

/// One line of the image and the table.
struct Curve {
  std::string name;
  std::string settings;    ///< the swept setting and the fixed ones
  std::size_t method = 0;  ///< the same number for all lines of a matcher
  bool envelope = false;   ///< the lower envelope of a sweep of two settings, not of one
  Sweep sweep;
};

/// The results of --curve.
struct CurveReport {
  std::string dataset;
  std::string mode;     ///< of the library
  std::string filters;  ///< the settings of the filters that are applied to maps of OpenCV
  int pairs = 0;
  std::vector<Problem> left_out;
  std::vector<Curve> curves;
  std::string kind = kCleanKind;  ///< of the images
};

/// The library's parameters as name and value.
using ParameterTexts = std::vector<std::pair<std::string, std::string>>;

/// The curves of these means, the library's first. The library has one curve. Each matcher of
/// OpenCV has two: one over its uniquenessRatio, and the lower envelope with the library's filters.
CurveReport make_curves(const std::string& dataset, const ParameterTexts& parameters,
                        const FilterSettings& filters, const CurveMeans& means);

/// Prints the errors at equal density and the densities at equal D-all as tables, and the pairs
/// that were left out.
void print_curves(std::ostream& out, const CurveReport& report);

/// Prints what was swept, one line for each curve.
void print_curve_settings(std::ostream& out, const CurveReport& report);

/// The same as JSON, with the points of all lines; densities that are not reached have null.
nlohmann::json curves_json(const CurveReport& report);

}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "tools/eval/report.hpp"

namespace mtstereo::eval {

/// A text with the characters replaced that have a meaning in HTML.
std::string html_text(const std::string& text);

/// The errors against density of one kind of images as an SVG element.
std::string curve_svg(const CurveReport& report, const CurveMeasure& measure);

/// The report as one HTML page that refers to no other file and to no network: settings, means,
/// curves, and a table of all results with their pictures that can be sorted and filtered.
std::string to_html(const Report& report);

}  // namespace mtstereo::eval

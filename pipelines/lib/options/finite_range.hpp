// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <sstream>
#include <string>

namespace mtstereo::options {

/// For options with a number: from `least` to `most`. NaN and infinities are rejected;
/// CLI::Range() lets NaN pass. The range is not repeated in the help.
inline CLI::Validator finite_range(double least, double most) {
  return CLI::Validator(
      [least, most](std::string& text) -> std::string {
        double number = 0;
        if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
        std::ostringstream message;
        message << "'" << text << "' is not a number from " << least << " to " << most;
        return message.str();
      },
      "");
}

/// Any number that is neither NaN nor infinite.
inline CLI::Validator finite() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        double number = 0;
        if (CLI::detail::lexical_cast(text, number) && std::isfinite(number)) return {};
        return "'" + text + "' is not a number";
      },
      "");
}

}  // namespace mtstereo::options

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "lib/outputs/printable.hpp"

namespace mtstereo::outputs {

/// Prints help, or why a command line is invalid, as CLI::App::exit() does. Arguments may have any
/// bytes.
inline void print_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream errors;
  app.exit(error, std::cout, errors);
  std::cerr << printable_lines(errors.str());
}

}  // namespace mtstereo::outputs

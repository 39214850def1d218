// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <sstream>

#include "lib/options/failure_message.hpp"
#include "lib/outputs/printable.hpp"

namespace mtstereo::options {

/// Parses a command line, then calls `check`, which may refuse it by a CLI::ParseError. Prints
/// help, or why the command is invalid; arguments may have any bytes. The exit status, if the
/// program ends here: 0 after --help and --version, else 2.
template <typename Check>
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv, const Check& check) {
  app.failure_message(failure_message);
  try {
    app.parse(argc, argv);
    check();
  } catch (const CLI::ParseError& error) {
    std::ostringstream errors;
    const int status = app.exit(error, std::cout, errors);
    std::cerr << outputs::printable_lines(errors.str());
    return status == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace mtstereo::options

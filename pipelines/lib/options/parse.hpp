// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

namespace mtstereo::options {

/// Parses a command line, then calls `check`, which may refuse it by a CLI::ParseError. Prints
/// help, or why the command is invalid; arguments may have any bytes. The exit status, if the
/// program ends here: 0 after --help and --version, else 2.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv,
                         const std::function<void()>& check);

}  // namespace mtstereo::options

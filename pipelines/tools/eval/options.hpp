// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/eval/runner.hpp"

namespace mtstereo::eval {

/// The parsed command line.
struct Options {
  std::vector<std::filesystem::path> folders;
  std::optional<Layout> layout;   ///< of all folders; none: detect it
  std::vector<std::string> only;  ///< parts of pairs' names; empty: all
  int limit = 0;                  ///< maximum number of pairs; 0: all
  bool list = false;              ///< only list the pairs
  std::optional<std::filesystem::path> json;
  RunSettings run;
};

/// Parses the command line. If there is nothing to run, because help was requested or the command
/// is invalid, the text has been printed and the result has the exit status instead of options.
struct ParsedOptions {
  std::optional<Options> options;
  int exit_status = 0;
};

ParsedOptions parse_options(int argc, const char* const* argv);

/// The exit statuses of the program.
inline constexpr int kAllFine = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;

}  // namespace mtstereo::eval

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "eval/runner.hpp"

namespace mtstereo::eval {

/// What the command line asks for.
struct Options {
  std::filesystem::path folder;
  std::optional<Layout> layout;  ///< none: find out
  std::string only;              ///< part of a pair's name; empty: all
  int limit = 0;                 ///< pairs at most; 0: all
  bool list = false;             ///< only say what there is
  std::optional<std::filesystem::path> json;
  std::optional<std::filesystem::path> csv;
  std::optional<std::filesystem::path> curve;  ///< the picture
  RunSettings run;
};

/// Reads the command line. Where there is nothing to run, because help was asked for or the command
/// is wrong, the exit status is given instead, and the text has been printed.
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

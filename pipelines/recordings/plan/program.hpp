// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mtstereo::run {

/// How a program ended, and what it printed.
struct ProgramResult {
  int status = 0;  ///< exit status; 128 + number of the signal that ended it
  std::string output;
  std::string errors;
};

/// Runs a program, found in PATH unless it has a slash, and waits for its end. It is terminated if
/// the calling thread ends. Throws UserError if it cannot be started.
ProgramResult run_program(const std::vector<std::string>& arguments);

/// What a program printed, as one line of a message.
std::string in_one_line(std::string text);

/// The file of this program.
std::filesystem::path this_program();

}  // namespace mtstereo::run

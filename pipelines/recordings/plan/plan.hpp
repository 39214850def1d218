// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// A piece of a recording that one process does.
struct Task {
  std::string recording;  ///< Recording::name
  Range range;
};

/// The tasks of an archive. The folder of a plan has plan.json, works/NAME.json for every
/// recording, pieces/NUMBER/ for every task that is done, and recordings/NAME/ with the results.
struct Plan {
  std::vector<std::string> recordings;
  std::vector<Task> tasks;        ///< the number of a task is its place here
  std::vector<Problem> problems;  ///< inputs that are left out
  /// Files that are processed as far as they can be read, with where they end.
  std::vector<Problem> damaged{};
};

/// Divides recordings into tasks of at most `pairs_per_task` pairs, of equal length within a
/// recording.
std::vector<Task> divide(const std::string& recording, std::int64_t pairs,
                         std::int64_t pairs_per_task);

/// Reads plan.json. Throws UserError.
Plan read_plan(const std::filesystem::path& folder);
/// Writes plan.json. Its works must be there. Throws UserError.
void write_plan(const Plan& plan, const std::filesystem::path& folder);
/// Names become those of files and folders: throws UserError if they are not, or are not unique.
void check_recording_names(const std::vector<std::string>& recordings);

}  // namespace mtstereo::run

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

/// Writes plan.json and the works. Throws RunError.
void write_plan(const Plan& plan, const std::vector<Work>& works,
                const std::filesystem::path& folder);
/// Reads plan.json. Throws RunError.
Plan read_plan(const std::filesystem::path& folder);

/// Does one task, unless its piece is whole already. Several processes may try the same one: only
/// whole pieces appear. Throws RunError.
void do_task(const std::filesystem::path& folder, std::size_t number, const Progress& progress);
/// The tasks whose pieces are missing or not whole.
std::vector<std::size_t> missing_tasks(const std::filesystem::path& folder, const Plan& plan);

/// Joins the pieces of every recording whose tasks are done, and sums the figures into
/// summary.json. Returns the tasks that are missing. Throws RunError.
std::vector<std::size_t> merge(const std::filesystem::path& folder);

/// Does the missing tasks with this many processes of this program, then merges.
void run_local(const std::filesystem::path& folder, int jobs);

}  // namespace mtstereo::run

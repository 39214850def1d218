// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "recordings/plan/piece_functions.hpp"
#include "recordings/plan/plan.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/whole_folder.hpp"

// do_task() and merge() with their settings, and with functions that tests can replace.

namespace mtstereo::run {

/// What a process has to know to do tasks.
struct TaskOptions {
  PieceFunctions functions;
  int threads = 0;  ///< of mtstereo in this process; 0: as the plan states
};

/// Whether a task was done by this process.
enum class TaskResult {
  kDone,       ///< by this one
  kWasDone,    ///< before
  kDoneTwice,  ///< by another one in the meantime; the piece of this one was removed
};

/// Does a task. Throws UserError.
TaskResult do_task(const std::filesystem::path& folder, std::size_t number,
                   const TaskOptions& options, const Progress& progress);

/// The tasks whose pieces are missing or not whole.
std::vector<std::size_t> missing_tasks(const std::filesystem::path& folder, const Plan& plan);

/// Settings of merge().
struct MergeOptions {
  PieceFunctions functions;
  int jobs = 1;                ///< recordings that are joined at the same time
  bool remove_pieces = false;  ///< of recordings that are whole
};

/// What merge() found.
struct MergeResult {
  std::vector<std::size_t> missing;  ///< tasks whose pieces are missing or were damaged
  std::vector<Problem> problems;     ///< damaged pieces, recordings that cannot be joined
  std::vector<Problem> damaged;      ///< recordings of which tasks could not read every frame
  std::vector<Problem> doubtful;     ///< recordings whose results are useless
  std::size_t joined = 0;            ///< recordings that are whole
  Figures sum;                       ///< of the recordings that are whole
};

/// Joins the pieces of every recording whose tasks are done. Reads them and compares their
/// contents; a piece that is damaged is removed, and its task is missing. Throws UserError.
MergeResult merge(const std::filesystem::path& folder, const MergeOptions& options);

/// Adds the figures of a part to those of the parts before it.
void add(const Figures& part, Figures& sum);

/// The origin of the pieces of a recording: the digest of its work, with any range.
Origin origin_of(const PlanFolder& files, const std::string& recording, Range range);
/// Pairs of all tasks of a recording.
std::int64_t pairs_of(const Plan& plan, const std::string& recording);

}  // namespace mtstereo::run

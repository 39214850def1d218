// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "programs/run/cluster_options.hpp"
#include "recordings/plan/plan.hpp"
#include "recordings/plan/task.hpp"

// The subcommands plan, task and merge, and a run with --jobs. main.cpp calls them.

namespace mtstereo::run {

/// task or merge, if the first argument is one of them; std::nullopt: it is not. Prints what
/// it did. Throws UserError.
std::optional<int> run_cluster_command(int argc, const char* const* argv,
                                       const PieceFunctions& functions = piece_functions());

/// The input of plan and --jobs, after recordings were recognized.
struct ArchiveInput {
  std::vector<Recording> recordings;
  std::vector<Problem> problems;
  std::function<Work(const Recording&)> prepare;  ///< throws UserError
  std::string settings;   ///< all that `prepare` depends on besides the recording
  bool quiet = false;     ///< print remarks and failures only
  WorkOptions options{};  ///< for the names of the results
};

/// mtstereo-run plan: writes a plan, and prints what to do with it. Returns the exit status. Throws
/// UserError.
int run_plan_command(const ArchiveInput& input, const PlanOptions& options, Existing existing);

/// mtstereo-run --jobs N: plans into `folder`/plan, does the tasks in `jobs` processes of this
/// program, merges, and links the results into `folder`, where a run without --jobs writes them:
/// one recording into `folder` itself, several into folders with their names. Returns the exit
/// status. Throws UserError.
int run_with_jobs(const ArchiveInput& input, const std::filesystem::path& folder, int jobs,
                  Existing existing, const PieceFunctions& functions = piece_functions());

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>

namespace CLI {
class App;
}

// The options of the subcommands of mtstereo-run for plans.

namespace mtstereo::run {

/// Exit statuses of mtstereo-run.
enum ExitStatus {
  kDone = 0,        ///< everything was done
  kFailed = 1,      ///< nothing was done; the reason was printed
  kWrongUsage = 2,  ///< the command is invalid
  kIncomplete = 3,  ///< a part was done; inputs or tasks that are missing were printed
  kWorthless = 4,   ///< done, but the results are useless; the reason and the remedy were printed
};

/// mtstereo-run plan INPUT... --out DIR, with the options of a run.
struct PlanOptions {
  std::filesystem::path folder;     ///< --out
  std::int64_t pairs_per_task = 0;  ///< 0: as kPairsPerTask
  int jobs = 1;                     ///< recordings that are prepared at the same time
};

/// Adds the options of the subcommand plan that a run does not have. --out and --jobs are not
/// added.
void add_plan_options(CLI::App& app, PlanOptions& options);

/// mtstereo-run task [N] --plan DIR.
struct TaskCommand {
  std::filesystem::path folder = ".";
  std::size_t number = 0;  ///< with `first` added
  int threads = 0;         ///< 0: as the plan states
  bool quiet = false;
};

/// mtstereo-run merge --plan DIR.
struct MergeCommand {
  std::filesystem::path folder = ".";
  int jobs = 1;
  bool remove_pieces = false;
};

/// A command line of task or merge.
struct ClusterCommand {
  std::variant<TaskCommand, MergeCommand> command;
  std::optional<int> exit_status;  ///< exit with it; none: run the command
};

/// Whether the first argument is task or merge.
bool is_cluster_command(int argc, const char* const* argv);
/// Parses the command line of one of them. Prints help and errors.
ClusterCommand parse_cluster_command(int argc, const char* const* argv);

}  // namespace mtstereo::run

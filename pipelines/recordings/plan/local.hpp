// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "recordings/plan/task.hpp"

// run_local() with its settings.

namespace mtstereo::run {

/// How far the processes are.
struct LocalProgress {
  std::size_t tasks = 0, of_tasks = 0;  ///< done, and to be done by this run
  std::int64_t pairs = 0, of_pairs = 0;
  double seconds = 0;   ///< since the start
  std::string failure;  ///< what the task that ended printed, if it failed; otherwise empty
};

struct LocalOptions {
  PieceFunctions functions;  ///< for merge()
  std::filesystem::path
      program;   ///< called as PROGRAM task NUMBER --plan FOLDER --threads N --quiet
  int jobs = 1;  ///< processes at the same time
  /// Called after each task, by one thread at a time.
  std::function<void(const LocalProgress&)> progress;
};

/// Does the missing tasks, each in a process of its own, then merges. A task that fails does not
/// stop the others. Throws UserError if the plan cannot be read.
MergeResult run_local(const std::filesystem::path& folder, const LocalOptions& options);

}  // namespace mtstereo::run

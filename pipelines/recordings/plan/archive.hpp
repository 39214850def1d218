// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "recordings/plan/plan.hpp"

// Makes the plan of an archive: every recording is prepared, and its work is written at once, so
// that the pair lists of a large archive are not all in memory.

namespace mtstereo::run {

/// The outcome for a recording.
struct PlannedRecording {
  std::string name;
  std::int64_t pairs = 0;
  std::size_t tasks = 0;
  bool kept = false;                 ///< it was prepared before
  std::vector<std::string> remarks;  ///< of its work, but those about damage
  std::string problem;               ///< why it is left out; empty if it is not
};

/// How an archive is planned.
struct ArchiveOptions {
  std::filesystem::path folder;     ///< of the plan
  std::int64_t pairs_per_task = 0;  ///< 0: by least_tasks
  int least_tasks = 1;              ///< that a recording is divided into, if it is long enough
  int jobs = 1;                     ///< recordings that are prepared at the same time
  std::function<Work(const Recording&)> prepare;  ///< throws UserError
  std::string settings;  ///< all that `prepare` depends on besides the recording
  /// Called for each recording, by one thread at a time.
  std::function<void(const PlannedRecording&)> progress;
};

/// Prepares the recordings, writes their works, and plan.json last. A work that is in the folder
/// already is kept if it was made from the same files with the same settings, so an interrupted
/// call can be repeated. A recording that cannot be prepared becomes a problem of the plan. Throws
/// UserError if none is left or if the folder cannot be written.
Plan plan_archive(const std::vector<Recording>& recordings, std::vector<Problem> problems,
                  const ArchiveOptions& options);

/// How the plan in a folder compares with that of some recordings.
enum class PlanMatch {
  kSame,   ///< the same recordings, files and settings
  kGrown,  ///< there are recordings that the plan does not have
  kOther,  ///< other files or settings
};
PlanMatch compare(const Plan& plan, const std::vector<Recording>& recordings,
                  const ArchiveOptions& options);

/// Makes all paths absolute: tasks run in other folders.
Recording with_absolute_paths(Recording recording);

/// Pairs of a task, if nothing else is stated: ten minutes at 30 frames/s.
constexpr std::int64_t kPairsPerTask = 18000;

}  // namespace mtstereo::run

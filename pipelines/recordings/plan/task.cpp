// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/task.hpp"

#include <chrono>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/work_key.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// A report that does not have every pair of the range means that the process was stopped, unless
// the input ends there.
void check_report(const PieceReport& report, Range range) {
  std::int64_t expected = range.first;
  for (const FrameFigures& frame : report.frames) {
    // Frames that cannot be decoded are left out, and the report says so.
    const bool missing = frame.pair > expected && !report.damage.empty();
    if (frame.pair != expected && !missing) {
      throw UserError("pair " + std::to_string(expected) + " was not processed in its order");
    }
    expected = frame.pair + 1;
  }
  const std::int64_t end = range.first + range.count;
  if (expected > end) throw UserError("more pairs were processed than the task has");
  if (expected < end && report.damage.empty()) {
    throw UserError("stopped after " + std::to_string(expected - range.first) + " of " +
                    std::to_string(range.count) + " pairs");
  }
}

Figures figures_of(const PieceReport& report, double seconds) {
  const FrameFigures mean = mean_of(report.frames);
  return {.pairs = static_cast<std::int64_t>(report.frames.size()),
          .density = mean.density,
          .median_disparity = mean.median_disparity,
          .seconds = seconds,
          .damage = report.damage};
}

Task task_of(const Plan& plan, std::size_t number) {
  if (number < plan.tasks.size()) return plan.tasks[number];
  throw UserError("there is no task " + std::to_string(number) + ": the plan has " +
                  std::to_string(plan.tasks.size()) + " tasks, numbered from 0");
}

// A share that is not mounted, or a file that was exchanged, is not a damaged recording: another
// machine, or a new plan, can do the task.
void check_inputs(const PlanFolder& files, const Work& work) {
  const fs::path changed = changed_file(work.recording, read_key(files.key(work.recording.name)));
  if (changed.empty()) return;
  std::error_code error;
  throw UserError(changed.string() +
                  (fs::exists(changed, error)
                       ? ": has another size than when it was planned; plan again with --resume"
                       : ": is missing; if it is on another machine, mount it here at this path"));
}

// The pieces of a recording that is whole may have been removed.
bool recording_is_whole(const PlanFolder& files, const Plan& plan, const std::string& recording) {
  const Origin whole = origin_of(files, recording, {0, pairs_of(plan, recording)});
  return defect(files.recording(recording), whole, Check::kSizes).empty();
}

}  // namespace

Origin origin_of(const PlanFolder& files, const std::string& recording, Range range) {
  return {sha256_of(files.work(recording)), range};
}

std::int64_t pairs_of(const Plan& plan, const std::string& recording) {
  std::int64_t pairs = 0;
  for (const Task& task : plan.tasks) pairs += task.recording == recording ? task.range.count : 0;
  return pairs;
}

TaskResult do_task(const fs::path& folder, std::size_t number, const TaskOptions& options,
                   const Progress& progress) {
  const PlanFolder files(folder);
  const Plan plan = read_plan(folder);
  const Task task = task_of(plan, number);
  const fs::path piece = files.piece(number);
  const Origin origin = origin_of(files, task.recording, task.range);
  if (defect(piece, origin, Check::kContents).empty() ||
      recording_is_whole(files, plan, task.recording)) {
    return TaskResult::kWasDone;
  }
  try {
    Work work = read_work(files.work(task.recording));
    if (options.threads > 0) work.options.threads = options.threads;
    check_inputs(files, work);
    NewFolder unfinished(files.unfinished(), "piece-" + std::to_string(number));
    const auto start = std::chrono::steady_clock::now();
    const PieceReport report =
        options.functions.process(work, task.range, unfinished.path(), progress);
    check_report(report, task.range);
    if (!report.damage.empty()) check_inputs(files, work);  // a share may fail meanwhile
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const bool first =
        unfinished.publish(piece, origin, figures_of(report, seconds.count()), Checksums::kWith);
    return first ? TaskResult::kDone : TaskResult::kDoneTwice;
  } catch (const UserError& error) {
    // Another process may have finished it, and merge() may have removed what was unfinished.
    if (defect(piece, origin, Check::kContents).empty() ||
        recording_is_whole(files, plan, task.recording)) {
      return TaskResult::kDoneTwice;
    }
    throw UserError("task " + std::to_string(number) + " (" + task.recording +
                    "): " + error.what());
  }
}

std::vector<std::size_t> missing_tasks(const fs::path& folder, const Plan& plan) {
  const PlanFolder files(folder);
  refresh(files.pieces());
  refresh(files.recordings());
  std::vector<std::size_t> missing;
  Origin origin;
  std::string recording;
  bool whole = false;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const Task& task = plan.tasks[i];
    if (i == 0 || task.recording != recording) {
      recording = task.recording;
      origin = origin_of(files, recording, {});
      whole = recording_is_whole(files, plan, recording);
    }
    origin.range = task.range;
    if (!whole && !defect(files.piece(i), origin, Check::kSizes).empty()) missing.push_back(i);
  }
  return missing;
}

}  // namespace mtstereo::run

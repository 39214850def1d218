// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/local.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <sstream>
#include <string_view>
#include <thread>

#include "recordings/plan/in_parallel.hpp"
#include "recordings/plan/program.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// The processors, divided among the processes.
int threads_per_job(int jobs) {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, processors / std::max(jobs, 1));
}

// The message of the process, or how it ended if it has none.
std::string failure_of(std::size_t task, const ProgramResult& result) {
  constexpr int kSignals = 128;
  constexpr std::string_view kOwn = "mtstereo-run: ";  // before messages of this program
  if (result.status > kSignals) {
    return "task " + std::to_string(task) + " was ended by signal " +
           std::to_string(result.status - kSignals);
  }
  std::istringstream lines(result.errors);
  std::string message;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kOwn)) message = line.substr(kOwn.size());
  }
  if (!message.empty()) return message;
  return "task " + std::to_string(task) + " ended with status " + std::to_string(result.status) +
         ": " + in_one_line(result.errors);
}

}  // namespace

MergeResult run_local(const fs::path& folder, const LocalOptions& options) {
  const Plan plan = read_plan(folder);
  const std::vector<std::size_t> missing = missing_tasks(folder, plan);
  LocalProgress progress;
  progress.of_tasks = missing.size();
  for (const std::size_t task : missing) progress.of_pairs += plan.tasks[task].range.count;
  const std::string threads = std::to_string(threads_per_job(options.jobs));
  const auto start = std::chrono::steady_clock::now();
  std::mutex mutex;
  in_parallel(missing.size(), options.jobs, [&](std::size_t i) {
    const std::size_t task = missing[i];
    const ProgramResult result =
        run_program({options.program.string(), "task", std::to_string(task), "--plan",
                     folder.string(), "--threads", threads, "--quiet"});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::lock_guard lock(mutex);
    progress.failure.clear();
    if (result.status == 0) {
      ++progress.tasks;
      progress.pairs += plan.tasks[task].range.count;
    } else {
      progress.failure = failure_of(task, result);
    }
    progress.seconds = seconds.count();
    if (options.progress) options.progress(progress);
  });
  return merge(folder, MergeOptions{options.functions, options.jobs, false});
}

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/cluster_commands.hpp"

#include <glib.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>

#include "lib/outputs/folder_lock.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/run/interruption.hpp"
#include "recordings/inputs/recording_files.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/results.hpp"
#include "recordings/plan/archive.hpp"
#include "recordings/plan/local.hpp"
#include "recordings/plan/plan_contents.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/program.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using outputs::counted;
using outputs::FolderLock;
using outputs::Sharing;
using Clock = std::chrono::steady_clock;

// Between two lines of progress.
constexpr std::chrono::seconds kProgressPeriod{10};
// Tasks of each process of --jobs: short ones at the end keep all processes busy.
constexpr int kTasksPerJob = 4;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Tasks and merges use a plan at the same time, but not while it is made or removed.
class SharedPlan {
 public:
  explicit SharedPlan(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(PlanFolder(folder).plan(), error)) lock_.emplace(folder, Sharing::kShared);
  }

 private:
  std::optional<FolderLock> lock_;
};

void end_at_signals() {
  run::end_at_signals("mtstereo-run: interrupted; --resume continues\n", kIncomplete);
}

// "24.1 pairs/s, 3 min left"
std::string speed(std::int64_t done, std::int64_t all, double seconds) {
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
  const std::string text = outputs::format("%.1f pairs/s", rate);
  if (rate <= 0 || done >= all) return text;
  const double left = static_cast<double>(all - done) / rate;
  return text + outputs::format(", %.0f %s left", std::ceil(left < 120 ? left : left / 60),
                                left < 120 ? "s" : "min");
}

// The task is done all the same: no other machine could read more.
void print_damage(const TaskCommand& command) {
  const fs::path piece = PlanFolder(command.folder).piece(command.number);
  std::error_code error;
  if (!fs::exists(piece, error)) return;  // its recording is joined
  const std::string damage = read_figures(piece).damage;
  if (!damage.empty()) {
    std::cerr << "mtstereo-run: task " << command.number << ": " << outputs::printable(damage)
              << '\n';
  }
}

int run(const TaskCommand& command, const PieceFunctions& functions) {
  run::end_at_signals("mtstereo-run: interrupted; do the task again\n", kFailed);
  const OrderlyStop orderly;
  const SharedPlan lock(command.folder);
  const Clock::time_point start = Clock::now();
  Clock::time_point last = start;
  std::int64_t pairs = 0;
  const Progress progress = [&](std::int64_t done, std::int64_t total, double /*milliseconds*/) {
    pairs = done;
    if (!command.quiet && Clock::now() - last >= kProgressPeriod) {
      last = Clock::now();
      std::cerr << "task " << command.number << ": " << done << " of " << total << " pairs, "
                << speed(done, total, seconds_since(start)) << std::endl;
    }
    return !stop_requested();
  };
  const TaskResult result =
      do_task(command.folder, command.number, TaskOptions{functions, command.threads}, progress);
  print_damage(command);
  if (command.quiet) return kDone;
  std::cout << "task " << command.number << ": ";
  if (result == TaskResult::kWasDone) {
    std::cout << "was done before\n";
  } else {
    std::cout << pairs << " pairs, " << speed(pairs, pairs, seconds_since(start))
              << (result == TaskResult::kDoneTwice ? ", also done by another process\n" : "\n");
  }
  return kDone;
}

// Problems in lines of their own.
void print(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) {
    std::cerr << "mtstereo-run: " << outputs::printable(problem.input + ": " + problem.reason)
              << '\n';
  }
}

// Tasks in increasing order, as schedulers take them: "0-3,7".
std::string ranges_of(const std::vector<std::size_t>& tasks) {
  std::string text;
  for (std::size_t i = 0; i < tasks.size();) {
    std::size_t last = i;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    if (!text.empty()) text += ",";
    text += std::to_string(tasks[i]);
    if (last > i) text += "-" + std::to_string(tasks[last]);
    i = last + 1;
  }
  return text;
}

// A word of a shell.
std::string quoted(const fs::path& path) {
  char* const word = g_shell_quote(path.c_str());
  std::string result = word;
  g_free(word);
  return result;
}

// Prints the outcome of a plan. `next`: what to do if tasks are missing.
int report(const fs::path& folder, const Plan& plan, const MergeResult& result,
           const std::string& next) {
  for (const auto* list : {&plan.problems, &plan.damaged, &result.damaged, &result.problems}) {
    print(*list);
  }
  std::cout << result.joined << " of " << counted(plan.recordings.size(), "recording")
            << " joined, " << result.sum.pairs << " pairs, in "
            << outputs::printable(folder.string()) << '\n';
  if (!result.missing.empty()) {
    std::cerr << "mtstereo-run: " << counted(result.missing.size(), "task")
              << (result.missing.size() == 1 ? " is" : " are")
              << " missing: " << ranges_of(result.missing) << "; " << next << '\n';
  }
  if (result.missing.size() == plan.tasks.size()) return kFailed;
  for (const Problem& problem : result.doubtful) {
    std::cerr << "mtstereo-run: " << problem.input
              << ": the results are useless: " << problem.reason << '\n';
  }
  if (!result.doubtful.empty()) return kWorthless;
  const bool complete = plan.problems.empty() && result.problems.empty() && result.missing.empty();
  const bool whole = plan.damaged.empty() && result.damaged.empty();
  return complete && whole ? kDone : kIncomplete;
}

int run(const MergeCommand& command, const PieceFunctions& functions) {
  run::end_at_signals("mtstereo-run: interrupted; merge again\n", kIncomplete);
  const SharedPlan lock(command.folder);
  const MergeResult result =
      merge(command.folder, MergeOptions{functions, command.jobs, command.remove_pieces});
  return report(command.folder / "recordings", read_plan(command.folder), result,
                "do them and merge again");
}

void print_planned(const PlannedRecording& recording, bool quiet) {
  for (const std::string& remark : recording.remarks) {
    std::cerr << recording.name << ": " << outputs::printable(remark) << '\n';
  }
  if (!recording.problem.empty()) {
    std::cerr << recording.name << ": left out: " << recording.problem << std::endl;
  } else if (!quiet) {
    std::cerr << recording.name << ": " << recording.pairs << " pairs, "
              << counted(recording.tasks, "task") << (recording.kept ? ", prepared before" : "")
              << std::endl;
  }
}

// What planning needs; the caller adds the lengths of tasks.
ArchiveOptions archive_options(const ArchiveInput& input, const fs::path& folder, int jobs) {
  ArchiveOptions options;
  options.folder = folder;
  options.jobs = jobs;
  options.prepare = input.prepare;
  options.settings = input.settings;
  options.progress = [quiet = input.quiet](const PlannedRecording& recording) {
    print_planned(recording, quiet);
  };
  return options;
}

std::int64_t pairs_of(const Plan& plan) {
  std::int64_t pairs = 0;
  for (const Task& task : plan.tasks) pairs += task.range.count;
  return pairs;
}

void print_progress(const LocalProgress& progress, bool quiet) {
  if (!progress.failure.empty()) std::cerr << "mtstereo-run: " << progress.failure << '\n';
  if (quiet) return;
  std::cerr << progress.tasks << " of " << counted(progress.of_tasks, "task") << ", "
            << speed(progress.pairs, progress.of_pairs, progress.seconds) << std::endl;
}

// Whether there are recordings that the plan does not have. Throws if it is one of other inputs.
bool has_grown(const ArchiveInput& input, const ArchiveOptions& options, const fs::path& folder) {
  const PlanMatch match = compare(read_plan(options.folder), input.recordings, options);
  if (match == PlanMatch::kOther) {
    throw UserError(folder.string() +
                    ": has results of another input or other options; choose another folder by "
                    "--out, or --overwrite");
  }
  return match == PlanMatch::kGrown;
}

outputs::FileSet inputs_of(const ArchiveInput& input) {
  std::vector<fs::path> files;
  for (const Recording& recording : input.recordings) {
    const std::vector<fs::path> more = recording_files(recording);
    files.insert(files.end(), more.begin(), more.end());
  }
  return outputs::FileSet(files);
}

// What is in the way of a plan, or of the results of a recording, is refused before the first task.
// If some recordings cannot be planned, the results of the last one may be in `folder` itself.
void check_folders(const ArchiveInput& input, const fs::path& folder, Existing existing) {
  std::error_code error;
  const PlanFolder files(folder / "plan");
  const fs::file_status status = fs::symlink_status(files.path(), error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw UserError(files.path().string() + " is in the way: move it, or choose another folder");
  }
  check_plan_folder(files.path(), inputs_of(input));
  for (const Recording& found : input.recordings) {
    const Recording recording = with_absolute_paths(found);
    check_results_folder(folder, recording, input.options, existing);
    if (input.recordings.size() == 1) continue;
    check_results_folder(folder / recording.name, recording, input.options, existing);
  }
}

// Results of another work are not continued.
void check_continued(const Plan& plan, const PlanFolder& files, const fs::path& folder) {
  for (const std::string& name : plan.recordings) {
    const fs::path results = plan.recordings.size() == 1 ? folder : folder / name;
    const std::string found = fingerprint_in(results / kRunFile);
    if (found.empty() || found == fingerprint(read_work(files.work(name)))) continue;
    throw UserError(results.string() +
                    ": has results of another input or other options; choose another folder by "
                    "--out, or --overwrite");
  }
}

// Links the files of a recording, if it is joined: its report last, as that of a run.
void link_results(const fs::path& joined, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(joined / kRunFile, error)) return;
  if (!fs::equivalent(joined / kRunFile, folder / kRunFile, error)) remove_results(folder);
  link_files(joined, folder, {kReportFiles.begin(), kReportFiles.end()});
  link_file(joined / kRunFile, folder / kRunFile);
}

}  // namespace

std::optional<int> run_cluster_command(int argc, const char* const* argv,
                                       const PieceFunctions& functions) {
  if (!is_cluster_command(argc, argv)) return std::nullopt;
  const ClusterCommand parsed = parse_cluster_command(argc, argv);
  if (parsed.exit_status) return parsed.exit_status;
  return std::visit([&](const auto& command) { return run(command, functions); }, parsed.command);
}

int run_plan_command(const ArchiveInput& input, const PlanOptions& options, Existing existing) {
  end_at_signals();
  ArchiveOptions archive = archive_options(input, options.folder, options.jobs);
  archive.pairs_per_task = options.pairs_per_task > 0 ? options.pairs_per_task : kPairsPerTask;
  const FolderLock lock(options.folder);
  check_plan_folder(options.folder, inputs_of(input));
  std::error_code error;
  if (existing == Existing::kRefuse && fs::exists(PlanFolder(options.folder).plan(), error)) {
    throw UserError(options.folder.string() +
                    ": has a plan already: 'mtstereo-run task' and 'merge' continue it; "
                    "choose another folder by --out, or --resume to plan again and keep what is "
                    "prepared and done, or --overwrite to remove it");
  }
  if (existing == Existing::kReplace) remove_plan(options.folder);
  const Plan plan = plan_archive(input.recordings, input.problems, archive);
  print(plan.problems);
  print(plan.damaged);
  const std::string folder = quoted(options.folder);
  std::cout << counted(plan.recordings.size(), "recording") << ", " << pairs_of(plan) << " pairs, "
            << counted(plan.tasks.size(), "task") << " in "
            << outputs::printable(options.folder.string()) << "\nNext:  mtstereo-run task N --plan "
            << folder << ", N from 0 to " << plan.tasks.size() - 1
            << "\nThen:  mtstereo-run merge --plan " << folder << '\n';
  return plan.problems.empty() && plan.damaged.empty() ? kDone : kIncomplete;
}

int run_with_jobs(const ArchiveInput& input, const fs::path& folder, int jobs, Existing existing,
                  const PieceFunctions& functions) {
  end_at_signals();
  const FolderLock lock(folder);
  const PlanFolder files(folder / "plan");
  std::error_code error;
  bool planned = fs::exists(files.plan(), error);
  if (existing == Existing::kRefuse && planned) {
    throw UserError(folder.string() +
                    ": has results already; choose another folder by --out, or --resume or "
                    "--overwrite");
  }
  check_folders(input, folder, existing);
  if (existing == Existing::kReplace) {
    remove_plan(files.path());
    planned = false;
  }
  ArchiveOptions archive = archive_options(input, files.path(), jobs);
  archive.least_tasks = kTasksPerJob * jobs;
  if (!planned || has_grown(input, archive, folder)) {
    const FolderLock planning(files.path());
    plan_archive(input.recordings, input.problems, archive);
  }
  if (existing == Existing::kContinue) check_continued(read_plan(files.path()), files, folder);
  const MergeResult result =
      run_local(files.path(), LocalOptions{functions, this_program(), jobs,
                                           [quiet = input.quiet](const LocalProgress& done) {
                                             print_progress(done, quiet);
                                           }});
  const Plan plan = read_plan(files.path());
  for (const std::string& name : plan.recordings) {
    const bool one = plan.recordings.size() == 1;
    link_results(files.recording(name), one ? folder : folder / name);
  }
  return report(folder, plan, result, "--resume does them");
}

}  // namespace mtstereo::run

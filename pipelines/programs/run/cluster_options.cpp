// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/cluster_options.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iterator>
#include <memory>

#include "lib/options/parse.hpp"
#include "programs/run/help_format.hpp"
#include "recordings/plan/archive.hpp"

namespace mtstereo::run {
namespace {

// Where a scheduler states the index of a task.
constexpr const char* kIndexVariables[] = {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX",
                                           "AWS_BATCH_JOB_ARRAY_INDEX"};
// Where Slurm states the processors of a task.
constexpr const char* kThreadVariables[] = {"SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE"};
constexpr int kMostJobs = 1024;

void set_usage(CLI::App& app, const std::string& usage) {
  app.formatter(std::make_shared<HelpFormatter>(usage));
}

// The range is not repeated in the help.
template <typename Number>
CLI::Validator in_range(Number least, Number most) {
  return CLI::Range(least, most).description("");
}

void add_folder(CLI::App& app, std::filesystem::path& folder) {
  app.add_option("--plan", folder, "folder that 'mtstereo-run plan' wrote; . = the current one")
      ->type_name("DIR")
      ->capture_default_str();
}

std::size_t parse_number(const std::string& name, const std::string& text) {
  std::size_t number = 0;
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos ||
      !CLI::detail::lexical_cast(text, number)) {
    throw CLI::ValidationError(name, "'" + text + "' is not a task number");
  }
  return number;
}

std::size_t task_number(const std::string& text, std::size_t first) {
  if (!text.empty()) return first + parse_number("N", text);
  for (const char* variable : kIndexVariables) {
    if (const char* value = std::getenv(variable)) return first + parse_number(variable, value);
  }
  throw CLI::RequiredError(
      "N, or one of the variables SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX and "
      "AWS_BATCH_JOB_ARRAY_INDEX,");
}

// As many threads as processors were allocated.
int allocated_threads() {
  for (const char* variable : kThreadVariables) {
    int threads = 0;
    const char* value = std::getenv(variable);
    if (value != nullptr && CLI::detail::lexical_cast(value, threads) && threads > 0) {
      return threads;
    }
  }
  return 0;
}

std::optional<int> parse_task(int argc, const char* const* argv, TaskCommand& command) {
  CLI::App app{"Runs one task of a plan, unless it is done."};
  set_usage(app, "mtstereo-run task [N] [--plan DIR] [OPTIONS]");
  app.footer(
      "The number may come from a scheduler's index: SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX "
      "(Kubernetes) or AWS_BATCH_JOB_ARRAY_INDEX. Several processes may do the same task: one "
      "result is kept.\nExit status: 0 = the task is done, 1 = it is not, and the reason is "
      "printed, "
      "2 = the command is invalid. A task with a damaged input is done when all readable frames "
      "are processed; merge then returns 3.");
  std::string number;
  std::size_t first = 0;
  app.add_option("N", number, "number of the task, from 0; none: from the variables below")
      ->type_name("");
  add_folder(app, command.folder);
  app.add_option("--first", first, "added to the number: task of the index 0")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--threads", command.threads,
                 "threads of the matcher; 0 = the processors that Slurm allocated, else the number "
                 "in the plan")
      ->type_name("N")
      ->check(in_range(0, kMostJobs))
      ->capture_default_str();
  app.add_flag("--quiet", command.quiet, "print no progress");
  return options::parse(app, argc, argv, [&] {
    command.number = task_number(number, first);
    if (command.threads == 0) command.threads = allocated_threads();
  });
}

std::optional<int> parse_merge(int argc, const char* const* argv, MergeCommand& command) {
  CLI::App app{
      "Checks and joins the pieces of every recording whose tasks are done, and writes "
      "summary.json."};
  set_usage(app, "mtstereo-run merge [--plan DIR] [OPTIONS]");
  app.footer(
      "Exit status: 0 = all recordings are joined, 1 = nothing could be done, and the reason is "
      "printed, 2 = the command is invalid, 3 = tasks are missing, or inputs are unusable or "
      "damaged, 4 = the results of a recording are useless.");
  add_folder(app, command.folder);
  app.add_option("--jobs", command.jobs, "recordings that are joined at the same time")
      ->type_name("N")
      ->check(in_range(1, kMostJobs))
      ->capture_default_str();
  app.add_flag("--remove-pieces", command.remove_pieces,
               "remove the pieces of a recording after they are joined: half of the disk space");
  return options::parse(app, argc, argv, [] {});
}

}  // namespace

void add_plan_options(CLI::App& app, PlanOptions& options) {
  app.add_option("--pairs-per-task", options.pairs_per_task,
                 "length of a task in pairs; 0 = " + std::to_string(kPairsPerTask) +
                     ", ten minutes at 30 frames/s")
      ->type_name("N")
      ->check(in_range(std::int64_t{0}, std::int64_t{1'000'000'000}))
      ->capture_default_str();
}

bool is_cluster_command(int argc, const char* const* argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  return name == "task" || name == "merge";
}

ClusterCommand parse_cluster_command(int argc, const char* const* argv) {
  const std::string name = argv[1];
  // The parsers see the arguments after the name of the program.
  const int count = argc - 1;
  const char* const* arguments = std::next(argv);
  ClusterCommand result;
  if (name == "task") {
    result.exit_status = parse_task(count, arguments, result.command.emplace<TaskCommand>());
  } else {
    result.exit_status = parse_merge(count, arguments, result.command.emplace<MergeCommand>());
  }
  return result;
}

}  // namespace mtstereo::run

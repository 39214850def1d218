// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/slurm.hpp"

#include <glib.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "recordings/inputs/run_error.hpp"
#include "recordings/plan/plan.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/task.hpp"
#include "recordings/plan/whole_folder.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// Of Slurm, if it does not state its own.
constexpr std::size_t kMostIndexes = 1001;

struct ActiveJobs {
  std::set<std::size_t> tasks;
  std::set<std::string> arrays;  // numbers of the jobs
  bool merge = false;            // queued or running
};

std::optional<std::size_t> parse_number(const std::string& text) {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

std::string without_line_end(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

ProgramResult start(const std::vector<std::string>& arguments, const SlurmOptions& options) {
  try {
    return options.run(arguments);
  } catch (const RunError& error) {
    throw RunError(std::string(error.what()) +
                   ". Submit on a machine that has Slurm's programs, or do the plan without Slurm: "
                   "'mtstereo-run task N' for each task, then 'mtstereo-run merge'");
  }
}

std::string run_slurm(const SlurmOptions& options, const std::vector<std::string>& arguments) {
  const ProgramResult result = start(arguments, options);
  if (result.status == 0) return result.output;
  throw RunError(arguments.front() + " ended with status " + std::to_string(result.status) + ": " +
                 in_one_line(result.errors));
}

// Array indexes have to be below this value.
std::size_t indexes_per_array(const SlurmOptions& options) {
  std::istringstream lines(run_slurm(options, {"scontrol", "show", "config"}));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::string equals;
    std::string value;
    words >> name >> equals >> value;
    if (name != "MaxArraySize") continue;
    const std::optional<std::size_t> size = parse_number(value);
    if (size && *size > 1) return *size;
    throw RunError("Slurm does not accept arrays: MaxArraySize is " + value);
  }
  return kMostIndexes;
}

// A line of squeue: name, index in the array, number of the array, state.
void add_job(const std::string& line, const std::string& name, ActiveJobs& active) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, '|');) fields.push_back(field);
  if (fields.size() != 4 || fields[0].rfind(name + "-", 0) != 0) return;
  // A job that is completing does nothing any more. After a kill it may stay so for minutes.
  if (fields[3] == "CG") return;
  const std::string suffix = fields[0].substr(name.size() + 1);
  if (suffix == "merge") {
    active.merge = true;
    return;
  }
  const std::optional<std::size_t> first = parse_number(suffix);
  const std::optional<std::size_t> index = parse_number(fields[1]);
  if (!first || !index) return;
  active.tasks.insert(*first + *index);
  active.arrays.insert(fields[2]);
}

ActiveJobs active_jobs(const SlurmOptions& options, const std::string& name) {
  ActiveJobs active;
  std::istringstream lines(
      run_slurm(options, {"squeue", "--me", "--noheader", "--array", "--format=%j|%K|%F|%t"}));
  for (std::string line; std::getline(lines, line);) {
    add_job(without_line_end(line), name, active);
  }
  return active;
}

// In the names of log files, % has a meaning.
std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('%', at)) != std::string::npos; at += 2) {
    text.insert(at, "%");
  }
  return text;
}

// Submits the jobs of one plan.
class Submitter {
 public:
  Submitter(const fs::path& folder, const SlurmOptions& options)
      : files_(folder), options_(options), name_(job_name(folder)) {}

  const std::string& name() const { return name_; }

  // Tasks from `first`, by their indexes in the array.
  std::string submit_array(std::size_t first, const std::vector<std::size_t>& indexes) const {
    std::string array = "--array=" + array_text(indexes);
    if (options_.limit > 0) array += "%" + std::to_string(options_.limit);
    return sbatch(name_ + "-" + std::to_string(first), "%x-%a.log", array,
                  command("task") + " --first " + std::to_string(first));
  }

  std::string submit_merge(const std::set<std::string>& arrays) const {
    std::string after;
    for (const std::string& array : arrays) {
      after += (after.empty() ? "--dependency=afterany:" : ":") + array;
    }
    std::string merge = command("merge") + " --jobs " + std::to_string(options_.merge_jobs);
    if (options_.remove_pieces) merge += " --remove-pieces";
    return sbatch(name_ + "-merge", "%x.log", after, merge);
  }

 private:
  std::string command(const std::string& subcommand) const {
    return "exec " + quoted(options_.program.string()) + " " + subcommand + " --plan " +
           quoted(files_.path().string());
  }

  // Submits a job, and returns its number.
  std::string sbatch(const std::string& name, const std::string& log, const std::string& setting,
                     const std::string& command) const {
    std::vector<std::string> arguments{"sbatch",
                                       "--parsable",
                                       "--requeue",
                                       "--open-mode=append",
                                       "--job-name=" + name,
                                       "--output=" + escaped(files_.logs().string()) + "/" + log};
    if (!setting.empty()) arguments.push_back(setting);
    arguments.insert(arguments.end(), options_.options.begin(), options_.options.end());
    arguments.push_back("--wrap=" + command);
    const std::string answer = without_line_end(run_slurm(options_, arguments));
    const std::string number = answer.substr(0, answer.find(';'));  // "NUMBER;CLUSTER"
    if (!parse_number(number)) throw RunError("sbatch printed '" + answer + "' and no job number");
    return number;
  }

  PlanFolder files_;
  const SlurmOptions& options_;
  std::string name_;
};

bool all_are_joined(const PlanFolder& files, const Plan& plan) {
  std::error_code error;
  if (!fs::exists(files.summary(), error)) return false;
  return std::all_of(plan.recordings.begin(), plan.recordings.end(), [&](const std::string& name) {
    const Origin origin = origin_of(files, name, {0, pairs_of(plan, name)});
    return defect(files.recording(name), origin, Check::kSizes).empty();
  });
}

}  // namespace

std::string job_name(const fs::path& folder) {
  fs::path path = fs::weakly_canonical(folder);
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  char* const sum = g_compute_checksum_for_string(G_CHECKSUM_SHA256, path.c_str(), -1);
  const std::string digits(sum, 8);
  g_free(sum);
  return "mtstereo-" + digits;
}

std::string array_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ",";
    text += std::to_string(numbers[i]);
    if (last > i) text += "-" + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char letter : word) {
    if (letter == '\'') {
      result += "'\\''";
    } else {
      result += letter;
    }
  }
  return result + "'";
}

Submission submit(const fs::path& folder, const SlurmOptions& options) {
  const fs::path absolute = fs::weakly_canonical(folder);
  const PlanFolder files(absolute);
  const Plan plan = read_plan(absolute);
  const Submitter submitter(absolute, options);
  // In this order: a task that ends in between counts as active, not as missing.
  const ActiveJobs active = active_jobs(options, submitter.name());
  const std::vector<std::size_t> missing = missing_tasks(absolute, plan);
  Submission result;
  result.all = plan.tasks.size();
  result.done = result.all - missing.size();
  std::map<std::size_t, std::vector<std::size_t>> arrays;
  const std::size_t size = indexes_per_array(options);
  for (const std::size_t task : missing) {
    if (active.tasks.count(task) != 0) {
      ++result.active;
    } else {
      arrays[task / size * size].push_back(task % size);
      ++result.tasks;
    }
  }
  std::error_code error;
  fs::create_directories(files.logs(), error);
  if (error) throw RunError(files.logs().string() + ": " + error.message());
  std::set<std::string> before_merge = active.arrays;
  for (const auto& [first, indexes] : arrays) {
    result.arrays.push_back(submitter.submit_array(first, indexes));
    before_merge.insert(result.arrays.back());
  }
  if (!arrays.empty() || (!active.merge && !all_are_joined(files, plan))) {
    result.merge = submitter.submit_merge(before_merge);
  }
  return result;
}

}  // namespace mtstereo::run

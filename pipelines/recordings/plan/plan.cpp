// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/plan.hpp"

#include <fstream>
#include <set>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/plan/plan_contents.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/problem_json.hpp"
#include "recordings/plan/whole_folder.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPlanVersion = 1;
constexpr const char* kPlanAgain = "; plan again by 'mtstereo-run plan' with --resume";

// A name becomes that of a folder and of a file: it must stay within the plan.
void check_name(const std::string& name, std::set<std::string>& names) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos) {
    throw UserError("'" + name + "' cannot be the name of a folder of results");
  }
  if (!names.insert(name).second) throw UserError("two recordings have the name '" + name + "'");
}

std::set<std::string> check_names(const std::vector<std::string>& recordings) {
  std::set<std::string> names;
  for (const std::string& recording : recordings) check_name(recording, names);
  return names;
}

json json_of(const Plan& plan) {
  json tasks = json::array();
  for (const Task& task : plan.tasks) {
    tasks.push_back(
        {{"recording", task.recording}, {"first", task.range.first}, {"count", task.range.count}});
  }
  return {{"version", kPlanVersion},       {"program", MTSTEREO_VERSION},
          {"recordings", plan.recordings}, {"tasks", std::move(tasks)},
          {"problems", plan.problems},     {"damaged", plan.damaged}};
}

Plan plan_of(const json& text) {
  Plan plan;
  plan.recordings = text.at("recordings").get<std::vector<std::string>>();
  for (const json& task : text.at("tasks")) {
    plan.tasks.push_back({task.at("recording"), {task.at("first"), task.at("count")}});
  }
  plan.problems = text.at("problems").get<std::vector<Problem>>();
  plan.damaged = text.at("damaged").get<std::vector<Problem>>();
  return plan;
}

// The tasks of every recording cover it from the first pair without a gap.
void check_plan(const Plan& plan) {
  std::set<std::string> names = check_names(plan.recordings);
  const Task* previous = nullptr;
  for (const Task& task : plan.tasks) {
    const bool starts = previous == nullptr || previous->recording != task.recording;
    if (starts && names.erase(task.recording) == 0) {
      throw UserError("the tasks of '" + task.recording + "' are not in order");
    }
    const std::int64_t expected = starts ? 0 : previous->range.first + previous->range.count;
    if (task.range.first != expected || task.range.count <= 0) {
      throw UserError("the tasks of '" + task.recording + "' do not cover it");
    }
    previous = &task;
  }
  if (!names.empty()) throw UserError("'" + *names.begin() + "' has no task");
}

}  // namespace

std::vector<Task> divide(const std::string& recording, std::int64_t pairs,
                         std::int64_t pairs_per_task) {
  if (pairs < 0) throw UserError("a recording cannot have less than 0 pairs");
  if (pairs_per_task < 1) throw UserError("a task needs at least one pair");
  const std::int64_t number = pairs / pairs_per_task + (pairs % pairs_per_task == 0 ? 0 : 1);
  std::vector<Task> tasks;
  std::int64_t first = 0;
  for (std::int64_t i = 0; i < number; ++i) {
    // The first tasks take one pair more if the length is not a multiple.
    const std::int64_t count = pairs / number + (i < pairs % number ? 1 : 0);
    tasks.push_back({recording, {first, count}});
    first += count;
  }
  return tasks;
}

void check_recording_names(const std::vector<std::string>& recordings) { check_names(recordings); }

void write_plan(const Plan& plan, const fs::path& folder) {
  check_plan(plan);
  check_plan_file(PlanFolder(folder).plan());
  write_aside(PlanFolder(folder).plan(), outputs::text_of(json_of(plan), 1) + "\n");
}

Plan read_plan(const fs::path& folder) {
  const fs::path file = PlanFolder(folder).plan();
  std::error_code error;
  std::ifstream in;
  if (fs::is_regular_file(file, error)) in.open(file, std::ios::binary);
  if (!in.is_open()) {
    throw UserError(file.string() +
                    ": there is no plan; 'mtstereo-run plan' writes one, and --plan states its "
                    "folder");
  }
  try {
    const json text = json::parse(in);
    if (text.at("version") != kPlanVersion) {
      throw UserError(file.string() + ": is of another version of mtstereo-run" + kPlanAgain);
    }
    const std::string program = text.at("program");
    if (program != MTSTEREO_VERSION) {
      throw UserError(file.string() + ": was written by mtstereo-run " + program +
                      ", and this is " + MTSTEREO_VERSION +
                      ": use one version on all machines, so that the results do not differ; or "
                      "plan again by 'mtstereo-run plan' with --overwrite");
    }
    Plan plan = plan_of(text);
    check_plan(plan);
    return plan;
  } catch (const json::exception&) {
    throw UserError(file.string() + ": is damaged" + kPlanAgain);
  }
}

}  // namespace mtstereo::run

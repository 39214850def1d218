// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/plan/archive.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "geometry/calibration_path.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/in_parallel.hpp"
#include "recordings/plan/plan_folder.hpp"
#include "recordings/plan/whole_folder.hpp"
#include "recordings/plan/work_key.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// Below this length, the start of a process takes a noticeable part of its time.
constexpr std::int64_t kShortTask = 100;

std::int64_t pairs_per_task(std::int64_t pairs, const ArchiveOptions& options) {
  if (options.pairs_per_task > 0) return options.pairs_per_task;
  const std::int64_t tasks = std::max(options.least_tasks, 1);
  return std::clamp((pairs + tasks - 1) / tasks, kShortTask, kPairsPerTask);
}

std::string input_of(const Source& source) {
  if (!source.video.empty()) return source.video.string();
  if (!source.images.empty()) return source.images.front().parent_path().string();
  return {};
}

std::string input_of(const Recording& recording) {
  const std::string source = input_of(recording.left);
  return source.empty() ? recording.name : source;
}

struct Prepared {
  PlannedRecording recording;
  std::vector<Task> tasks;
  std::vector<Problem> damaged;
};

// The work in the folder, if it was made from the same.
std::optional<Work> work_before(const PlanFolder& files, const std::string& name,
                                const WorkKey& key) {
  if (read_key(files.key(name)) != key) return std::nullopt;
  try {
    return read_work(files.work(name));
  } catch (const UserError&) {
    return std::nullopt;  // it is made again
  }
}

// A reason may begin with the input.
Problem problem_of(std::string input, std::string reason) {
  const std::string repeated = input + ": ";
  if (reason.starts_with(repeated)) reason.erase(0, repeated.size());
  return {std::move(input), std::move(reason)};
}

// A work without a key does not count: the key is removed first and written last.
void write_prepared(const Work& work, const WorkKey& key, const PlanFolder& files) {
  const std::string& name = work.recording.name;
  std::error_code error;
  fs::remove(files.key(name), error);
  write_work(work, files.work(name));
  write_key(key, files.key(name));
}

std::optional<Work> try_to_prepare(const Recording& recording, const ArchiveOptions& options,
                                   std::string& problem) {
  try {
    Work work = options.prepare(recording);
    if (!work.pairs.pairs.empty()) return work;
    problem = "no frames of the two views belong together";
  } catch (const std::exception& error) {
    problem = outputs::printable(error.what());
  }
  return std::nullopt;
}

// What cannot be read is a problem of the recording. A folder that cannot be written ends it all.
Prepared prepare_recording(const Recording& found, const ArchiveOptions& options) {
  Prepared result;
  PlannedRecording& planned = result.recording;
  planned.name = found.name;
  const PlanFolder files(options.folder);
  const Recording recording = with_absolute_paths(found);
  const WorkKey key = work_key(recording, options.settings);
  std::optional<Work> work = work_before(files, recording.name, key);
  planned.kept = work.has_value();
  if (!work) {
    work = try_to_prepare(recording, options, planned.problem);
    if (!work) return result;
    write_prepared(*work, key, files);
  }
  planned.pairs = static_cast<std::int64_t>(work->pairs.pairs.size());
  planned.remarks = std::move(work->remarks);
  // Damage is stated with the name of the file.
  for (const FrameIndex* index : {&work->left, &work->right}) {
    if (index->damage.empty()) continue;
    std::erase_if(planned.remarks,
                  [&](const std::string& remark) { return remark.ends_with(index->damage); });
  }
  result.tasks = divide(recording.name, planned.pairs, pairs_per_task(planned.pairs, options));
  planned.tasks = result.tasks.size();
  for (const auto& [source, index] :
       {std::pair(&recording.left, &work->left), std::pair(&recording.right, &work->right)}) {
    if (!index->damage.empty()) result.damaged.push_back({input_of(*source), index->damage});
  }
  return result;
}

std::string absolute(const std::string& file) { return fs::absolute(file).string(); }

std::string absolute_calibration(const std::string& calibration) {
  const CalibrationPath path = split_calibration_path(calibration);
  std::string result;
  for (const std::string& file : path.files) {
    result += (result.empty() ? "" : ",") + absolute(file);
  }
  return path.selection.empty() ? result : result + "#" + path.selection;
}

void make_absolute(Source& source) {
  if (!source.video.empty()) source.video = fs::absolute(source.video);
  for (fs::path& image : source.images) image = fs::absolute(image);
}

}  // namespace

Recording with_absolute_paths(Recording recording) {
  make_absolute(recording.left);
  make_absolute(recording.right);
  if (!recording.calibration.empty()) {
    recording.calibration = absolute_calibration(recording.calibration);
  }
  return recording;
}

PlanMatch compare(const Plan& plan, const std::vector<Recording>& recordings,
                  const ArchiveOptions& options) {
  const PlanFolder files(options.folder);
  std::set<std::string> planned(plan.recordings.begin(), plan.recordings.end());
  PlanMatch match = PlanMatch::kSame;
  for (const Recording& recording : recordings) {
    if (planned.erase(recording.name) == 0) {
      match = PlanMatch::kGrown;
    } else if (read_key(files.key(recording.name)) !=
               work_key(with_absolute_paths(recording), options.settings)) {
      return PlanMatch::kOther;
    }
  }
  return planned.empty() ? match : PlanMatch::kOther;
}

Plan plan_archive(const std::vector<Recording>& recordings, std::vector<Problem> problems,
                  const ArchiveOptions& options) {
  std::vector<std::string> names;
  for (const Recording& recording : recordings) names.push_back(recording.name);
  check_recording_names(names);
  std::error_code error;
  fs::create_directories(PlanFolder(options.folder).works(), error);
  if (error) {
    throw UserError(options.folder.string() + ": cannot be created: " + error.message());
  }
  std::vector<Prepared> prepared(recordings.size());
  std::mutex mutex;
  in_parallel(recordings.size(), options.jobs, [&](std::size_t i) {
    prepared[i] = prepare_recording(recordings[i], options);
    const std::lock_guard lock(mutex);
    if (options.progress) options.progress(prepared[i].recording);
  });
  Plan plan;
  for (Problem& problem : problems) {
    plan.problems.push_back(problem_of(std::move(problem.input), std::move(problem.reason)));
  }
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    Prepared& each = prepared[i];
    if (!each.recording.problem.empty()) {
      plan.problems.push_back(problem_of(input_of(recordings[i]), each.recording.problem));
      continue;
    }
    plan.recordings.push_back(recordings[i].name);
    plan.tasks.insert(plan.tasks.end(), each.tasks.begin(), each.tasks.end());
    plan.damaged.insert(plan.damaged.end(), each.damaged.begin(), each.damaged.end());
  }
  if (plan.recordings.empty()) {
    throw UserError(plan.problems.empty()
                        ? "there is no recording"
                        : "no recording can be used: " + plan.problems.front().input + ": " +
                              plan.problems.front().reason);
  }
  write_plan(plan, options.folder);
  return plan;
}

}  // namespace mtstereo::run

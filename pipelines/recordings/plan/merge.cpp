// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "lib/outputs/json_text.hpp"
#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/media/damage_notes.hpp"
#include "recordings/plan/discard.hpp"
#include "recordings/plan/in_parallel.hpp"
#include "recordings/plan/plan_contents.hpp"
#include "recordings/plan/problem_json.hpp"
#include "recordings/plan/task.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kSummaryVersion = 1;

// The outcome for a recording.
struct Joined {
  std::optional<Figures> figures;  // if it is whole
  std::string doubt;               // why its results are useless
  std::vector<std::size_t> missing;
  std::vector<Problem> problems;
};

// Joins one recording.
class Joiner {
 public:
  Joiner(const PlanFolder& files, const Plan& plan, const MergeOptions& options)
      : files_(files), plan_(plan), options_(options) {
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
      tasks_[plan.tasks[i].recording].push_back(i);
    }
  }

  Joined join(const std::string& recording) const {
    Joined result;
    try {
      const std::vector<std::size_t>& tasks = tasks_.at(recording);
      const Origin origin = origin_of(files_, recording, {0, pairs_of(plan_, recording)});
      if (!is_whole(recording, origin)) {
        check_pieces(tasks, origin, result);
        if (!result.missing.empty()) return result;
        join_pieces(recording, tasks, origin);
      }
      result.figures = read_figures(files_.recording(recording));
      result.doubt = verdict_in(files_.recording(recording) / kRunFile);
      if (options_.remove_pieces) {
        for (const std::size_t task : tasks) discard(files_.piece(task), files_.unfinished());
      }
    } catch (const UserError& error) {
      result.problems.push_back({recording, error.what()});
    }
    return result;
  }

 private:
  bool is_whole(const std::string& recording, const Origin& origin) const {
    return defect(files_.recording(recording), origin, Check::kSizes).empty();
  }

  void check_pieces(const std::vector<std::size_t>& tasks, const Origin& recording,
                    Joined& result) const {
    for (const std::size_t task : tasks) {
      const Origin origin{recording.work, plan_.tasks[task].range};
      const std::string found = defect(files_.piece(task), origin, Check::kContents);
      if (found.empty()) continue;
      std::error_code error;
      const fs::path piece = files_.piece(task);
      const bool exists = fs::exists(piece, error);
      if (exists && !discard_damaged(piece, origin, files_.unfinished())) continue;
      result.missing.push_back(task);
      if (!exists) continue;
      result.problems.push_back({piece.string(), "this piece is removed, because " + found});
    }
  }

  void join_pieces(const std::string& recording, const std::vector<std::size_t>& tasks,
                   const Origin& origin) const {
    const Work work = read_work(files_.work(recording));
    std::vector<Range> ranges;
    std::vector<fs::path> pieces;
    Figures sum;
    for (const std::size_t task : tasks) {
      ranges.push_back(plan_.tasks[task].range);
      pieces.push_back(files_.piece(task));
      add(read_figures(pieces.back()), sum);
    }
    try {
      NewFolder unfinished(files_.unfinished(), "recording-" + recording);
      const PieceReport report = join_into(unfinished.path(), work, ranges, pieces);
      write_run_report(work, report, sum.seconds, unfinished.path() / kRunFile);
      // The pieces were checked by their contents. Reading all of it once more would take as long
      // as joining it.
      unfinished.publish(files_.recording(recording), origin, sum, Checksums::kWithout);
    } catch (const UserError&) {
      // Another process may have joined it, and have removed what was unfinished.
      if (!is_whole(recording, origin)) throw;
    }
  }

  // One piece is the whole: it is linked.
  PieceReport join_into(const fs::path& folder, const Work& work, const std::vector<Range>& ranges,
                        const std::vector<fs::path>& pieces) const {
    if (pieces.size() > 1) return options_.functions.join(work, ranges, pieces, folder);
    link_files(pieces.front(), folder);
    Range range;
    return read_piece(folder / kPieceFile, range);
  }

  const PlanFolder& files_;
  const Plan& plan_;
  const MergeOptions& options_;
  std::map<std::string, std::vector<std::size_t>> tasks_;
};

json json_of(const std::string& name, const Joined& joined) {
  json recording{{"name", name}, {"whole", joined.figures.has_value()}};
  if (joined.figures) {
    recording["pairs"] = joined.figures->pairs;
    recording["density"] = joined.figures->density;
    recording["median_disparity"] = joined.figures->median_disparity;
    recording["seconds"] = joined.figures->seconds;
    recording["damage"] = joined.figures->damage;
    recording["doubt"] = joined.doubt;
  }
  return recording;
}

std::vector<Problem> joined(std::vector<Problem> problems, const std::vector<Problem>& more) {
  problems.insert(problems.end(), more.begin(), more.end());
  return problems;
}

void write_summary(const PlanFolder& files, const Plan& plan, const std::vector<Joined>& recordings,
                   const MergeResult& result) {
  json list = json::array();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    list.push_back(json_of(plan.recordings[i], recordings[i]));
  }
  const json summary{{"version", kSummaryVersion},
                     {"recordings", std::move(list)},
                     {"pairs", result.sum.pairs},
                     {"density", result.sum.density},
                     {"median_disparity", result.sum.median_disparity},
                     {"seconds", result.sum.seconds},
                     {"missing_tasks", result.missing},
                     {"problems", joined(plan.problems, result.problems)},
                     {"damaged", joined(plan.damaged, result.damaged)}};
  check_plan_file(files.summary());
  write_aside(files.summary(), outputs::text_of(summary, 1) + "\n");
}

}  // namespace

void add(const Figures& part, Figures& sum) {
  const auto pairs = static_cast<double>(sum.pairs + part.pairs);
  if (part.pairs > 0) {
    const double weight = static_cast<double>(part.pairs) / pairs;
    sum.density += (part.density - sum.density) * weight;
    sum.median_disparity += (part.median_disparity - sum.median_disparity) * weight;
  }
  sum.pairs += part.pairs;
  sum.seconds += part.seconds;
  // As join() does.
  if (part.pairs > 0 || sum.damage.empty()) add_damage(sum.damage, part.damage);
}

MergeResult merge(const fs::path& folder, const MergeOptions& options) {
  const PlanFolder files(folder);
  const Plan plan = read_plan(folder);
  refresh(files.pieces());
  refresh(files.recordings());
  const Joiner joiner(files, plan, options);
  std::vector<Joined> recordings(plan.recordings.size());
  in_parallel(recordings.size(), options.jobs,
              [&](std::size_t i) { recordings[i] = joiner.join(plan.recordings[i]); });
  MergeResult result;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const Joined& recording = recordings[i];
    result.missing.insert(result.missing.end(), recording.missing.begin(), recording.missing.end());
    result.problems = joined(std::move(result.problems), recording.problems);
    if (!recording.figures) continue;
    ++result.joined;
    add(*recording.figures, result.sum);
    if (!recording.doubt.empty()) result.doubtful.push_back({plan.recordings[i], recording.doubt});
    if (!recording.figures->damage.empty()) {
      result.damaged.push_back({plan.recordings[i], recording.figures->damage});
    }
  }
  std::sort(result.missing.begin(), result.missing.end());
  write_summary(files, plan, recordings, result);
  if (result.joined == recordings.size()) {
    // What killed tasks left. A process that still does one of them finds that it is done.
    remove_unfinished(folder);
  }
  return result;
}

}  // namespace mtstereo::run

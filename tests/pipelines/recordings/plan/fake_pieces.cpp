// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fake_pieces.hpp"

#include <chrono>
#include <cstdlib>
#include <thread>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/plan/plan_folder.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

std::string line_of(const Work& work, std::int64_t pair) {
  const FramePair& frames = work.pairs.pairs.at(static_cast<std::size_t>(pair));
  return work.recording.name + " " + std::to_string(pair) + ": " + std::to_string(frames.left) +
         " " + std::to_string(frames.right) + "\n";
}

void wait_for_a_frame() {
  if (const char* milliseconds = std::getenv("MTSTEREO_FAKE_MS")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::stoi(milliseconds)));
  }
}

void note(const std::string& line) {
  if (const char* log = std::getenv("MTSTEREO_FAKE_LOG")) {
    std::ofstream(log, std::ios::app) << line + "\n";
  }
}

}  // namespace

Work fake_work(const std::string& name, std::int64_t pairs) {
  Work work;
  work.recording.name = name;
  work.recording.kind = "two video files";
  work.recording.left.video = "/nowhere/left.mkv";
  work.recording.right.video = "/nowhere/right.mkv";
  work.period = 33'333'333;
  for (FrameIndex* index : {&work.left, &work.right}) {
    index->width = 64;
    index->height = 48;
    index->period = work.period;
    for (std::int64_t i = 0; i < pairs + 100; ++i) index->times.push_back(i * work.period);
  }
  for (std::int64_t i = 0; i < pairs; ++i) work.pairs.pairs.push_back({i, i + 7});
  return work;
}

Work prepare_fake(const std::string& name, std::int64_t pairs) {
  wait_for_a_frame();
  note("prepare " + name);
  return fake_work(name, pairs);
}

PieceReport fake_process(const Work& work, Range range, const fs::path& folder,
                         const Progress& progress) {
  PieceReport report;
  std::ofstream out(folder / kFakeFile, std::ios::binary);
  for (std::int64_t i = range.first; i < range.first + range.count; ++i) {
    wait_for_a_frame();
    out << line_of(work, i) << std::flush;
    const auto pair = static_cast<std::size_t>(i);
    report.frames.push_back({i, work.pairs.pairs.at(pair), 0.5, static_cast<double>(i), 1.0});
    if (progress && !progress(i + 1 - range.first, range.count, 1.0)) break;
  }
  out.close();
  if (!out) throw UserError((folder / kFakeFile).string() + ": cannot be written");
  report.files = {kFakeFile};
  write_piece(report, range, folder / kPieceFile);
  note(work.recording.name + " " + std::to_string(range.first));
  return report;
}

PieceReport fake_join(const Work& work, const std::vector<Range>& ranges,
                      const std::vector<fs::path>& pieces, const fs::path& folder) {
  PieceReport joined;
  std::ofstream out(folder / kFakeFile, std::ios::binary);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Range range;
    const PieceReport piece = read_piece(pieces[i] / kPieceFile, range);
    if (range.first != ranges.at(i).first || range.count != ranges.at(i).count) {
      throw UserError(work.recording.name + ": a piece has another range");
    }
    joined.frames.insert(joined.frames.end(), piece.frames.begin(), piece.frames.end());
    out << read_text(pieces[i] / kFakeFile);
  }
  joined.files = {kFakeFile};
  write_piece(joined, {0, static_cast<std::int64_t>(joined.frames.size())}, folder / kPieceFile);
  return joined;
}

PieceFunctions fake_functions() { return {fake_process, fake_join}; }

void write_plan_of(const std::vector<Work>& works, const Plan& plan, const fs::path& folder) {
  const PlanFolder files(folder);
  fs::create_directories(files.works());
  for (const Work& work : works) write_work(work, files.work(work.recording.name));
  write_plan(plan, folder);
}

void write_fake_plan(const fs::path& folder) {
  Plan plan;
  std::vector<Work> works;
  for (const auto& [name, pairs] : {std::pair("a", 10), std::pair("b", 7)}) {
    plan.recordings.emplace_back(name);
    works.push_back(fake_work(name, pairs));
    const std::vector<Task> tasks = divide(name, pairs, 4);
    plan.tasks.insert(plan.tasks.end(), tasks.begin(), tasks.end());
  }
  write_plan_of(works, plan, folder);
}

std::string uncut(const std::string& name, std::int64_t pairs) {
  const Work work = fake_work(name, pairs);
  std::string text;
  for (std::int64_t i = 0; i < pairs; ++i) text += line_of(work, i);
  return text;
}

}  // namespace mtstereo::run

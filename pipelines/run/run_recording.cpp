// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run/run_recording.hpp"

#include <atomic>
#include <cstdio>
#include <iostream>
#include <string>

#include "run/archive.hpp"
#include "run/json.hpp"
#include "run/json_files.hpp"
#include "run/matching_line.hpp"
#include "run/piece_folder.hpp"
#include "run/progress_line.hpp"
#include "run/run_error.hpp"
#include "run/work_text.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

// Whether the folder has results of this work. Throws if they are others, and may not be replaced.
bool is_done(const Work& work, const Options& options, const fs::path& folder) {
  const std::string existing = fingerprint_in(folder / kRunFile);
  if (existing.empty() || options.overwrite) return false;
  if (!options.resume) {
    throw RunError(folder.string() +
                   ": has results already; choose another folder by --out, or --resume or "
                   "--overwrite");
  }
  if (existing == fingerprint(work)) return true;
  throw RunError(folder.string() +
                 ": has results of another input or other options; choose another folder by --out, "
                 "or --overwrite");
}

void print_summary(const Work& work, const PieceReport& report, const fs::path& folder) {
  double density = 0, median = 0;
  for (const FrameFigures& frame : report.frames) {
    density += frame.density;
    median += frame.median_disparity;
  }
  const double pairs = report.frames.empty() ? 1 : static_cast<double>(report.frames.size());
  char text[200];
  std::snprintf(text, sizeof text, "%zu %s, disparities for %.1f %% of the pixels, median %.2f px",
                report.frames.size(), report.frames.size() == 1 ? "pair" : "pairs",
                100 * density / pairs, median / pairs);
  std::cout << work.recording.name << ": " << text;
  if (work.pairs.dropped_left > 0 || work.pairs.dropped_right > 0) {
    std::cout << ", " << work.pairs.dropped_left << " left and " << work.pairs.dropped_right
              << " right frames without a partner";
  }
  std::cout << ", in " << folder.string() << std::endl;
}

// The exit status of a recording whose results are in the folder.
int status_of(const Recording& recording, const fs::path& folder, bool whole) {
  const std::string doubt = verdict_in(folder / kRunFile);
  if (doubt.empty()) return whole ? kDone : kIncomplete;
  std::cerr << "mtstereo-run: " << recording.name << ": the results are of no use: " << doubt
            << '\n';
  return kWorthless;
}

}  // namespace

void request_stop() noexcept { stop = true; }

bool stop_requested() noexcept { return stop; }

Work prepare_recording(const Recording& recording, const Options& options) {
  const bool two = recording.arrangement == Arrangement::kTwoSources;
  return prepare(recording, options.work, two ? options.relation : std::nullopt,
                 two && options.estimate);
}

std::string preparation_settings(const Options& options) {
  Json json = options_json(options.work);
  json.erase("threads");  // they do not change the results
  json["estimate"] = options.estimate;
  if (options.relation) json["relation"] = {options.relation->offset, options.relation->drift};
  return json.dump();
}

int run_recording(const Recording& recording, const Options& options, const fs::path& folder) {
  if (!options.resume && !options.overwrite && !fingerprint_in(folder / kRunFile).empty()) {
    is_done({}, options, folder);
  }
  ProgressLine progress(recording.name, options.quiet);
  const Work work = prepare_recording(with_absolute_paths(recording), options);
  if (!options.quiet) {
    for (const std::string& line : recognized(work)) {
      std::cerr << recording.name << ": " << line << '\n';
    }
  }
  for (const std::string& remark : work.remarks) {
    std::cerr << recording.name << ": " << remark << '\n';
  }
  if (is_done(work, options, folder)) {
    std::cout << recording.name << ": was done before, in " << folder.string() << std::endl;
    return status_of(recording, folder, true);
  }
  const Range all{0, static_cast<std::int64_t>(work.pairs.pairs.size())};
  const int lanes = lanes_for(work.options.threads).count;
  const PieceReport report = process(
      work, all, folder,
      [&progress, lanes](std::int64_t done, std::int64_t total, double milliseconds) {
        progress.show(done, total, milliseconds / lanes);
        return !stop || done == total;
      },
      options.resume ? Unfinished::kContinue : Unfinished::kDiscard);
  progress.finish();
  write_run_report(work, report, progress.seconds(), folder / kRunFile);
  std::error_code ignored;
  fs::remove(folder / kPieceFile, ignored);
  print_summary(work, report, folder);
  if (!report.damage.empty()) {
    std::cerr << "mtstereo-run: " << recording.name << ": " << report.damage << '\n';
  }
  const bool whole = report.damage.empty() && work.left.damage.empty() && work.right.damage.empty();
  return status_of(recording, folder, whole);
}

}  // namespace mtstereo::run

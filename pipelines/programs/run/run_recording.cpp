// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/run_recording.hpp"

#include <iostream>
#include <optional>
#include <string>

#include "lib/outputs/folder_lock.hpp"
#include "lib/outputs/json_text.hpp"
#include "lib/outputs/printable.hpp"
#include "lib/outputs/texts.hpp"
#include "lib/outputs/user_error.hpp"
#include "programs/run/interruption.hpp"
#include "programs/run/progress_line.hpp"
#include "recordings/matching/json.hpp"
#include "recordings/matching/json_files.hpp"
#include "recordings/matching/matching_line.hpp"
#include "recordings/matching/results.hpp"
#include "recordings/matching/work_text.hpp"
#include "recordings/plan/archive.hpp"

namespace mtstereo::run {
namespace {

namespace fs = std::filesystem;

// Whether the folder has results of this work that are whole. Throws if they are of another one.
bool is_done(const Work& work, Existing existing, const fs::path& folder) {
  const std::string found = fingerprint_in(folder / kRunFile);
  if (found.empty() || existing == Existing::kReplace) return false;
  if (found == fingerprint(work)) {
    const std::string defect = defect_of_results(folder);
    if (defect.empty()) return true;
    std::cerr << "mtstereo-run: " << work.recording.name << ": " << outputs::printable(defect)
              << ", in " << outputs::printable(folder.string()) << ": it is done again\n";
    return false;
  }
  throw UserError(
      folder.string() +
      ": has results of another input or other options; choose another folder by --out, "
      "or --overwrite");
}

void print_summary(const Work& work, const PieceReport& report, const fs::path& folder) {
  const FrameFigures mean = mean_of(report.frames);
  std::cout << work.recording.name << ": " << outputs::counted(report.frames.size(), "pair")
            << outputs::format(", disparities for %.1f %% of the pixels, median %.2f px",
                               100 * mean.density, mean.median_disparity);
  if (work.pairs.dropped_left > 0 || work.pairs.dropped_right > 0) {
    std::cout << ", " << work.pairs.dropped_left << " left and " << work.pairs.dropped_right
              << " right frames without a partner";
  }
  std::cout << ", in " << outputs::printable(folder.string()) << std::endl;
}

PieceReport process_all(const Work& work, const fs::path& folder, Existing existing,
                        ProgressLine& progress) {
  const Range all{0, static_cast<std::int64_t>(work.pairs.pairs.size())};
  const int lanes = lanes_for(work.options.threads).count;
  const auto show = [&progress, lanes](std::int64_t done, std::int64_t total, double milliseconds) {
    progress.show(done, total, milliseconds / lanes);
    return !stop_requested() || done == total;
  };
  PieceReport report = process(work, all, folder, show, existing);
  progress.finish();
  write_run_report(work, report, progress.seconds(), folder / kRunFile);
  std::error_code ignored;
  fs::remove(folder / kPieceFile, ignored);
  return report;
}

bool is_whole(const Work& work, const PieceReport& report) {
  if (!report.damage.empty()) {
    std::cerr << "mtstereo-run: " << work.recording.name << ": "
              << outputs::printable(report.damage) << '\n';
  }
  return report.damage.empty() && work.left.damage.empty() && work.right.damage.empty();
}

// The exit status of a recording whose results are in the folder.
int status_of(const Recording& recording, const fs::path& folder, bool whole) {
  const std::string doubt = verdict_in(folder / kRunFile);
  if (doubt.empty()) return whole ? kDone : kIncomplete;
  std::cerr << "mtstereo-run: " << recording.name
            << ": the results are useless: " << outputs::printable(doubt) << '\n';
  return kWorthless;
}

}  // namespace

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
  return outputs::text_of(std::move(json));
}

int run_recording(const Recording& found, const Options& options, const fs::path& folder) {
  std::optional<outputs::FolderLock> lock;
  if (folder != options.folder) lock.emplace(folder);
  const Existing existing = options.existing();
  const Recording recording = with_absolute_paths(found);
  check_results_folder(folder, recording, options.work, existing);
  ProgressLine progress(recording.name, options.quiet);
  const Work work = prepare_recording(recording, options);
  if (!options.quiet) {
    for (const std::string& line : recognized(work)) {
      std::cerr << recording.name << ": " << outputs::printable(line) << '\n';
    }
  }
  for (const std::string& remark : work.remarks) {
    std::cerr << recording.name << ": " << outputs::printable(remark) << '\n';
  }
  if (is_done(work, existing, folder)) {
    std::cout << recording.name << ": was done before, in " << outputs::printable(folder.string())
              << std::endl;
    return status_of(recording, folder, true);
  }
  const OrderlyStop orderly;
  try {
    const PieceReport report = process_all(work, folder, existing, progress);
    print_summary(work, report, folder);
    return status_of(recording, folder, is_whole(work, report));
  } catch (const WriteError& error) {
    if (!is_interrupted(folder)) throw;
    std::cerr << "mtstereo-run: " << error.what() << "; --resume continues\n";
    return kIncomplete;
  }
}

}  // namespace mtstereo::run

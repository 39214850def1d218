// SPDX-License-Identifier: LGPL-2.1-or-later

// process(): the pairs of a piece, and their files.

#include <numeric>
#include <string>

#include "lib/outputs/user_error.hpp"
#include "recordings/matching/matching_run.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/matching/piece_folder.hpp"
#include "recordings/matching/product_files.hpp"
#include "recordings/media/damage_notes.hpp"

namespace mtstereo::run {
namespace {

void check_range(const Work& work, Range range) {
  const auto pairs = static_cast<std::int64_t>(work.pairs.pairs.size());
  if (range.first >= 0 && range.count > 0 && range.count <= pairs - range.first) return;
  throw UserError(work.recording.name + ": has pairs 0 to " + std::to_string(pairs - 1) +
                  "; the piece has " + std::to_string(range.count) + " from " +
                  std::to_string(range.first) + " on");
}

std::vector<std::int64_t> numbers(std::int64_t first, std::int64_t end) {
  std::vector<std::int64_t> pairs(static_cast<std::size_t>(end - first));
  std::iota(pairs.begin(), pairs.end(), first);
  return pairs;
}

bool has_two_sources(const Work& work) {
  return work.recording.arrangement == Arrangement::kTwoSources;
}

}  // namespace

PieceReport process(const Work& work, Range range, const std::filesystem::path& folder,
                    const Progress& progress, Existing existing) {
  check_range(work, range);
  PieceFolder piece(work, range, folder, existing);
  if (std::optional<PieceReport> whole = piece.whole()) {
    piece.finish(*whole);
    return *whole;
  }
  PieceReport report;
  // All memory is taken at the start, and does not grow with the pairs.
  report.frames.resize(static_cast<std::size_t>(range.count));
  report.frames = piece.done();
  const std::int64_t first = report.frames.empty() ? range.first : report.frames.back().pair + 1;
  const std::int64_t end = range.first + range.count;
  const std::int64_t missing = first - range.first - std::ssize(report.frames);
  if (missing > 0) {
    report.damage =
        std::to_string(missing) + " pairs could not be decoded before the run was interrupted";
  }
  ProductFiles files(work, piece.unfinished(), static_cast<std::int64_t>(report.frames.size()));
  if (first < end) {
    const Lanes lanes = lanes_for(work.options.threads);
    MatchingRun run(work, numbers(first, end), matching_pipeline(work, lanes), lanes.count,
                    piece.damaged());
    while (const std::optional<PairResult> result = run.next()) {
      report.frames.push_back(files.write(*result));
      const FrameFigures& figures = report.frames.back();
      piece.note(figures, run.take_notes(figures.pair));
      const std::int64_t done = figures.pair + 1 - range.first;
      if (progress && !progress(done, range.count, figures.matching_ms)) {
        throw UserError(work.recording.name + ": stopped after " + std::to_string(done) + " of " +
                        std::to_string(range.count) + " pairs");
      }
    }
    add_damage(report.damage, run.damage());
  } else {
    add_damage(report.damage, damage_text(piece.damaged(), has_two_sources(work)));
  }
  files.finish();
  piece.finish(report);
  return report;
}

}  // namespace mtstereo::run

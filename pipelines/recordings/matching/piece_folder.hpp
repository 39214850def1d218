// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "recordings/matching/piece.hpp"
#include "recordings/matching/results.hpp"
#include "recordings/media/damage_notes.hpp"

namespace mtstereo::run {

/// The folder of a piece. While it is processed, its files are in the folder `unfinished` in it,
/// and a journal there has the figures of the pairs that are done.
class PieceFolder {
 public:
  /// Prepares the folder. With Existing::kContinue, the pairs of an interrupted run are kept.
  /// Throws UserError if something is in the way.
  PieceFolder(const Work& work, Range range, std::filesystem::path folder, Existing existing);
  /// Removes the unfinished files unless a pair is done.
  ~PieceFolder();
  PieceFolder(const PieceFolder&) = delete;
  PieceFolder& operator=(const PieceFolder&) = delete;

  /// The folder of unfinished files.
  std::filesystem::path unfinished() const { return unfinished_in(folder_); }
  /// The report of an interrupted run that had done all pairs, for finish().
  const std::optional<PieceReport>& whole() const { return whole_; }
  /// The figures of the pairs that were done before.
  const std::vector<FrameFigures>& done() const { return done_; }
  /// The damaged frames that were found before.
  const std::vector<DamageNote>& damaged() const { return damaged_; }
  /// Notes a pair whose files are written, and the damaged frames up to it.
  void note(const FrameFigures& figures, const std::vector<DamageNote>& damaged);
  /// Replaces the results in the folder by the unfinished ones, and writes the report, whose files
  /// it lists. If it is interrupted, the next run with Existing::kContinue does the rest.
  void finish(PieceReport& report);

 private:
  bool read_journal(const std::string& head);
  bool read_whole();
  void keep_whole_frames();
  void write_journal(const std::string& head);
  std::filesystem::path journal() const { return journal_in(folder_); }
  void complete(PieceReport& report) const;
  void publish(const PieceReport& report);

  const Work& work_;
  Range range_;
  std::filesystem::path folder_;
  std::vector<FrameFigures> done_;
  std::vector<DamageNote> damaged_;
  std::optional<PieceReport> whole_;
  std::ofstream stream_;
  bool any_done_ = false;
};

}  // namespace mtstereo::run

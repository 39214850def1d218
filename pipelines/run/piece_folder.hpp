// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "run/piece.hpp"

namespace mtstereo::run {

/// The folder of a piece. While it is processed, its files are in the folder `unfinished` in it,
/// and a journal there has the figures of the pairs that are done.
class PieceFolder {
 public:
  /// Prepares the folder. Results of the same work and range that were interrupted are kept if
  /// `unfinished` says so. Throws RunError.
  PieceFolder(const Work& work, Range range, std::filesystem::path folder, Unfinished unfinished);

  /// The folder of unfinished files.
  std::filesystem::path unfinished() const { return folder_ / "unfinished"; }
  /// The figures of the pairs that were done before.
  const std::vector<FrameFigures>& done() const { return done_; }
  /// Notes a pair whose files are written.
  void note(const FrameFigures& figures);
  /// Replaces the files of the folder by the unfinished ones, and writes the report, whose files it
  /// lists.
  void finish(PieceReport& report);

 private:
  bool read_journal(const std::string& head);
  void keep_whole_frames();
  void write_journal(const std::string& head);
  std::filesystem::path journal() const { return unfinished() / "journal"; }

  const Work& work_;
  Range range_;
  std::filesystem::path folder_;
  std::vector<FrameFigures> done_;
  std::ofstream stream_;
};

/// The files below a folder that are results, relative to it and sorted.
std::vector<std::string> result_files(const WorkOptions& options,
                                      const std::filesystem::path& folder);
/// Removes results from a folder, and its report first, so that it is not taken for whole.
void remove_results(const std::filesystem::path& folder);

}  // namespace mtstereo::run

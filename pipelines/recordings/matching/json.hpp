// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lib/outputs/written_files.hpp"
#include "recordings/inputs/own_names.hpp"
#include "recordings/matching/piece.hpp"

// The JSON of mtstereo-run: a Work in the folder of a plan, a PieceReport beside its files, and the
// report of a run, run.json.

namespace mtstereo::run {

/// Writes a work, so that another process can do a piece of it. Written aside and renamed.
void write_work(const Work& work, const std::filesystem::path& file);
/// Reads it. Throws UserError for a file that is missing, damaged or of another version.
Work read_work(const std::filesystem::path& file);

/// The report of a piece.
void write_piece(const PieceReport& report, Range range, const std::filesystem::path& file);
/// Reads it. Throws UserError.
PieceReport read_piece(const std::filesystem::path& file, Range& range);

/// Differs for works that give different results.
std::string fingerprint(const Work& work);

/// The reports in a folder of results: what they list, a run of this program wrote.
inline constexpr std::array kReportFiles{kPieceFile, kRunFile};

/// The means of the figures of frames; 0 without any.
FrameFigures mean_of(const std::vector<FrameFigures>& frames);
/// The report of a run: parameters, versions, inputs, figures per frame and their means, dropped
/// frames, remarks.
void write_run_report(const Work& work, const PieceReport& report, double seconds,
                      const std::filesystem::path& file);
/// Why the results of a work are useless: Work::doubt, or a mean density below 5 %. Empty if they
/// can be used.
std::string verdict(const Work& work, const PieceReport& report);
/// The verdict in such a report; empty if there is none.
std::string verdict_in(const std::filesystem::path& file);
/// The files that such a report, or that of a piece, lists; std::nullopt if
/// missing or not a report.
std::optional<outputs::WrittenFiles> files_listed_in(const std::filesystem::path& file);
/// The fingerprint() of the work of such a report; empty if missing or not a report.
std::string fingerprint_in(const std::filesystem::path& file);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/outputs/written_files.hpp"
#include "recordings/matching/piece.hpp"

// What belongs to this program in a folder of results: what the reports in it list, and the folder
// of unfinished files if it has a journal of this program.

namespace mtstereo::run {

/// The folder of unfinished files in a folder of results.
std::filesystem::path unfinished_in(const std::filesystem::path& folder);
/// The journal in it.
std::filesystem::path journal_in(const std::filesystem::path& folder);

/// The files that the reports in a folder of results list, with the reports.
outputs::WrittenFiles results_in(const std::filesystem::path& folder);

/// The files of this program in its folder of unfinished files; paths in `folder`.
outputs::WrittenFiles unfinished_files_in(const std::filesystem::path& folder);

/// Throws UserError if a file that this program did not write, or an input, is in the way of the
/// results of a recording, or if there are results or unfinished files already and they may be
/// neither replaced nor continued. `head`: of the journal of this work; empty: of any.
void check_results_folder(const std::filesystem::path& folder, const Recording& recording,
                          const WorkOptions& options, Existing existing,
                          const std::string& head = {});

/// Whether the folder has pairs of an interrupted run, which can be continued.
bool is_interrupted(const std::filesystem::path& folder);

/// What is wrong with the results that run.json lists, such as "disparity.mkv is missing"; empty if
/// they are whole.
std::string defect_of_results(const std::filesystem::path& folder);

/// The files that were written of each product, in a folder of results or of unfinished files.
std::vector<std::string> result_files(const WorkOptions& options,
                                      const std::filesystem::path& folder);

/// Removes the files that the reports in a folder list, except `kept`, which is sorted, and the
/// reports.
void remove_results(const std::filesystem::path& folder, const std::vector<std::string>& kept = {});

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "lib/outputs/written_files.hpp"

// What belongs to this program in the folder of a plan. Only that is replaced and removed.

namespace mtstereo::run {

/// The files in a folder of pieces or of a recording that its whole.json, or its report, lists,
/// with these; paths in `folder`.
outputs::WrittenFiles whole_files_in(const std::filesystem::path& folder);

/// The first thing in such a folder that is not of this program, with what to do; empty if there is
/// none.
std::string foreign_file_in(const std::filesystem::path& folder);
/// Removes the listed files of such a folder, and the folder if it is empty then.
void remove_listed(const std::filesystem::path& folder);

/// Throws UserError if a file or folder has a name of a plan and is not of this program, or if a
/// file of the plan is an input.
void check_plan_folder(const std::filesystem::path& folder, const outputs::FileSet& inputs);
/// The same for a file such as plan.json or summary.json.
void check_plan_file(const std::filesystem::path& file);

/// Removes what tasks that were killed have left, but no foreign files.
void remove_unfinished(const std::filesystem::path& folder);

/// Removes a plan with its pieces and results; other files in the folder stay. Throws UserError.
void remove_plan(const std::filesystem::path& folder);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <functional>

namespace mtstereo::run {

/// Whether a folder is kept; it is given the place where the folder is meanwhile.
using IsKept = std::function<bool(const std::filesystem::path&)>;

/// Removes a folder of pieces or of a recording: it is renamed into `parent` first, so that none of
/// its files is missing while its name exists. Does nothing if there is none. Other processes may
/// replace or discard it at the same time: what counts is the folder that was renamed. If it is
/// kept, it gets its name back. Returns false if it is kept. Throws UserError if the folder has a
/// file that is not of this program; the file stays.
bool discard(const std::filesystem::path& folder, const std::filesystem::path& parent,
             const IsKept& is_kept = nullptr);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "programs/run/options.hpp"

namespace mtstereo::run {

/// Processes a recording into a folder, and prints remarks, progress and a summary. Returns the
/// exit status: kDone, kIncomplete if the input is damaged or a full disk, for example, stopped the
/// run, or kWorthless. Throws UserError.
int run_recording(const Recording& recording, const Options& options,
                  const std::filesystem::path& folder);

/// The same in the processes of this program, or its preparation: prepare() with these options.
Work prepare_recording(const Recording& recording, const Options& options);
/// All options that prepare_recording() depends on, as text.
std::string preparation_settings(const Options& options);

}  // namespace mtstereo::run

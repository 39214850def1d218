// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace mtstereo::run {

/// The search path of GStreamer with a folder added at its end: what the user has set comes first.
/// A folder that is in the path already is not added again.
std::string plugin_path_with(const std::string& path, const std::filesystem::path& folder);

/// The folder with the plugin of the same installation as this program; empty if there is none, as
/// in a build folder, or if GStreamer searches that folder anyway.
std::filesystem::path own_plugin_folder(const std::filesystem::path& program);

/// Lets GStreamer find the plugin of the same installation. Call it before GStreamer is
/// initialized and before other threads run: it changes the environment.
void use_own_plugin();

}  // namespace mtstereo::run

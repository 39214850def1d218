// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/own_plugin.hpp"

#include <cstdlib>
#include <system_error>

namespace mtstereo::run {
namespace fs = std::filesystem;

std::string plugin_path_with(const std::string& path, const fs::path& folder) {
  if (path.empty()) return folder.string();
  if ((":" + path + ":").find(":" + folder.string() + ":") != std::string::npos) return path;
  return path + ":" + folder.string();
}

fs::path own_plugin_folder(const fs::path& program) {
  const fs::path folder = (program.parent_path() / MTSTEREO_PLUGIN_FROM_PROGRAM).lexically_normal();
  std::error_code ignored;
  if (folder == MTSTEREO_SEARCHED_PLUGIN_FOLDER) return {};
  if (!fs::exists(folder / "libgstmtstereo.so", ignored)) return {};
  return folder;
}

void use_own_plugin() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return;
  const fs::path folder = own_plugin_folder(program);
  if (folder.empty()) return;
  // GStreamer reads the first of these that is set.
  constexpr const char* kVersioned = "GST_PLUGIN_PATH_1_0";
  const char* const name = std::getenv(kVersioned) != nullptr ? kVersioned : "GST_PLUGIN_PATH";
  const char* const path = std::getenv(name);
  setenv(name, plugin_path_with(path != nullptr ? path : "", folder).c_str(), 1);
}

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/compare/frame_files.hpp"

#include <stdexcept>

#include "lib/files/file_names.hpp"
#include "tools/eval/files.hpp"

namespace mtstereo::apps {

namespace fs = std::filesystem;
using eval::files_in;

std::map<std::string, fs::path> by_name(const fs::path& folder, const std::string& extension) {
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(folder.string() + ": no such folder");
  }
  std::map<std::string, fs::path> files;
  for (const auto& file : files_in(folder)) {
    if (files::extension_of(file) == extension) files[file.stem().string()] = file;
  }
  if (files.empty()) {
    throw std::runtime_error(folder.string() + ": contains no " + extension + " file");
  }
  return files;
}

const fs::path& partner(const std::map<std::string, fs::path>& files, const fs::path& folder,
                        const std::string& name) {
  const auto found = files.find(name);
  if (found == files.end()) {
    throw std::runtime_error(folder.string() + ": frame " + name + " is missing");
  }
  return found->second;
}

}  // namespace mtstereo::apps

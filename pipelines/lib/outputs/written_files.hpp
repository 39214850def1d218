// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

// What a program may replace and remove: only files that it has written before, and that nobody has
// changed since.

namespace mtstereo::outputs {

/// The files that a program has written into a folder.
class WrittenFiles {
 public:
  /// `name`: the path in the folder. Names that lead out of it are ignored. `bytes`: the size;
  /// none: it is not known.
  void add(const std::string& name, std::optional<std::uintmax_t> bytes = std::nullopt);
  bool empty() const { return files_.empty(); }
  /// Whether it has the name.
  bool has(const std::string& name) const { return files_.count(name) != 0; }
  /// By their names.
  const std::map<std::string, std::optional<std::uintmax_t>>& files() const { return files_; }

 private:
  std::map<std::string, std::optional<std::uintmax_t>> files_;
};

/// Files by what they are, and not by their names: links to a file count as the file.
class FileSet {
 public:
  FileSet() = default;
  /// Files that do not exist are ignored.
  explicit FileSet(const std::vector<std::filesystem::path>& files);
  bool has(const std::filesystem::path& file) const;

 private:
  std::set<std::pair<dev_t, ino_t>> files_;
};

/// What a run will do with a folder.
struct Intent {
  std::vector<std::string> targets;  ///< files and folders that it writes: paths in the folder
  WrittenFiles written;              ///< files that it may replace, and that it removes
  FileSet inputs;
};

/// The first thing in the folder that stands in the way, with what to do; empty if there is none:
/// an input that would be replaced or removed, a file that is not `written` or has changed since, a
/// link, a device, or a folder that has others.
std::string obstacle_in(const std::filesystem::path& folder, const Intent& intent);

/// Removes the written files that are unchanged, and the folders that are empty then; not `folder`
/// itself.
void remove_written(const std::filesystem::path& folder, const WrittenFiles& written);

/// The first written file that is missing or has another size, such as "disparity.mkv is missing";
/// empty if there is none.
std::string defect_of(const std::filesystem::path& folder, const WrittenFiles& written);

}  // namespace mtstereo::outputs

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/outputs/folder_lock.hpp"
#include "lib/outputs/written_files.hpp"

namespace mtstereo::outputs {

/// A folder in which a program lists the files that it writes, in a hidden file (.PROGRAM-files),
/// so that its next run knows which ones it may replace. Every call throws UserError.
class ListedFolder {
 public:
  /// Creates the folder, and locks it. `program`: its name.
  ListedFolder(std::filesystem::path folder, std::string program);

  /// Throws if something is in the way of files and folders, or if an input would be removed.
  void check(std::vector<std::string> targets, const FileSet& inputs) const;
  /// Removes the files of earlier runs that are unchanged.
  void clear();
  /// Writes a file, and lists it.
  void write(const std::string& name, std::string_view bytes);
  /// Lists a file that the caller writes next, and returns its path.
  std::filesystem::path listed(const std::string& name);
  /// Lists files in both folders under either name: the caller exchanges the folders next.
  void exchange(const std::string& folder, const std::string& other);
  /// Lists the size of a file that the caller has written.
  void measure(const std::string& name);

 private:
  void make_room(const std::string& name) const;
  void list(const std::string& name, std::optional<std::uintmax_t> bytes);

  std::filesystem::path folder_;
  std::string list_, head_;  // name and first line of the list
  FolderLock lock_;
  WrittenFiles written_;
};

}  // namespace mtstereo::outputs

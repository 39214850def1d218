// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <list>

namespace mtstereo::outputs {

/// Who may use a folder at the same time.
enum class Sharing {
  kAlone,   ///< nobody else
  kShared,  ///< others that share it too
};

/// A folder that this process writes into. The operating system releases the lock when the process
/// ends, however it ends. On a network file system, it works between processes of one machine.
class FolderLock {
 public:
  /// Creates the folder if it is missing. Throws UserError, which names the other process, if it
  /// is locked.
  explicit FolderLock(const std::filesystem::path& folder, Sharing sharing = Sharing::kAlone);
  /// Removes the folders that it created and that are still empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void create(const std::filesystem::path& folder);
  void remove_empty();
  bool lock(const std::filesystem::path& folder, Sharing sharing);

  int file_ = -1;
  std::list<std::filesystem::path> created_;  // the inner ones first; handlers have their texts
};

/// Removes the folders that locks of this process created and that are still empty. May be called
/// by a signal handler.
void remove_empty_folders() noexcept;

}  // namespace mtstereo::outputs

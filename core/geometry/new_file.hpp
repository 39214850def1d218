// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mtstereo/result.hpp"

namespace mtstereo {

/// A file that is written aside and renamed when it is complete. Every error is a kSystem error
/// that names the file and the reason.
class NewFile {
 public:
  /// `path`: of the complete file.
  explicit NewFile(std::string path);
  /// Removes what was written unless finish() succeeded.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Creates the file aside. Fails if `path` exists and is not a regular file, such as a folder or
  /// a device, or if something else wrote it: it is not empty, and its first 256 bytes lack `mark`.
  /// Without a mark, the caller knows that it may be replaced.
  Status open(std::string_view mark = {});
  /// Appends bytes.
  Status write(const void* data, std::size_t size);
  /// Waits until the bytes are on the disk, so that the complete file also survives a loss of
  /// power.
  Status sync();
  /// Closes the file and gives it its name; replaces an existing file of this name.
  Status finish();

 private:
  Error failure(const char* what, int number) const;

  std::string path_;
  std::string aside_;
  int file_ = -1;
};

}  // namespace mtstereo

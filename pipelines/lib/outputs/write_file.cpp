// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lib/outputs/write_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "geometry/new_file.hpp"
#include "lib/outputs/user_error.hpp"

namespace mtstereo::outputs {

namespace fs = std::filesystem;

namespace {

// The number of the error; 0 if `from` is now `to`.
int rename_to_new(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // The file system cannot do it in one step.
  std::error_code error;
  if (fs::symlink_status(to, error).type() != fs::file_type::not_found) return EEXIST;
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace

void write_file(const fs::path& file, std::string_view bytes) {
  NewFile out(file.string());
  Status status = out.open();
  if (status) status = out.write(bytes.data(), bytes.size());
  if (status) status = out.finish();
  if (!status) throw WriteError(status.error().message);
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  if (fs::is_directory(fs::symlink_status(from, ignored))) rmdir(to.c_str());
  const int error = rename_to_new(from, to);
  if (error == 0) return;
  throw UserError(to.string() + ": cannot be written: " +
                  (error == EEXIST ? "it has appeared meanwhile; move it, and start again"
                                   : std::generic_category().message(error)));
}

}  // namespace mtstereo::outputs

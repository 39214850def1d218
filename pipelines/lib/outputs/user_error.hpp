// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "lib/outputs/printable.hpp"

namespace mtstereo {

/// An input, an option, a file or a folder that cannot be used. The message names it, and states
/// the reason and what to do.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& what) : std::runtime_error(outputs::printable(what)) {}
  UserError(const std::filesystem::path& file, const std::string& what)
      : UserError(file.string() + ": " + what) {}
};

/// A file that cannot be written, such as on a full disk. The same run can be continued when the
/// cause is gone.
class WriteError : public UserError {
 public:
  using UserError::UserError;
};

/// By errno.
inline WriteError write_error(const std::filesystem::path& file) {
  return WriteError(file.string() + ": cannot be written" +
                    (errno == 0 ? "" : ": " + std::generic_category().message(errno)));
}

}  // namespace mtstereo

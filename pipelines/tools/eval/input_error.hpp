// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "lib/outputs/printable.hpp"

namespace mtstereo::eval {

/// A file or folder that cannot be used. The message names it and states the reason. The program
/// reports the error, skips the pair and continues with the next one.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(outputs::printable(what)) {}
  InputError(const std::filesystem::path& file, const std::string& what)
      : InputError(file.string() + ": " + what) {}
};

}  // namespace mtstereo::eval

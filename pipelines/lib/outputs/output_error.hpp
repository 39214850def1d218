// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "lib/outputs/printable.hpp"

namespace mtstereo::outputs {

/// A file or folder that cannot be written. The message names it, and states the reason and what to
/// do.
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& what) : std::runtime_error(printable(what)) {}
};

}  // namespace mtstereo::outputs

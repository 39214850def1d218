// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace mtstereo::run {

/// An input, an option or a folder of results that cannot be used. The message names it, and states
/// the reason and what to do.
class RunError : public std::runtime_error {
 public:
  explicit RunError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace mtstereo::run

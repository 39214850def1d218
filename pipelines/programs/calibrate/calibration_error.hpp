// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "lib/outputs/printable.hpp"

namespace mtstereo::calibrate {

/// A source, a board or a set of views that cannot be used. The message names it, and states the
/// reason and what to do.
class CalibrationError : public std::runtime_error {
 public:
  explicit CalibrationError(const std::string& what)
      : std::runtime_error(outputs::printable(what)) {}
};

/// A number with this many decimals.
std::string decimal(double value, int decimals);

/// A number with its noun: "1 view", "3 views".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace mtstereo::calibrate

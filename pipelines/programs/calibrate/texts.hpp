// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

namespace mtstereo::calibrate {

/// A number with this many decimals.
std::string decimal(double value, int decimals);

/// A number with its noun: "1 view", "3 views".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace mtstereo::calibrate

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>

namespace mtstereo::outputs {

/// A text by the pattern of printf().
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

/// A number with this many decimals.
std::string decimal(double value, int decimals);

/// A fraction: "12 %".
std::string percent(double fraction, int decimals = 0);

/// A number with its noun: "1 view", "3 views".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace mtstereo::outputs

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace mtstereo::outputs {

/// A fraction for a message: "12 %".
inline std::string percent(double fraction, int decimals = 0) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f %%", decimals, 100 * fraction);
  return text.data();
}

}  // namespace mtstereo::outputs

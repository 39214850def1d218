// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/calibrate/texts.hpp"

#include <array>
#include <cstdio>

namespace mtstereo::calibrate {

std::string decimal(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace mtstereo::calibrate

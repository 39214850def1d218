// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace mtstereo::outputs {

/// The bytes of a portable float map: little-endian, the last row first. `value(x, y)` is a float.
template <typename Value>
std::string pfm_bytes(int width, int height, const Value& value) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  bytes.reserve(bytes.size() +
                sizeof(float) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const auto bits = std::bit_cast<std::uint32_t>(value(x, y));
      for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
    }
  }
  return bytes;
}

}  // namespace mtstereo::outputs

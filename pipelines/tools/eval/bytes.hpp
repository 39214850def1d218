// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace mtstereo::eval {

/// The 32-bit float stored at `bytes` in this byte order.
inline float load_float(const char* bytes, std::endian order) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  if (order != std::endian::native) bits = __builtin_bswap32(bits);
  return std::bit_cast<float>(bits);
}

}  // namespace mtstereo::eval

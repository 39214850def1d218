// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// Internal to enlarging.cpp: the type that the kernels of all SIMD targets share.

namespace mtstereo {

/// The input of one row of the enlarged map.
struct EnlargedRow {
  const std::int32_t* nearest;  ///< the row of half pixels that contains the row
  const std::int32_t* next;     ///< the nearest other row of half pixels
  std::int32_t limit;           ///< largest disparity that is written
};

}  // namespace mtstereo

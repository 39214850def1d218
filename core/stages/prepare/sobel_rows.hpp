// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// Internal to preprocess.cpp: the types that the kernels of all SIMD targets share.

namespace mtstereo {

/// The three image rows that a Sobel operator reads. At the border two of them are the same row.
struct SobelRows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

/// Two rows of sums along the columns, with one element before and one after the row for the
/// mirrored border. One vector after the row can be read and written.
struct SobelSums {
  std::int16_t* smooth;      ///< vertical 1 2 1
  std::int16_t* difference;  ///< vertical -1 0 1
};

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "stages/prepare/census.hpp"

namespace mtstereo {

/// Part of the step census-matching: pixels without texture around them, as in saturated areas,
/// black borders and flat skies, get no disparity. All disparities cost the same there, and the
/// smoothness alone would select one.

/// Side of the window that needs a darker neighbor somewhere [px].
inline constexpr int kTextureWindow = 5;

/// Scratch memory of one thread: the bits of a row's columns.
struct TextureScratch {
  Buffer<std::uint32_t> columns;

  void resize(int width);
};

/// Sets the expected range of the pixels of row y around which no pixel of the window has a census
/// bit to low = 1, high = 0: no disparity is possible.
void exclude_flat(const CensusImage& census, int y, TextureScratch& scratch, std::uint16_t* low,
                  std::uint16_t* high);

}  // namespace mtstereo

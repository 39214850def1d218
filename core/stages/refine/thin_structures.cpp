// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_structures.hpp"

#include <algorithm>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

/// Columns that are looked at together.
constexpr int kBlock = 32;

/// Whether a value of a block is negative; compilers vectorize the loop.
bool any_negative(const std::int32_t* values) {
  std::int32_t bits = 0;
  for (int i = 0; i < kBlock; ++i) bits |= values[i];
  return bits < 0;
}

/// Calls body(x, unfiltered disparity) for the negative ones of a row.
template <typename Body>
void for_negative(const std::int32_t* row, int width, Body&& body) {
  for (int begin = 0; begin < width; begin += kBlock) {
    const int end = std::min(begin + kBlock, width);
    // Thin structures are rare.
    if (begin + kBlock == end && !any_negative(row + begin)) continue;
    for (int x = begin; x < end; ++x) {
      if (row[x] < 0) body(x, row[x]);
    }
  }
}

/// Without branches, so that compilers vectorize the loop.
void clear_covered(const std::int32_t* __restrict__ unfiltered, int width,
                   std::int32_t* __restrict__ map, std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const bool covered = (unfiltered[x] > 0) & (unfiltered[x] - map[x] > kForegroundStep);
    map[x] = covered ? kNoDisparity : map[x];
    confidence[x] = covered ? std::uint8_t{0} : confidence[x];
  }
}

}  // namespace

void copy_map(const Image<std::int32_t>& map, int y0, int y1, UnfilteredMap& unfiltered) {
  for (int y = y0; y < y1; ++y) std::copy_n(map.row(y), map.width(), unfiltered.row(y));
}

void draw_thin(const UnfilteredMap& unfiltered, int confidence, int y0, int y1,
               Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence) {
  const auto least = static_cast<std::uint8_t>(std::max(confidence, 1));
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* row_confidence = map_confidence.row(y);
    for_negative(unfiltered.row(y), map.width(), [&](int x, std::int32_t value) {
      row[x] = -value;
      row_confidence[x] = std::max(row_confidence[x], least);
    });
  }
}

void remove_covered(const UnfilteredMap& unfiltered, int y0, int y1, Image<std::int32_t>& map,
                    Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    clear_covered(unfiltered.row(y), map.width(), map.row(y), confidence.row(y));
  }
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/gap_filling.hpp"

#include <algorithm>
#include <cstdlib>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

/// Fills the pixels 1 .. steps - 1 after `first`, which is pixel 0; pixel `steps` is the gap's
/// other end. The strides are from pixel to pixel [elements].
void fill_gap(const GapFilling& gaps, int steps, std::ptrdiff_t map_stride, std::int32_t* first,
              std::ptrdiff_t confidence_stride, std::uint8_t* first_confidence) {
  const std::uint8_t weaker =
      std::min(*first_confidence, first_confidence[steps * confidence_stride]);
  const std::uint8_t confidence = std::clamp<std::uint8_t>(weaker / 2, 1, gaps.most_confidence);
  // Pixel k gets first + k * rise / steps plus one half, truncated. The whole part and the
  // remainder, in 1 / (2 * steps), grow by the same amounts from pixel to pixel, so that one
  // division is enough. The result lies between the ends and so is at least 1.
  const std::int32_t rise = first[steps * map_stride] - *first;
  const bool falls = rise % steps < 0;
  const std::int32_t whole = rise / steps - falls;
  const std::int32_t part = 2 * (rise % steps + falls * steps);
  std::int32_t disparity = *first;
  std::int32_t rest = steps;
  for (int k = 1; k < steps; ++k) {
    disparity += whole;
    rest += part;
    if (rest >= 2 * steps) {
      rest -= 2 * steps;
      ++disparity;
    }
    first[k * map_stride] = disparity;
    first_confidence[k * confidence_stride] = confidence;
  }
}

}  // namespace

void fill_gaps_along_rows(const GapFilling& gaps, int y0, int y1, Image<std::int32_t>& map,
                          Image<std::uint8_t>& confidence) {
  const int width = map.width();
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    int x = 0;
    while (x < width && row[x] == kNoDisparity) ++x;
    for (int last = x++; x < width; ++x) {
      if (row[x] == kNoDisparity) continue;
      const int gap = x - last - 1;
      if (gap > 0 && gap <= gaps.max_gap && std::abs(row[x] - row[last]) <= gaps.tolerance) {
        fill_gap(gaps, gap + 1, 1, row + last, 1, confidence.row(y) + last);
      }
      last = x;
    }
  }
}

void fill_gaps_along_columns(const GapFilling& gaps, int x0, int x1, Buffer<std::int32_t>& scratch,
                             Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  constexpr std::int32_t kNoneYet = -1;
  const int columns = x1 - x0;
  scratch.resize(columns);
  std::int32_t* last = scratch.data();  // per column: the last row with a disparity
  std::fill_n(last, columns, kNoneYet);
  for (int y = 0; y < map.height(); ++y) {
    const std::int32_t* row = map.row(y) + x0;
    for (int x = 0; x < columns; ++x) {
      if (row[x] == kNoDisparity) continue;
      const int gap = y - last[x] - 1;
      if (gap > 0 && gap <= gaps.max_gap && last[x] != kNoneYet) {
        std::int32_t* first = map.row(last[x]) + x0 + x;
        if (std::abs(row[x] - *first) <= gaps.tolerance) {
          fill_gap(gaps, gap + 1, map.stride(), first, confidence.stride(),
                   confidence.row(last[x]) + x0 + x);
        }
      }
      last[x] = y;
    }
  }
}

}  // namespace mtstereo

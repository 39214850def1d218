// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/rim_trimming.hpp"

#include <algorithm>

#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

static_assert(kLargestImageSide <= 0xFFFF, "the rows of a column are counted in 16 bits");

/// A closing by 3x3 is a dilation and an erosion, and the erosion by the window of 2 rim + 1 pixels
/// that follows makes one with it: the pixels stay from which no undilated pixel is reached with
/// rim + 1 steps. More steps than the image has pixels in a row or column reach no more.
int reach(int rim, int side) { return std::clamp(rim, 0, side - 1) + 1; }

/// Writes 1 where none of the 3x3 pixels is known, else 0. Pixels at the image's border have known
/// ones beyond it.
void find_undilated(const Image<std::int32_t>& map, int y, std::uint8_t* out) {
  const int width = map.width();
  if (y == 0 || y == map.height() - 1) {
    std::fill_n(out, width, std::uint8_t{0});
    return;
  }
  const std::int32_t* above = map.row(y - 1);
  const std::int32_t* row = map.row(y);
  const std::int32_t* below = map.row(y + 1);
  out[0] = 0;
  for (int x = 1; x < width - 1; ++x) {
    const std::int32_t known = above[x - 1] | above[x] | above[x + 1] | row[x - 1] | row[x] |
                               row[x + 1] | below[x - 1] | below[x] | below[x + 1];
    out[x] = known == kNoDisparity;
  }
  out[width - 1] = 0;
}

/// Writes 1 where one of the pixels x - steps .. x + steps of the line is 1, else 0. Around the
/// line's width there are steps + 1 zeros.
void widen(const std::uint8_t* line, int width, int steps, std::uint8_t* out) {
  int count = 0;
  for (int x = 0; x < std::min(steps, width); ++x) count += line[x];
  for (int x = 0; x < width; ++x) {
    count += line[x + steps] - line[x - steps - 1];
    out[x] = count != 0;
  }
}

}  // namespace

void RimScratch::resize(int width, int rim) {
  line.resize(width + 2 * (reach(rim, width) + 1));
  count.resize(width);
}

void mark_rim(const Image<std::int32_t>& map, int rim, int y0, int y1, RimScratch& scratch,
              Image<std::uint8_t>& marks) {
  if (rim <= 0) return;
  const int width = map.width();
  const int steps = reach(rim, width);
  std::uint8_t* line = scratch.line.data() + steps + 1;
  std::fill_n(line - steps - 1, steps + 1, std::uint8_t{0});
  std::fill_n(line + width, steps + 1, std::uint8_t{0});
  for (int y = y0; y < y1; ++y) {
    find_undilated(map, y, line);
    widen(line, width, steps, marks.row(y));
  }
}

void trim_rim(const Image<std::uint8_t>& marks, int rim, int y0, int y1, RimScratch& scratch,
              Image<std::int32_t>& map) {
  if (rim <= 0) return;
  const int width = map.width();
  const int height = map.height();
  const int steps = reach(rim, height);
  std::uint16_t* count = scratch.count.data();
  std::fill_n(count, width, std::uint16_t{0});
  const auto add = [&](int y, int sign) {
    if (y < 0 || y >= height) return;
    const std::uint8_t* row = marks.row(y);
    for (int x = 0; x < width; ++x) count[x] = static_cast<std::uint16_t>(count[x] + sign * row[x]);
  };
  for (int y = y0 - steps; y < y0 + steps; ++y) add(y, 1);
  for (int y = y0; y < y1; ++y) {
    add(y + steps, 1);
    std::int32_t* row = map.row(y);
    for (int x = 0; x < width; ++x) row[x] = count[x] == 0 ? row[x] : kNoDisparity;
    add(y - steps, -1);
  }
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/withheld.hpp"

#include <algorithm>
#include <cstring>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

/// Without branches, so that compilers vectorize the loops of these functions.
void restore_row(std::uint8_t least, int width, std::int32_t* __restrict__ withheld,
                 std::int32_t* __restrict__ map, std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const bool back = (withheld[x] < 0) & (map[x] == kNoDisparity);
    map[x] = back ? -withheld[x] : map[x];
    confidence[x] = back ? least : confidence[x];
    withheld[x] = map[x] != kNoDisparity ? kKeptDisparity : withheld[x];
  }
}

void guard_row(const std::int32_t* __restrict__ filled, const std::int32_t* __restrict__ withheld,
               int width, std::uint8_t* __restrict__ guarded) {
  for (int x = 0; x < width; ++x) {
    guarded[x] = (filled[x] != kNoDisparity) & (withheld[x] - filled[x] > kGuardedStep);
  }
}

/// Columns that are looked at together.
constexpr int kBlock = 32;

/// Whether a value of a block is negative; compilers vectorize the loop.
bool any_negative(const std::int32_t* values) {
  std::int32_t bits = 0;
  for (int i = 0; i < kBlock; ++i) bits |= values[i];
  return bits < 0;
}

/// Calls body(x, withheld disparity) for the negative ones of a row of the complete map.
template <typename Body>
void for_negative(const WithheldMap& withheld, const MapPlace& place, int y, int width,
                  Body&& body) {
  const std::int32_t* row = withheld.row(std::min(y / place.scale, withheld.height() - 1));
  for (int begin = 0; begin < withheld.width(); begin += kBlock) {
    const int end = std::min(begin + kBlock, withheld.width());
    // Thin objects are rare.
    if (begin + kBlock == end && !any_negative(row + begin)) continue;
    for (int i = begin; i < end; ++i) {
      if (row[i] >= 0) continue;
      const int first = i * place.scale + place.column;
      const int last = std::min(first + place.scale, width);
      for (int x = std::max(first, 0); x < last; ++x) body(x, row[i]);
    }
  }
}

/// Without branches, as above. All rows begin at the same pixel of the map.
void clear_covered(const std::int32_t* __restrict__ withheld, std::int32_t added, int width,
                   std::int32_t* __restrict__ map, std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const bool covered = (withheld[x] > 0) & (withheld[x] + added - map[x] > kGuardedStep);
    map[x] = covered ? kNoDisparity : map[x];
    confidence[x] = covered ? std::uint8_t{0} : confidence[x];
  }
}

/// Calls body(x, withheld disparity) for the pixels of a row of the complete map.
template <typename Body>
void for_row(const WithheldMap& withheld, const MapPlace& place, int y, int width, Body&& body) {
  const std::int32_t* row = withheld.row(std::min(y / place.scale, withheld.height() - 1));
  const int first = std::max(place.column, 0);
  const int end = std::min(width, withheld.width() * place.scale + place.column);
  for (int x = first; x < end; ++x) body(x, row[(x - place.column) / place.scale]);
}

}  // namespace

void copy_map(const Image<std::int32_t>& map, int y0, int y1, WithheldMap& withheld) {
  for (int y = y0; y < y1; ++y) std::copy_n(map.row(y), map.width(), withheld.row(y));
}

void restore_kept(int confidence, int y0, int y1, WithheldMap& withheld, Image<std::int32_t>& map,
                  Image<std::uint8_t>& map_confidence) {
  const auto least = static_cast<std::uint8_t>(std::max(confidence, 1));
  for (int y = y0; y < y1; ++y) {
    restore_row(least, map.width(), withheld.row(y), map.row(y), map_confidence.row(y));
  }
}

void mark_guarded(const Image<std::int32_t>& filled, const WithheldMap& withheld, int y0, int y1,
                  Image<std::uint8_t>& guarded) {
  for (int y = y0; y < y1; ++y) {
    guard_row(filled.row(y), withheld.row(y), filled.width(), guarded.row(y));
  }
}

void remove_guarded(const WithheldMap& withheld, const Image<std::uint8_t>& guarded, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  const int width = map.width();
  // Clears the filled ones of the pixels x - 1 .. x + 1 of row y.
  const auto clear = [&](int x, int y) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
      if (withheld.row(y)[i] == kKeptDisparity) continue;
      map.row(y)[i] = kNoDisparity;
      confidence.row(y)[i] = 0;
    }
  };
  for (int y = y0; y < y1; ++y) {
    for (int near = std::max(y - 1, 0); near <= std::min(y + 1, map.height() - 1); ++near) {
      // Few pixels are guarded.
      const std::uint8_t* row = guarded.row(near);
      for (int x = 0; x < width; ++x) {
        const void* next = std::memchr(row + x, 1, static_cast<std::size_t>(width - x));
        if (next == nullptr) break;
        x = static_cast<int>(static_cast<const std::uint8_t*>(next) - row);
        clear(x, y);
      }
    }
  }
}

void draw_thin_objects(const WithheldMap& withheld, const MapPlace& place, int confidence, int y0,
                       int y1, Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence) {
  const auto least = static_cast<std::uint8_t>(std::max(confidence, 1));
  const std::int32_t added = place.added * kDisparityOne;
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* row_confidence = map_confidence.row(y);
    for_negative(withheld, place, y, map.width(), [&](int x, std::int32_t value) {
      row[x] = -value * place.scale + added;
      row_confidence[x] = std::max(row_confidence[x], least);
    });
  }
}

void remove_covered(const WithheldMap& withheld, const MapPlace& place, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  const std::int32_t added = place.added * kDisparityOne;
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* row_confidence = confidence.row(y);
    if (place.scale == 1) {
      const int first = std::max(place.column, 0);
      const int end = std::min(map.width(), withheld.width() + place.column);
      const std::int32_t* seen = withheld.row(std::min(y, withheld.height() - 1));
      clear_covered(seen + first - place.column, added, end - first, row + first,
                    row_confidence + first);
      continue;
    }
    for_row(withheld, place, y, map.width(), [&](int x, std::int32_t value) {
      if (value <= 0 || value * place.scale + added - row[x] <= kGuardedStep) return;
      row[x] = kNoDisparity;
      row_confidence[x] = 0;
    });
  }
}

}  // namespace mtstereo

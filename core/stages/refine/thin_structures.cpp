// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_structures.hpp"

#include <algorithm>
#include <cstring>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

/// Without branches, so that compilers vectorize the loops of these functions.
void restore_row(std::uint8_t least, int width, std::int32_t* __restrict__ unfiltered,
                 std::int32_t* __restrict__ map, std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const bool back = (unfiltered[x] < 0) & (map[x] == kNoDisparity);
    map[x] = back ? -unfiltered[x] : map[x];
    confidence[x] = back ? least : confidence[x];
    unfiltered[x] = map[x] != kNoDisparity ? kKeptDisparity : unfiltered[x];
  }
}

void mark_row(const std::int32_t* __restrict__ filled, const std::int32_t* __restrict__ unfiltered,
              int width, std::uint8_t* __restrict__ foreground) {
  for (int x = 0; x < width; ++x) {
    foreground[x] = (filled[x] != kNoDisparity) & (unfiltered[x] - filled[x] > kForegroundStep);
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

/// Calls body(x, unfiltered disparity) for the negative ones of a row of the complete map.
template <typename Body>
void for_negative(const UnfilteredMap& unfiltered, const MapPlace& place, int y, int width,
                  Body&& body) {
  const std::int32_t* row = unfiltered.row(std::min(y / place.scale, unfiltered.height() - 1));
  for (int begin = 0; begin < unfiltered.width(); begin += kBlock) {
    const int end = std::min(begin + kBlock, unfiltered.width());
    // Thin structures are rare.
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
void clear_covered(const std::int32_t* __restrict__ unfiltered, std::int32_t added, int width,
                   std::int32_t* __restrict__ map, std::uint8_t* __restrict__ confidence) {
  for (int x = 0; x < width; ++x) {
    const bool covered = (unfiltered[x] > 0) & (unfiltered[x] + added - map[x] > kForegroundStep);
    map[x] = covered ? kNoDisparity : map[x];
    confidence[x] = covered ? std::uint8_t{0} : confidence[x];
  }
}

/// Calls body(x, unfiltered disparity) for the pixels of a row of the complete map.
template <typename Body>
void for_row(const UnfilteredMap& unfiltered, const MapPlace& place, int y, int width,
             Body&& body) {
  const std::int32_t* row = unfiltered.row(std::min(y / place.scale, unfiltered.height() - 1));
  const int first = std::max(place.column, 0);
  const int end = std::min(width, unfiltered.width() * place.scale + place.column);
  for (int x = first; x < end; ++x) body(x, row[(x - place.column) / place.scale]);
}

}  // namespace

void copy_map(const Image<std::int32_t>& map, int y0, int y1, UnfilteredMap& unfiltered) {
  for (int y = y0; y < y1; ++y) std::copy_n(map.row(y), map.width(), unfiltered.row(y));
}

void restore_thin(int confidence, int y0, int y1, UnfilteredMap& unfiltered,
                  Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence) {
  const auto least = static_cast<std::uint8_t>(std::max(confidence, 1));
  for (int y = y0; y < y1; ++y) {
    restore_row(least, map.width(), unfiltered.row(y), map.row(y), map_confidence.row(y));
  }
}

void mark_foreground(const Image<std::int32_t>& filled, const UnfilteredMap& unfiltered, int y0,
                     int y1, Image<std::uint8_t>& foreground) {
  for (int y = y0; y < y1; ++y) {
    mark_row(filled.row(y), unfiltered.row(y), filled.width(), foreground.row(y));
  }
}

void clear_over_foreground(const UnfilteredMap& unfiltered, const Image<std::uint8_t>& foreground,
                           int y0, int y1, Image<std::int32_t>& map,
                           Image<std::uint8_t>& confidence) {
  const int width = map.width();
  // Clears the filled ones of the pixels x - 1 .. x + 1 of row y.
  const auto clear = [&](int x, int y) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
      if (unfiltered.row(y)[i] == kKeptDisparity) continue;
      map.row(y)[i] = kNoDisparity;
      confidence.row(y)[i] = 0;
    }
  };
  for (int y = y0; y < y1; ++y) {
    for (int near = std::max(y - 1, 0); near <= std::min(y + 1, map.height() - 1); ++near) {
      // Few pixels are foreground.
      const std::uint8_t* row = foreground.row(near);
      for (int x = 0; x < width; ++x) {
        const void* next = std::memchr(row + x, 1, static_cast<std::size_t>(width - x));
        if (next == nullptr) break;
        x = static_cast<int>(static_cast<const std::uint8_t*>(next) - row);
        clear(x, y);
      }
    }
  }
}

void draw_thin(const UnfilteredMap& unfiltered, const MapPlace& place, int confidence, int y0,
               int y1, Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence) {
  const auto least = static_cast<std::uint8_t>(std::max(confidence, 1));
  const std::int32_t added = place.added * kDisparityOne;
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* row_confidence = map_confidence.row(y);
    for_negative(unfiltered, place, y, map.width(), [&](int x, std::int32_t value) {
      row[x] = -value * place.scale + added;
      row_confidence[x] = std::max(row_confidence[x], least);
    });
  }
}

void remove_covered(const UnfilteredMap& unfiltered, const MapPlace& place, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence) {
  const std::int32_t added = place.added * kDisparityOne;
  for (int y = y0; y < y1; ++y) {
    std::int32_t* row = map.row(y);
    std::uint8_t* row_confidence = confidence.row(y);
    if (place.scale == 1) {
      const int first = std::max(place.column, 0);
      const int end = std::min(map.width(), unfiltered.width() + place.column);
      const std::int32_t* seen = unfiltered.row(std::min(y, unfiltered.height() - 1));
      clear_covered(seen + first - place.column, added, end - first, row + first,
                    row_confidence + first);
      continue;
    }
    for_row(unfiltered, place, y, map.width(), [&](int x, std::int32_t value) {
      if (value <= 0 || value * place.scale + added - row[x] <= kForegroundStep) return;
      row[x] = kNoDisparity;
      row_confidence[x] = 0;
    });
  }
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/map_place.hpp"

namespace mtstereo {

/// The disparities that the filters remove. Those of thin structures are restored. The others show
/// where a gap must not be filled, because something nearer was matched in it.
///
/// Until restore_thin(), it is a copy of the map before the filters, in which the disparities of
/// thin structures are negative. After that it has the disparities that were removed, kNoDisparity
/// where there was none, and kKeptDisparity where the map has a disparity.
using UnfilteredMap = Image<std::int32_t>;

/// The value of a pixel of UnfilteredMap whose disparity was not removed.
inline constexpr std::int32_t kKeptDisparity = -1;

/// A removed disparity that exceeds the filling by more than this contradicts it [1/256 px].
inline constexpr std::int32_t kForegroundStep = 2 * kDisparityOne;

/// Copies the rows y0 .. y1 - 1 of the map.
void copy_map(const Image<std::int32_t>& map, int y0, int y1, UnfilteredMap& unfiltered);

/// Restores the disparities of thin structures in the rows y0 .. y1 - 1 where the filters have
/// removed them. Their confidence is `confidence`, at least 1.
void restore_thin(int confidence, int y0, int y1, UnfilteredMap& unfiltered,
                  Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence);

/// Sets `foreground` to 1 in the rows y0 .. y1 - 1 where a removed disparity contradicts the
/// filling, elsewhere to 0. `filled` is the map with its gaps filled.
void mark_foreground(const Image<std::int32_t>& filled, const UnfilteredMap& unfiltered, int y0,
                     int y1, Image<std::uint8_t>& foreground);

/// Clears in the rows y0 .. y1 - 1 the filled pixels that are foreground or adjacent to it, also
/// diagonally. Reads the rows y0 - 1 and y1 of `foreground` as well.
void clear_over_foreground(const UnfilteredMap& unfiltered, const Image<std::uint8_t>& foreground,
                           int y0, int y1, Image<std::int32_t>& map,
                           Image<std::uint8_t>& confidence);

/// Gives the pixels of thin structures in the rows y0 .. y1 - 1 of a complete map their disparities
/// and at least this confidence. `place` is that of the unfiltered map in the complete one.
void draw_thin(const UnfilteredMap& unfiltered, const MapPlace& place, int confidence, int y0,
               int y1, Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence);

/// Clears the pixels in the rows y0 .. y1 - 1 of a complete map where something nearer than the
/// map was matched that is not one of its thin structures.
void remove_covered(const UnfilteredMap& unfiltered, const MapPlace& place, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

}  // namespace mtstereo

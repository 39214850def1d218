// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// A copy of the map before the filters, in which the disparities of thin structures are negative.
/// Those of thin structures are restored. The others show where a gap must not be filled, because
/// something nearer was matched in it.
using UnfilteredMap = Image<std::int32_t>;

/// A removed disparity that exceeds the filling by more than this contradicts it [1/256 px].
inline constexpr std::int32_t kForegroundStep = 2 * kDisparityOne;

/// Copies the rows y0 .. y1 - 1 of the map.
void copy_map(const Image<std::int32_t>& map, int y0, int y1, UnfilteredMap& unfiltered);

/// Gives the pixels of thin structures in the rows y0 .. y1 - 1 of a complete map their disparities
/// and at least this confidence.
void draw_thin(const UnfilteredMap& unfiltered, int confidence, int y0, int y1,
               Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence);

/// Clears the pixels in the rows y0 .. y1 - 1 of a complete map where something nearer than the
/// map was matched that is not one of its thin structures.
void remove_covered(const UnfilteredMap& unfiltered, int y0, int y1, Image<std::int32_t>& map,
                    Image<std::uint8_t>& confidence);

}  // namespace mtstereo

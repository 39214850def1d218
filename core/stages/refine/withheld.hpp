// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/map_place.hpp"

namespace mtstereo {

/// The disparities that the filters remove. Those of thin objects come back, and the others show
/// where a gap is none, because the matching had seen something nearer in it.
///
/// Up to restore_kept() a copy of the map before the filters, where the pixels of thin objects have
/// the negative of their disparity. From then on the disparity that was removed, kNoDisparity where
/// there was none, and kKeptDisparity where the map has a disparity.
using WithheldMap = Image<std::int32_t>;

/// The value of a pixel of WithheldMap whose disparity was not removed.
inline constexpr std::int32_t kKeptDisparity = -1;

/// A withheld disparity that exceeds the filling by more than this contradicts it [1/256 px].
inline constexpr std::int32_t kGuardedStep = 2 * kDisparityOne;

/// Copies the rows y0 .. y1 - 1 of the map.
void copy_map(const Image<std::int32_t>& map, int y0, int y1, WithheldMap& withheld);

/// Gives the pixels of thin objects in the rows y0 .. y1 - 1 their disparities back where the
/// filters have removed them. Their confidence is `confidence`, at least 1.
void restore_kept(int confidence, int y0, int y1, WithheldMap& withheld, Image<std::int32_t>& map,
                  Image<std::uint8_t>& map_confidence);

/// Sets `guarded` to 1 in the rows y0 .. y1 - 1 where a withheld disparity contradicts the filling,
/// elsewhere to 0. `filled` is the map with its gaps filled.
void mark_guarded(const Image<std::int32_t>& filled, const WithheldMap& withheld, int y0, int y1,
                  Image<std::uint8_t>& guarded);

/// Empties in the rows y0 .. y1 - 1 the filled pixels that are guarded or next to a guarded one,
/// diagonally too. Reads the rows y0 - 1 and y1 of `guarded` as well.
void remove_guarded(const WithheldMap& withheld, const Image<std::uint8_t>& guarded, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

/// Gives the pixels of thin objects in the rows y0 .. y1 - 1 of a complete map their disparities
/// and at least this confidence. `place` is that of the withheld map in the complete one.
void draw_thin_objects(const WithheldMap& withheld, const MapPlace& place, int confidence, int y0,
                       int y1, Image<std::int32_t>& map, Image<std::uint8_t>& map_confidence);

/// Empties the pixels in the rows y0 .. y1 - 1 of a complete map where something nearer than the
/// map was matched that is not one of its thin objects.
void remove_covered(const WithheldMap& withheld, const MapPlace& place, int y0, int y1,
                    Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

}  // namespace mtstereo

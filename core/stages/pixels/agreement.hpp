// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "mtstereo/image.hpp"
#include "stages/pixels/search_windows.hpp"

namespace mtstereo {

/// How often the costs alone give what the paths give, at half the resolution. Paths fill surfaces
/// without texture with what they expect; the costs of saturated, dark or compressed surfaces do
/// not agree with that.

/// Tiles on each side of a tile that count for it.
inline constexpr int kAgreementReach = 2;

/// The share of a tile in which all pixels agree.
inline constexpr int kFullAgreement = 31;

/// Writes the share of agreeing pixels in and around each tile, 0 .. kFullAgreement, into an image
/// with a pixel for each tile.
void share_agreement(const WindowVotes& votes, Image<std::uint8_t>& shares);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "alignment/match.hpp"
#include "mtstereo/image.hpp"

namespace mtstereo {

/// Locates a patch of the left view in the right one to fractions of a pixel (Lucas and Kanade).

/// Side of the patches, at full resolution [px].
inline constexpr int kTrackedPatch = 15;

/// How much of the patch in the right view the left one must explain: a correlation coefficient.
inline constexpr float kLeastCorrelation = 0.8F;

/// The smallest standard deviation of a match that is believed [px].
inline constexpr float kSmallestDeviation = 0.02F;

/// The match of the left view's pixel (x, y), near (x_right, y_right) in the right view. Brightness
/// and contrast of the views may differ. Empty if the patch leaves the view, moves more than
/// `reach` px away from its start, or is not similar enough.
std::optional<Match> track_patch(GrayView left, GrayView right, int x, int y, float x_right,
                                 float y_right, float reach);

}  // namespace mtstereo

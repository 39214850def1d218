// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "alignment/match.hpp"
#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/prepare/view_blur.hpp"

namespace mtstereo {

/// Compares the sharpness of the views at matches, where both show the same.

/// Side of the patches around the matches [px].
inline constexpr int kSharpnessPatch = 16;

/// The views count as equally sharp if the sharper one is sharper by less than this factor.
inline constexpr double kSharpnessLimit = 1.25;

/// Matches that a comparison needs.
inline constexpr int kFewestPatches = 40;

/// The result of a comparison; see PairFindings.
struct SharpnessDifference {
  double ratio = 0;
  float left_blur = 0;
  float right_blur = 0;
};

/// Memory that successive comparisons share.
struct SharpnessScratch {
  Image<std::uint8_t> blurred;
  BlurScratch blur;
  Buffer<float> noise;  ///< of the blocks of a view
};

/// Standard deviation of the noise of a view [gray values], from its smoothest parts (Immerkaer).
double noise_of(GrayView view, SharpnessScratch& scratch);

/// Places all over the images, as if both views showed the same at the same place: for views in
/// which too few matches are found because one is blurred.
void spread_patches(int width, int height, std::vector<Match>& places);

/// Compares the views; ratio 0 if there are too few matches or too little contrast.
SharpnessDifference compare_sharpness(GrayView left, GrayView right, std::span<const Match> matches,
                                      SharpnessScratch& scratch);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "base/buffer.hpp"
#include "mtstereo/image.hpp"
#include "stages/refine/flat_areas.hpp"

namespace mtstereo {

/// Compares the pixels of a flat area with the plane that its believed pixels agree on: there is
/// nothing in the area that the matching could have seen.
///
/// Call fit_planes() for all areas, then complete_planes() or check_planes() for all bands of rows.

/// A pixel votes if its confidence is above kLeastVoter; its weight is what it has above.
inline constexpr int kLeastVoter = 60;

/// A pixel is doubted, and may be replaced, below this confidence.
inline constexpr int kDoubted = 100;

/// A disparity contradicts a plane that is further away: 3 px, or this share of the disparity. It
/// loses kContradicted of its confidence.
inline constexpr float kPlaneDistance = 3;
inline constexpr float kPlaneDistanceShare = 0.06F;
inline constexpr int kContradicted = 60;

/// A disparity agrees with a plane that is at most this far away, or kVoteTolerance of the
/// disparity. It gains up to kConfirmed, see plane_bonus().
inline constexpr float kPlaneAgrees = 1.5F;
inline constexpr int kConfirmed = 20;

/// Noise and compression hide the texture of areas that are not flat: the gain falls from
/// kFullPlaneNoise on and ends at kNoPlaneNoise [gray values], and above this level of the block
/// grid.
inline constexpr float kFullPlaneNoise = 1;
inline constexpr float kNoPlaneNoise = 3;
inline constexpr int kMostPlaneGrid = 1;

/// Votes of an area: fewer than kFewestVotes decide nothing; of more than kMostVotes as many are
/// taken, evenly spread over the area.
inline constexpr int kFewestVotes = 12;
inline constexpr int kMostVotes = 1500;

/// A vote agrees with a plane that is at most this far away: 1 px, or this share of its disparity.
inline constexpr float kVoteTolerance = 0.02F;

/// Planes that are tried, each through three votes; the first ones have the disparity of one vote.
inline constexpr int kPlaneTrials = 40;
inline constexpr int kLevelTrials = 10;

/// Steeper planes are not tried [px per px].
inline constexpr float kMostSlopeX = 0.5F;
inline constexpr float kMostSlopeY = 1;

/// A plane leaves the range of the votes that agree with it by at most this [px].
inline constexpr float kBeyondVotes = 4;

/// The disparity slope_x * x + slope_y * y + at_origin, limited to least .. most [px].
struct FlatPlane {
  float slope_x = 0;
  float slope_y = 0;
  float at_origin = 0;
  float least = 0;
  float most = 0;
  bool accepted = false;  ///< votes with half of the weight agree

  float at(float x, float y) const { return slope_x * x + slope_y * y + at_origin; }
};

/// Votes of one area; scratch memory of one thread.
struct PlaneVotes {
  Buffer<float> x;          ///< column [px]
  Buffer<float> y;          ///< row [px]
  Buffer<float> disparity;  ///< [px]
  Buffer<float> tolerance;  ///< [px]
  Buffer<std::int32_t> weight;
  int count = 0;

  void resize();
};

/// Fits the planes of the areas first .. last - 1 to a rated, complete map. Tries random planes,
/// the same ones whenever the votes are the same; the best one is then fitted to the votes that
/// agree.
void fit_planes(const FlatAreas& areas, int first, int last, const Image<std::int32_t>& map,
                const Image<std::uint8_t>& confidence, PlaneVotes& votes,
                Buffer<FlatPlane>& planes);

/// Replaces the doubted disparities in the rows y0 .. y1 - 1 of the areas whose plane is accepted,
/// and marks them by 1 in `replaced`, all others by 0.
void complete_planes(const FlatAreas& areas, const Buffer<FlatPlane>& planes, int y0, int y1,
                     const Image<std::uint8_t>& confidence, Image<std::int32_t>& map,
                     Image<std::uint8_t>& replaced);

/// What the confidence of a disparity gains by agreeing with the plane of its area, in views of
/// this noise level and BlockGrid::level().
int plane_bonus(float noise, int grid_level);

/// What planes may do to the confidence of disparities.
struct PlaneWeight {
  int bonus = 0;  ///< see plane_bonus()
  int least = 1;  ///< lower ones stay as they are, and none gets lower
};

/// Compares the disparities in the rows y0 .. y1 - 1 with the accepted plane of their area: raises
/// the confidence of those that agree, to 255 at most, and lowers that of those that contradict it.
void check_planes(const FlatAreas& areas, const Buffer<FlatPlane>& planes, PlaneWeight weight,
                  int y0, int y1, const Image<std::int32_t>& map, Image<std::uint8_t>& confidence);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

namespace mtstereo::render {

class ImageTexture;

/// The pattern on top of a texture's noise.
enum class Pattern {
  kPlain,   ///< noise only
  kBricks,  ///< rows of bricks, every other row shifted, with mortar between them
  kPlanks,  ///< boards along v, each with its own gray value, separated by dark gaps
  kTiles,   ///< a grid of tiles in two gray values
  kLines,   ///< one bright line along v per period of u, like road markings
};

/// The appearance of a surface: band-limited noise plus a pattern. Lengths are in meters on the
/// surface, so that the texture moves with it. Gray values are 0 (black) .. 1 (white).
struct Texture {
  Pattern pattern = Pattern::kPlain;
  double mean = 0.5;                  ///< mean gray value
  double noise_contrast = 0.2;        ///< amplitude of the coarsest octave
  double noise_size = 0.5;            ///< grain of the coarsest octave [m]
  int octaves = 6;                    ///< each with half the grain of the previous one
  double persistence = 0.75;          ///< amplitude of an octave relative to the previous one
  double pattern_contrast = 0;        ///< amplitude of the pattern
  double period_u = 1;                ///< period of the pattern [m]
  double period_v = 1;                ///< period of the pattern [m]
  Eigen::Vector3f color = {1, 1, 1};  ///< tint (blue, green, red)
  std::uint32_t seed = 0;
  std::shared_ptr<const ImageTexture> image{};  ///< replaces all but the color
};

/// A hash of three numbers; the source of all random choices of the renderer.
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h =
      a * 0x85ebca6bu ^ (b + 0x9e3779b9u) * 0xc2b2ae35u ^ (c + 0x7f4a7c15u) * 0x27d4eb2fu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  h ^= h >> 15;
  return h;
}

/// The same as a number 0 <= h < 1.
double hash_unit(std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The gray value of the texture at the surface point (u, v) [m] under a filter that is `footprint`
/// [m] wide: finer detail fades to its mean instead of aliasing.
double gray_value(const Texture& texture, double u, double v, double footprint);

}  // namespace mtstereo::render

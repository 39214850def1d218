// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/render/texture.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/image_texture.hpp"

namespace mtstereo::render {

namespace {

/// std::floor() of a number below 2^63. Without SSE4.1, std::floor() is a function call.
std::int64_t floor_of(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return whole - (static_cast<double>(whole) > x ? 1 : 0);
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The gradient of a lattice point: the dot product of one of eight directions and the offset.
double gradient(std::uint32_t h, double x, double y) {
  static constexpr double kDirections[8][2] = {{1, 1},    {1, -1},    {-1, 1},   {-1, -1},
                                               {1.41, 0}, {-1.41, 0}, {0, 1.41}, {0, -1.41}};
  const auto& [along_x, along_y] = kDirections[h & 7];
  return along_x * x + along_y * y;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// Perlin's gradient noise, about -1 .. 1, on the unit lattice.
double gradient_noise(double u, double v, std::uint32_t seed) {
  const std::int64_t left = floor_of(u), top_row = floor_of(v);
  const double x = u - static_cast<double>(left), y = v - static_cast<double>(top_row);
  const auto i = static_cast<std::uint32_t>(left), j = static_cast<std::uint32_t>(top_row);
  const double a = gradient(hash(i, j, seed), x, y);
  const double b = gradient(hash(i + 1, j, seed), x - 1, y);
  const double c = gradient(hash(i, j + 1, seed), x, y - 1);
  const double d = gradient(hash(i + 1, j + 1, seed), x - 1, y - 1);
  const double s = fade(x), t = fade(y);
  const double top = a + s * (b - a), bottom = c + s * (d - c);
  return top + t * (bottom - top);
}

// The fraction of [x - w/2, x + w/2] that is covered by a pulse train, 1 on [0, duty) of each
// period of 1. It is exact, so that edges are as soft as the filter is wide and distant patterns
// become gray.
double pulse_train(double x, double duty, double w) {
  w = std::max(w, 1e-6);
  const auto integral = [duty](double p) {
    const auto whole = static_cast<double>(floor_of(p));
    return whole * duty + std::min(p - whole, duty);
  };
  return (integral(x + w / 2) - integral(x - w / 2)) / w;
}

// The fraction of a pattern's cell-to-cell variation that remains after the filter.
double cell_visibility(double period, double footprint) {
  return smooth(1.0, 3.0, period / std::max(footprint, 1e-9));
}

std::uint32_t cell(double x) { return static_cast<std::uint32_t>(floor_of(x)); }

double bricks(const Texture& t, double u, double v, double footprint) {
  const double row = v / t.period_v;
  const double shift = (cell(row) & 1) != 0 ? 0.5 : 0.0;
  const double column = u / t.period_u + shift;
  const double stone = pulse_train(column, 0.92, footprint / t.period_u) *
                       pulse_train(row, 0.86, footprint / t.period_v);
  const double own = hash_unit(cell(column), cell(row), t.seed) - 0.5;
  return (stone - 0.8) + own * stone * cell_visibility(t.period_v, footprint);
}

double planks(const Texture& t, double u, double footprint) {
  const double board = u / t.period_u;
  const double wood = pulse_train(board, 0.95, footprint / t.period_u);
  const double own = hash_unit(cell(board), 17, t.seed) - 0.5;
  return (wood - 0.95) * 2 + own * cell_visibility(t.period_u, footprint);
}

double tiles(const Texture& t, double u, double v, double footprint) {
  const double a = 2 * pulse_train(u / (2 * t.period_u), 0.5, footprint / (2 * t.period_u)) - 1;
  const double b = 2 * pulse_train(v / (2 * t.period_v), 0.5, footprint / (2 * t.period_v)) - 1;
  return 0.5 * a * b;
}

double lines(const Texture& t, double u, double v, double footprint) {
  // The line is interrupted in every other period of v, like the center line of a road.
  return pulse_train(u / t.period_u, 0.04, footprint / t.period_u) *
         pulse_train(v / t.period_v, 0.5, footprint / t.period_v);
}

double pattern_value(const Texture& t, double u, double v, double footprint) {
  switch (t.pattern) {
    case Pattern::kBricks:
      return bricks(t, u, v, footprint);
    case Pattern::kPlanks:
      return planks(t, u, footprint);
    case Pattern::kTiles:
      return tiles(t, u, v, footprint);
    case Pattern::kLines:
      return lines(t, u, v, footprint);
    case Pattern::kPlain:
      break;
  }
  return 0;
}

}  // namespace

double hash_unit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return hash(a, b, c) * (1.0 / 4294967296.0);
}

double gray_value(const Texture& texture, double u, double v, double footprint) {
  if (texture.image) return texture.image->mean(u, v, footprint);
  double value = texture.mean;
  double amplitude = texture.noise_contrast;
  double grain = texture.noise_size / footprint;
  double x = u / texture.noise_size, y = v / texture.noise_size;
  for (int octave = 0; octave < texture.octaves; ++octave) {
    // The pixel grid cannot represent a lattice finer than 1.5 footprints.
    const double visible = smooth(1.5, 3.0, grain);
    if (visible <= 0) break;
    const std::uint32_t seed = texture.seed + 0x9e37u * static_cast<std::uint32_t>(octave);
    value += visible * amplitude * gradient_noise(x, y, seed);
    grain /= 2;
    x *= 2;
    y *= 2;
    amplitude *= texture.persistence;
  }
  if (texture.pattern_contrast != 0) {
    value += texture.pattern_contrast * pattern_value(texture, u, v, footprint);
  }
  return std::clamp(value, 0.0, 1.0);
}

}  // namespace mtstereo::render

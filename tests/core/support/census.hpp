// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "stages/pixels/census_cost.hpp"
#include "stages/prepare/census.hpp"
#include "support/plane.hpp"
#include "support/random.hpp"
#include "support/stages.hpp"

namespace mtstereo::test {

/// The census transform of every `row_step`-th row of a view, computed in bands of `band` rows from
/// the last band to the first, in poisoned memory.
inline CensusImage census_of(GrayView image, int band = 1 << 20, int scales = 2, int row_step = 1) {
  const int height = (image.height + row_step - 1) / row_step;
  CensusImage census;
  census.resize(image.width, height);
  poison(census.bits);
  CensusScratch scratch;
  scratch.resize(image.width, std::min(band, height) * row_step);
  poison(scratch.view);
  poison(scratch.smoothed);
  for (int i = (height + band - 1) / band - 1; i >= 0; --i) {
    census_rows(image, scales, row_step, i * band, std::min((i + 1) * band, height), scratch,
                census);
  }
  return census;
}

/// The census transforms of both views, the input of guided pixel matching.
struct CensusPair {
  CensusPair(GrayView left_view, GrayView right_view, int scales = 2, int row_step = 1)
      : left(census_of(left_view, 1 << 20, scales, row_step)),
        right(census_of(right_view, 1 << 20, scales, row_step)) {}
  CensusImage left, right;
};

/// Maps the gray values by a random strictly increasing function: the order of gray values stays.
/// The values must be 0 .. 100.
inline GrayPlane exposed_otherwise(const GrayPlane& image, Random& random) {
  std::vector<std::uint8_t> exposed(101);
  int value = random.below(10);
  for (std::uint8_t& gray : exposed) {
    gray = static_cast<std::uint8_t>(value);
    value += random.between(1, 2);
  }
  GrayPlane out = image;
  for (std::uint8_t& gray : out.pixels) gray = exposed[gray];
  return out;
}

/// Adds the same number to all gray values, which must not saturate.
inline GrayPlane brighter(const GrayPlane& image, int by) {
  GrayPlane out = image;
  for (std::uint8_t& gray : out.pixels) gray = static_cast<std::uint8_t>(gray + by);
  return out;
}

}  // namespace mtstereo::test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/map_shift.hpp"

#include <gtest/gtest.h>

#include "support/plane.hpp"

namespace mtstereo::map_shift_test {
namespace {

using Disparities = std::vector<std::int32_t>;
using Confidences = std::vector<std::uint8_t>;

/// Shifts a map of one row, of `width` px in the end, between two other rows.
std::pair<Disparities, Confidences> shifted(const Disparities& row, int least, int width) {
  Image<std::int32_t> map;
  Image<std::uint8_t> confidence;
  map.resize(static_cast<int>(row.size()), 3);
  confidence.resize(map.width(), 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map.row(y)[x] = y == 1 ? row[static_cast<std::size_t>(x)] : 999;
      confidence.row(y)[x] =
          map.row(y)[x] == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(10 + x);
    }
  }
  Image<std::int32_t> out;
  Image<std::uint8_t> out_confidence;
  out.resize(width, 3);
  out_confidence.resize(width, 3);
  for (int y = 0; y < 3; ++y) std::fill_n(out.row(y), width, -7);
  shift_map(map, confidence, least, 1, 2, out, out_confidence);
  EXPECT_EQ(out.row(0)[0], -7) << "another band was written to";
  EXPECT_EQ(out.row(2)[0], -7) << "another band was written to";
  return {Disparities(out.row(1), out.row(1) + width),
          Confidences(out_confidence.row(1), out_confidence.row(1) + width)};
}

TEST(MapShift, AddsAPositiveSmallestDisparityToKnownOnes) {
  const auto [map, confidence] = shifted({1, 0, 512, 300}, 2, 6);
  EXPECT_EQ(map, (Disparities{0, 0, 513, 0, 1024, 812}));
  EXPECT_EQ(confidence, (Confidences{0, 0, 10, 0, 12, 13}));
}

TEST(MapShift, KeepsDisparitiesRelativeToANegativeSmallestOne) {
  // The right view had columns 0 .. 3; 4 and 5 were added.
  const auto [map, confidence] = shifted({7, 9, 256, 300, 512, 767}, -2, 4);
  // A partner at column 3 or before: at the columns 2 and 3 (4 and 5) from 256 and 512 on.
  EXPECT_EQ(map, (Disparities{256, 300, 512, 767}));
  EXPECT_EQ(confidence, (Confidences{12, 13, 14, 15}));
}

TEST(MapShift, RemovesPartnersOutsideOfTheRightView) {
  const auto [map, confidence] = shifted({7, 9, 1, 0, 255, 511}, -2, 4);
  EXPECT_EQ(map, (Disparities{1, 0, 0, 0}));
  EXPECT_EQ(confidence, (Confidences{12, 0, 0, 0}));
}

}  // namespace
}  // namespace mtstereo::map_shift_test

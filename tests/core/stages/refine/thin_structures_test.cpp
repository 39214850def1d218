// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_structures.hpp"

#include <gtest/gtest.h>

#include "reference/refine/thin_structures.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::thin_structures_test {
namespace {

/// A map of the matching, in which one pixel of so many is marked.
DisparityPlane found_in(int width, int height, int marked) {
  DisparityPlane found = test::patches(width, height, 1, width);
  Random random(width);
  for (int& value : found.pixels) {
    if (random.below(marked) == 0) value = -value;
  }
  return found;
}

/// Compares the drawing into a complete map of this size.
void expect_drawn_reference(int width, int height, int band, int marked = 5) {
  SCOPED_TRACE(testing::Message() << width << "x" << height);
  const DisparityPlane found = found_in(width, height, marked);
  DisparityPlane expected = test::patches(width, height, 0, 2);
  GrayPlane rating(width, height, 100);
  Image<std::int32_t> map = image_of(expected), unfiltered;
  Image<std::uint8_t> confidence = image_of(rating);
  reference::draw_thin_structures(found, 120, true, expected, rating);
  const Image<std::int32_t> matched = image_of(found);
  unfiltered.resize(width, height);
  for (int y0 = 0; y0 < height; y0 += band) {
    const int y1 = std::min(y0 + band, height);
    copy_map(matched, y0, y1, unfiltered);
    draw_thin(unfiltered, 120, y0, y1, map, confidence);
    remove_covered(unfiltered, y0, y1, map, confidence);
  }
  EXPECT_TRUE(same_image(expected, map));
  EXPECT_TRUE(same_image(rating, confidence));
}

TEST(ThinStructures, DrawsThinObjectsIntoACompleteMap) {
  for (int width = 1; width <= 40; ++width) {
    expect_drawn_reference(width, 1 + width % 13, 1 + width % 6);
  }
}

TEST(ThinStructures, DrawsTheFewThinObjectsOfAWideMap) {
  for (int width = 95; width <= 200; ++width) expect_drawn_reference(width, 5, 3, 60);
}

}  // namespace
}  // namespace mtstereo::thin_structures_test

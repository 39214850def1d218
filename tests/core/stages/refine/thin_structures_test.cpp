// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/thin_structures.hpp"

#include <gtest/gtest.h>

#include "reference/refine/thin_structures.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo {
namespace {

using test::copy_of;
using test::DisparityPlane;
using test::GrayPlane;
using test::Random;
using test::same_image;

/// A map with its confidence.
struct Rated {
  DisparityPlane map;
  GrayPlane confidence;
};

/// A map of the matching with marked pixels, and what the filters leave of it.
struct Filtered {
  Filtered(int width, int height, std::uint64_t seed, int marked = 5)
      : found(test::patches(width, height, 1, seed)), left{found, GrayPlane(width, height)} {
    Random random(seed);
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
      if (random.below(3) == 0) left.map.pixels[i] = 0;
      if (left.map.pixels[i] != 0) left.confidence.pixels[i] = 90;
      if (random.below(marked) == 0) found.pixels[i] = -found.pixels[i];
    }
  }
  DisparityPlane found;
  Rated left;
};

/// Fills some unknown pixels.
void fill(Rated& rated, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < rated.map.pixels.size(); ++i) {
    if (rated.map.pixels[i] != 0 || random.below(3) == 0) continue;
    rated.map.pixels[i] = random.between(256, 6 * 256);
    rated.confidence.pixels[i] = 40;
  }
}

void expect_reference(int width, int height, int least, int band, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << width << "x" << height << ", bands of " << band << " rows");
  const Filtered filtered(width, height, seed);
  Rated expected = filtered.left;
  reference::restore_thin(filtered.found, least, expected.map, expected.confidence);

  Image<std::int32_t> unfiltered, map = image_of(filtered.left.map);
  unfiltered.resize(width, height);
  Image<std::uint8_t> confidence = image_of(filtered.left.confidence);
  const auto in_bands = [&](auto&& body) {
    for (int y0 = (height - 1) / band * band; y0 >= 0; y0 -= band) {
      body(y0, std::min(y0 + band, height));
    }
  };
  const Image<std::int32_t> found = image_of(filtered.found);
  in_bands([&](int y0, int y1) { copy_map(found, y0, y1, unfiltered); });
  in_bands([&](int y0, int y1) { restore_thin(least, y0, y1, unfiltered, map, confidence); });
  ASSERT_TRUE(same_image(expected.map, map));
  ASSERT_TRUE(same_image(expected.confidence, confidence));

  const DisparityPlane before = expected.map;
  fill(expected, seed + 1);
  map = image_of(expected.map);
  confidence = image_of(expected.confidence);
  reference::check_foreground(filtered.found, before, expected.map, expected.confidence);
  Image<std::uint8_t> foreground;
  foreground.resize(width, height);
  in_bands([&](int y0, int y1) { mark_foreground(map, unfiltered, y0, y1, foreground); });
  in_bands([&](int y0, int y1) {
    clear_over_foreground(unfiltered, foreground, y0, y1, map, confidence);
  });
  EXPECT_TRUE(same_image(expected.map, map));
  EXPECT_TRUE(same_image(expected.confidence, confidence));
}

TEST(ThinStructures, EqualsReferenceAtEveryWidth) {
  for (int width = 1; width <= 80; ++width) {
    for (const int band : {1, 5, 1 << 20}) {
      expect_reference(width, 1 + width % 37, width % 3 * 90, std::min(band, 1 + width % 37),
                       width);
    }
  }
}

TEST(ThinStructures, KeepsAGapOpenAroundSomethingNearer) {
  // A row: a kept pixel, a gap of 6 px in which a nearer one was seen, another kept pixel.
  DisparityPlane found(8, 1);
  found(0, 0) = found(7, 0) = 512;
  found(3, 0) = 512 + kForegroundStep + 1;
  Image<std::int32_t> unfiltered = image_of(found);
  DisparityPlane start = found;
  start(3, 0) = 0;
  Image<std::int32_t> map = image_of(start);
  Image<std::uint8_t> confidence = image_of(GrayPlane(8, 1, 50)), foreground;
  foreground.resize(8, 1);
  restore_thin(100, 0, 1, unfiltered, map, confidence);
  std::fill_n(map.row(0), 8, 512);
  mark_foreground(map, unfiltered, 0, 1, foreground);
  clear_over_foreground(unfiltered, foreground, 0, 1, map, confidence);
  for (int x = 0; x < 8; ++x) {
    const bool open = x >= 2 && x <= 4;
    EXPECT_EQ(open ? 0 : 512, map.row(0)[x]) << x;
    EXPECT_EQ(open ? 0 : 50, confidence.row(0)[x]) << x;
  }
}

/// Compares the drawing into a complete map of this size.
void expect_drawn_reference(int width, int height, const MapPlace& place, int band,
                            int marked = 5) {
  SCOPED_TRACE(testing::Message() << width << "x" << height << ", shift " << place.column
                                  << ", scale " << place.scale);
  const int columns = std::max((width - place.column + place.scale - 1) / place.scale, 1);
  const Filtered filtered(columns, (height + place.scale - 1) / place.scale, width, marked);
  Rated expected = {test::patches(width, height, 0, 2), GrayPlane(width, height, 100)};
  Image<std::int32_t> map = image_of(expected.map);
  Image<std::uint8_t> confidence = image_of(expected.confidence);
  reference::draw_thin_structures(filtered.found, place.column, place.scale, 120, true,
                                  expected.map, expected.confidence);
  const Image<std::int32_t> unfiltered = image_of(filtered.found);
  for (int y0 = 0; y0 < height; y0 += band) {
    const int y1 = std::min(y0 + band, height);
    draw_thin(unfiltered, place, 120, y0, y1, map, confidence);
    remove_covered(unfiltered, place, y0, y1, map, confidence);
  }
  EXPECT_TRUE(same_image(expected.map, map));
  EXPECT_TRUE(same_image(expected.confidence, confidence));
}

TEST(ThinStructures, DrawsThinObjectsIntoACompleteMap) {
  for (int width = 1; width <= 40; ++width) {
    for (const int scale : {1, 2}) {
      for (const int shift : {-7, 0, 3}) {
        expect_drawn_reference(width, 1 + width % 13, {scale, shift, std::max(shift, 0)},
                               1 + width % 6);
      }
    }
  }
}

TEST(ThinStructures, DrawsTheFewThinObjectsOfAWideMap) {
  for (int width = 95; width <= 200; ++width) {
    for (const int scale : {1, 2}) {
      for (const int shift : {-7, 0, 3}) {
        expect_drawn_reference(width, 5, {scale, shift, std::max(shift, 0)}, 3, 60);
      }
    }
  }
}

}  // namespace
}  // namespace mtstereo

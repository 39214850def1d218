// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/edge_alignment.hpp"

#include <gtest/gtest.h>

#include "reference/refine/edge_alignment.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"
#include "support/simd_targets.hpp"
#include "support/stages.hpp"

namespace mtstereo::edge_alignment_test {
namespace {

using reference::ConfidentMap;

constexpr int kAllRows = 1 << 20;

EdgeMap jumps_of(const GrayPlane& gray, const Image<std::int32_t>& map,
                 const Image<std::uint8_t>* changed, int band) {
  const int width = map.width(), height = map.height();
  EdgeMap edges;
  edges.resize(width, height);
  // No search for a value may depend on one above those of the padding.
  for (int y = 0; y < height; ++y) {
    std::fill_n(edges.disparity.row(y), edges.disparity.stride(), std::int16_t{0x7FFF});
  }
  test::poison(edges.gray);
  test::poison(edges.near);
  for (int y = 0; y < height; y += band) {
    find_jumps(gray.view(), map, changed, y, std::min(y + band, height), edges);
  }
  return edges;
}

ConfidentMap aligned(const GrayPlane& gray, const ConfidentMap& in, int band = kAllRows,
                     const Image<std::uint8_t>* changed = nullptr) {
  Image<std::int32_t> map = image_of(in.map);
  Image<std::uint8_t> confidence = image_of(in.confidence);
  const EdgeMap edges = jumps_of(gray, map, changed, band);
  EdgeScratch scratch;
  scratch.resize(map.width());
  for (int y = 0; y < map.height(); y += band) {
    align_edges(edges, y, std::min(y + band, map.height()), scratch, map, confidence);
  }
  return {copy_of(map), copy_of(confidence)};
}

GrayPlane doubted(const GrayPlane& gray, const ConfidentMap& in, int band = kAllRows) {
  Image<std::uint8_t> confidence = image_of(in.confidence);
  const EdgeMap edges = jumps_of(gray, image_of(in.map), nullptr, band);
  EdgeScratch scratch;
  scratch.resize(confidence.width());
  for (int y = 0; y < confidence.height(); y += band) {
    doubt_edges(edges, y, std::min(y + band, confidence.height()), scratch, confidence);
  }
  return copy_of(confidence);
}

GrayPlane random_gray(int width, int height, Random& random) {
  GrayPlane gray(width, height);
  for (std::uint8_t& value : gray.pixels) {
    value = static_cast<std::uint8_t>(random.below(2) == 0 ? 100 + random.below(30)
                                                           : random.below(256));
  }
  return gray;
}

/// A map without gaps.
DisparityPlane whole_map(int width, int height, std::uint64_t seed) {
  DisparityPlane map = test::patches(width, height, 0, seed);
  for (std::int32_t& d : map.pixels) d = d == 0 ? 700 : d;
  return map;
}

/// The marks, with padding that marks as well.
Image<std::uint8_t> marks_of(const GrayPlane& marked) {
  Image<std::uint8_t> marks;
  marks.resize(marked.width, marked.height);
  test::poison(marks);
  for (int y = 0; y < marked.height; ++y) {
    for (int x = 0; x < marked.width; ++x) marks.row(y)[x] = marked(x, y);
  }
  return marks;
}

void expect_reference(int width, int height, const DisparityPlane& map) {
  Random random(width);
  const GrayPlane gray = random_gray(width, height, random);
  ConfidentMap in = {map, GrayPlane(width, height)};
  for (std::uint8_t& c : in.confidence.pixels)
    c = static_cast<std::uint8_t>(random.between(1, 255));
  const ConfidentMap expected = reference::align_edges(gray, in);
  for (const int band : {1, 5, kAllRows}) {
    const ConfidentMap actual = aligned(gray, in, band);
    EXPECT_TRUE(same_image(expected.map, actual.map)) << "bands of " << band << " rows";
    EXPECT_TRUE(same_image(expected.confidence, actual.confidence)) << band;
    EXPECT_TRUE(same_image(expected.confidence, doubted(gray, in, band))) << band;
  }
  // Few pixels changed: most jumps do not count.
  GrayPlane changed(width, height);
  for (std::uint8_t& mark : changed.pixels) mark = random.below(30) == 0 ? 1 : 0;
  const Image<std::uint8_t> marks = marks_of(changed);
  const ConfidentMap of_changed = reference::align_edges(gray, in, &changed);
  for (const int band : {3, kAllRows}) {
    EXPECT_TRUE(same_image(of_changed.map, aligned(gray, in, band, &marks).map)) << band;
  }
}

TEST(EdgeAlignment, EqualsReferenceAtEveryWidthOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    for (int width = 1; width <= 200; width += width < 70 ? 1 : 29) {
      const int height = 1 + width % 23;
      expect_reference(width, height, whole_map(width, height, width));
    }
  });
}

TEST(EdgeAlignment, EqualsReferenceWithTheLargestDisparities) {
  DisparityPlane map = test::disparity_noise(40, 30, 0, 256 * 1984 - 1, 1);
  map(3, 3) = 256 * 1984 - 1;
  map(4, 3) = 1;
  expect_reference(40, 30, map);
}

TEST(EdgeAlignment, LeavesSlantedSurfacesAlone) {
  DisparityPlane map(60, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 60; ++x) map(x, y) = 500 + 200 * x + 100 * y;
  }
  Random random(1);
  const GrayPlane gray = random_gray(60, 30, random);
  const ConfidentMap in = {map, GrayPlane(60, 30, 200)};
  EXPECT_EQ(aligned(gray, in), in);
  EXPECT_EQ(doubted(gray, in), in.confidence);
}

/// An object of 20 px at columns 30 .. 49, in a map in which it has become 2 px wider on both
/// sides.
struct WideObject {
  WideObject() : gray(80, 40, 60), in{DisparityPlane(80, 40, 2560), GrayPlane(80, 40, 200)} {
    for (int y = 0; y < 40; ++y) {
      for (int x = 30; x < 50; ++x) gray(x, y) = 160;
      for (int x = 28; x < 52; ++x) in.map(x, y) = 7680;
    }
  }

  GrayPlane gray;
  ConfidentMap in;
};

TEST(EdgeAlignment, MovesAJumpToTheEdgeOfTheImage) {
  const WideObject scene;
  const ConfidentMap out = aligned(scene.gray, scene.in);
  for (int x = 0; x < 80; ++x) {
    const bool object = x >= 30 && x < 50, changed = !object && x >= 28 && x < 52;
    EXPECT_EQ(out.map(x, 20), object ? 7680 : 2560) << "column " << x;
    EXPECT_EQ(out.confidence(x, 20), changed ? kMostInferred : 200) << "column " << x;
  }
}

TEST(EdgeAlignment, LeavesJumpsAloneWhereNothingChanged) {
  const WideObject scene;
  Image<std::uint8_t> changed = image_of(GrayPlane(80, 40));
  EXPECT_EQ(aligned(scene.gray, scene.in, kAllRows, &changed), scene.in);
  for (int y = 0; y < 40; ++y) changed.row(y)[51] = 1;  // the right side of the object
  const ConfidentMap out = aligned(scene.gray, scene.in, kAllRows, &changed);
  EXPECT_EQ(out.map(28, 20), 7680);
  EXPECT_EQ(out.map(51, 20), 2560);
}

}  // namespace
}  // namespace mtstereo::edge_alignment_test

// SPDX-License-Identifier: LGPL-2.1-or-later
// The property free-space of mtdepth.
#include <gtest/gtest.h>

#include <cmath>

#include "support/map_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::free_space_test {
namespace {

constexpr double kConstant = 700 * 0.5;  // focal length x baseline [px m]
constexpr const char* kCaps =
    ",disparity-scale=256,max-disparity=64,focal-length=(double)700,baseline=(double)0.5";
constexpr int kWidth = 5;
constexpr int kHeight = 4;

/// 10 to 60 px. The second row has none, and others none at one of their ends.
const Map16 kMap = {kWidth, kHeight, {2560,  0,     5120, 0,    0,     //
                                      0,     0,     0,    0,    0,     //
                                      0,     10240, 0,    0,    2560,  //
                                      15360, 0,     0,    5120, 0}};

/// The bounds of kMap.
const Map16 kBounds = {kWidth, kHeight, {2560,  10240, 5120,  0,     0,     //
                                         0,     0,     0,     0,     0,     //
                                         0,     10240, 10240, 10240, 2560,  //
                                         15360, 15360, 15360, 5120,  0}};

/// The depths of disparities in mm; 0 = none.
std::vector<std::uint16_t> depths(const Map16& map, double near = 0, double far = 1e6) {
  std::vector<std::uint16_t> values;
  for (const int value : map.values) {
    const double depth = value == 0 ? 0 : kConstant * 256 / value;
    values.push_back(depth < near || depth > far
                         ? std::uint16_t{0}
                         : static_cast<std::uint16_t>(std::lround(depth * 1000)));
  }
  return values;
}

void expect_depths(const std::vector<std::uint16_t>& expected, const BufferPointer& out) {
  ASSERT_TRUE(out);
  EXPECT_EQ(first_difference(expected, map_of(out.get(), kWidth, kHeight), kWidth), "");
}

gboolean free_space(GstElement* element) {
  gboolean value = TRUE;
  g_object_get(element, "free-space", &value, nullptr);
  return value;
}

TEST(FreeSpaceProperty, IsOffByDefault) {
  MapHarness harness("mtdepth", "");
  EXPECT_FALSE(free_space(harness.element()));
  harness.caps(kWidth, kHeight, kCaps);
  expect_depths(depths(kMap), harness.pass(map_buffer(kMap)));
}

// Feature: free space
TEST(FreeSpaceProperty, GivesPixelsWithoutADisparityTheDepthOfTheirBound) {
  MapHarness harness("mtdepth", "free-space=true");
  EXPECT_TRUE(free_space(harness.element()));
  harness.caps(kWidth, kHeight, kCaps);
  const BufferPointer out = harness.pass(map_buffer(kMap));
  expect_depths(depths(kBounds), out);
  const std::vector<std::uint16_t> with = map_of(out.get(), kWidth, kHeight);
  const std::vector<std::uint16_t> without = depths(kMap);
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (without[i] == 0) continue;
    EXPECT_EQ(with[i], without[i]) << i;
  }
}

TEST(FreeSpaceProperty, OfAMapWithoutDisparitiesIsNone) {
  for (const char* properties : {"free-space=true", "free-space=true overflow=clamp"}) {
    MapHarness harness("mtdepth", properties);
    harness.caps(kWidth, kHeight, kCaps);
    const Map16 empty = {kWidth, kHeight, std::vector<std::uint16_t>(kWidth * kHeight, 0)};
    expect_depths(empty.values, harness.pass(map_buffer(empty)));
  }
}

TEST(FreeSpaceProperty, HasTheLimitsOfDepths) {
  // 5.8, 8.75, 17.5 and 35 m: the bound is found before the limits remove depths.
  MapHarness harness("mtdepth", "free-space=true near=7 far=20");
  harness.caps(kWidth, kHeight, kCaps);
  expect_depths(depths(kBounds, 7, 20), harness.pass(map_buffer(kMap)));
}

TEST(FreeSpaceProperty, HasTheOverflowOfDepths) {
  const Map16 map = {3, 2, {1, 0, 1, 0, 0, 0}};  // 89600 m
  for (const auto& [properties, depth] :
       {std::pair{"free-space=true", std::uint16_t{0}},
        {"free-space=true overflow=clamp", std::uint16_t{65535}}}) {
    MapHarness harness("mtdepth", properties);
    harness.caps(3, 2, kCaps);
    const BufferPointer out = harness.pass(map_buffer(map));
    ASSERT_TRUE(out);
    const std::vector<std::uint16_t> expected = {depth, depth, depth, 0, 0, 0};
    EXPECT_EQ(first_difference(expected, map_of(out.get(), 3, 2), 3), "");
  }
}

TEST(FreeSpaceProperty, KeepsTheConfidenceWhichIsZeroWhereADepthIsABound) {
  std::vector<std::uint8_t> sure;
  for (const std::uint16_t value : kMap.values) {
    sure.push_back(value == 0 ? std::uint8_t{0} : std::uint8_t{200});
  }
  MapHarness harness("mtdepth", "free-space=true");
  harness.caps(kWidth, kHeight, kCaps);
  GstBuffer* buffer = map_buffer(kMap);
  attach_confidence(buffer, kWidth, kHeight, sure);
  const BufferPointer out = harness.pass(buffer);
  expect_depths(depths(kBounds), out);
  EXPECT_EQ(confidence_of(out.get()), sure);
}

TEST(FreeSpaceProperty, PaddingAndOddAddressesMakeNoDifference) {
  for (const auto& [padding, offset] : {std::pair{4, 0}, {0, 8}, {12, 2}, {3, 0}, {0, 1}, {5, 3}}) {
    MapHarness harness("mtdepth", "free-space=true");
    harness.caps(kWidth, kHeight, kCaps);
    for (int i = 0; i < 2; ++i) {
      expect_depths(depths(kBounds), harness.pass(map_buffer(kMap, 0, padding, offset)));
    }
  }
}

TEST(FreeSpaceProperty, CanBeChangedWhilePlaying) {
  MapHarness harness("mtdepth", "");
  harness.caps(kWidth, kHeight, kCaps);
  for (const bool on : {false, true, false}) {
    g_object_set(harness.element(), "free-space", on ? TRUE : FALSE, nullptr);
    expect_depths(depths(on ? kBounds : kMap), harness.pass(map_buffer(kMap)));
  }
  const BufferPointer shared(map_buffer(kMap));
  g_object_set(harness.element(), "free-space", TRUE, nullptr);
  expect_depths(depths(kBounds), harness.pass(gst_buffer_ref(shared.get())));
  expect_depths(kMap.values, shared);
}

}  // namespace
}  // namespace mtstereo::test::free_space_test

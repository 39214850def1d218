// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mtstereo/geometry/free_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::free_space_test {
namespace {

using test::PaddedImage;
using Map = test::Plane<std::uint16_t>;

constexpr std::pair<int, int> kDirections[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

/// The bound of one pixel by its definition: walks in each direction up to the border.
std::uint16_t reference(const Map& map, int x, int y) {
  if (map(x, y) != 0) return map(x, y);
  std::uint16_t bound = 0;
  int in_row = 0;
  for (const auto& [dx, dy] : kDirections) {
    int u = x + dx;
    int v = y + dy;
    while (u >= 0 && u < map.width && v >= 0 && v < map.height && map(u, v) == 0) {
      u += dx;
      v += dy;
    }
    if (u < 0 || u == map.width || v < 0 || v == map.height) continue;
    bound = std::max(bound, map(u, v));
    in_row += dy == 0;
  }
  return in_row == 2 ? bound : std::uint16_t{0};
}

Map reference(const Map& map) {
  Map bounds(map.width, map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) bounds(x, y) = reference(map, x, y);
  }
  return bounds;
}

/// Random disparities, of_ten in ten of them unknown.
Map random_map(int width, int height, int of_ten, std::uint64_t seed) {
  test::Random random(seed);
  Map map(width, height);
  for (std::uint16_t& value : map.pixels) {
    if (random.below(10) >= of_ten) value = static_cast<std::uint16_t>(random.between(1, 65535));
  }
  return map;
}

/// The bounds as the library computes them.
Map bounds_of(const Map& map, FreeSpace& space) {
  Map bounds(map.width, map.height, 12345);
  const Status status = space.bound_unknown(
      map.view(), {bounds.pixels.data(), map.width, map.height, map.view().stride});
  EXPECT_TRUE(status.ok());
  return bounds;
}

Map bounds_of(const Map& map) {
  FreeSpace space;
  return bounds_of(map, space);
}

Map map_of(int width, int height, std::vector<std::uint16_t> values) {
  Map map(width, height);
  map.pixels = std::move(values);
  return map;
}

TEST(FreeSpace, IsBoundedByTheNearestDisparitiesInFourDirections) {
  const Map map = map_of(5, 5, {9, 0, 1, 0, 9,  //
                                0, 0, 2, 0, 0,  //
                                3, 0, 0, 0, 4,  //
                                0, 0, 5, 0, 0,  //
                                9, 0, 8, 0, 9});
  const Map bounds = map_of(5, 5, {9, 9, 1, 9, 9,  //
                                   0, 0, 2, 0, 0,  //
                                   3, 4, 5, 4, 4,  //
                                   0, 0, 5, 0, 0,  //
                                   9, 9, 8, 9, 9});
  EXPECT_TRUE(test::same_image(bounds, bounds_of(map)));
  EXPECT_TRUE(test::same_image(bounds, reference(map)));
}

TEST(FreeSpace, HasNoBoundWithoutADisparityOnBothSides) {
  const Map map = map_of(4, 3,
                         {7, 0, 0, 0,  //
                          0, 0, 0, 6,  //
                          8, 0, 9, 0});
  const Map bounds = map_of(4, 3,
                            {7, 0, 0, 0,  //
                             0, 0, 0, 6,  //
                             8, 9, 9, 0});
  EXPECT_TRUE(test::same_image(bounds, bounds_of(map)));
}

TEST(FreeSpace, OfAnEmptyMapIsEmptyAndOfAFullOneTheMap) {
  const Map empty(13, 7);
  EXPECT_TRUE(test::same_image(empty, bounds_of(empty)));
  const Map full = random_map(13, 7, 0, 1);
  EXPECT_TRUE(test::same_image(full, bounds_of(full)));
}

// Feature: free space
TEST(FreeSpace, EqualsTheReferenceForAllSizesAndStrides) {
  FreeSpace space;
  std::uint64_t seed = 1;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 1}, {1, 2}, {33, 1}, {1, 33}, {31, 13}, {64, 3}, {3, 64}, {97, 41}}) {
    for (const int of_ten : {0, 3, 8, 9, 10}) {
      const Map map = random_map(width, height, of_ten, ++seed);
      for (const int padding : {0, 2, 30}) {
        const PaddedImage<std::uint16_t> in(map, padding, 2);
        PaddedImage<std::uint16_t> out(Map(width, height, 12345), padding + 4);
        ASSERT_TRUE(space.bound_unknown(in.view(), out.writable()).ok());
        EXPECT_TRUE(test::same_image(reference(map), test::copy_of(out.view())));
        EXPECT_TRUE(in.unchanged());
        EXPECT_TRUE(out.padding_unchanged());
      }
    }
  }
}

TEST(FreeSpace, DoesNotDependOnEarlierMaps) {
  FreeSpace space;
  for (const auto& [width, height] : {std::pair{40, 30}, {7, 5}, {30, 40}, {41, 30}}) {
    const Map full = random_map(width, height, 0, 3);
    EXPECT_TRUE(test::same_image(full, bounds_of(full, space)));
    const Map empty(width, height);
    EXPECT_TRUE(test::same_image(empty, bounds_of(empty, space)));
    const Map map = random_map(width, height, 9, 4);
    EXPECT_TRUE(test::same_image(reference(map), bounds_of(map, space)));
  }
}

TEST(FreeSpace, MayBeWrittenInPlace) {
  const Map map = random_map(37, 23, 8, 5);
  PaddedImage<std::uint16_t> image(map, 6);
  FreeSpace space;
  ASSERT_TRUE(space.bound_unknown(image.view(), image.writable()).ok());
  EXPECT_TRUE(test::same_image(reference(map), test::copy_of(image.view())));
  EXPECT_TRUE(image.padding_unchanged());
}

TEST(FreeSpace, CanBeMoved) {
  const Map map = random_map(37, 23, 8, 6);
  FreeSpace space;
  ASSERT_TRUE(test::same_image(reference(map), bounds_of(map, space)));
  FreeSpace moved(std::move(space));
  EXPECT_TRUE(test::same_image(reference(map), bounds_of(map, moved)));
  space = std::move(moved);
  EXPECT_TRUE(test::same_image(reference(map), bounds_of(map, space)));
}

TEST(FreeSpace, RefusesImagesThatDoNotFit) {
  FreeSpace space;
  Map map(8, 4);
  map(0, 0) = 256;
  const Map before = map;
  const auto write = [&](ImageView<const std::uint16_t> in, ImageView<std::uint16_t> out) {
    const Status status = space.bound_unknown(in, out);
    EXPECT_FALSE(status.ok());
    return status.ok() ? Error{ErrorCode::kSystem, ""} : status.error();
  };
  std::uint16_t* data = map.pixels.data();
  const Error sizes = write(map.view(), {data, 4, 8, 8});
  EXPECT_EQ(sizes.code, ErrorCode::kSizeMismatch);
  EXPECT_NE(sizes.message.find("8x4"), std::string::npos) << sizes.message;
  EXPECT_NE(sizes.message.find("4x8"), std::string::npos) << sizes.message;
  EXPECT_EQ(write({}, {}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write(map.view(), {nullptr, 8, 4, 16}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 8, 4, 15}, {data, 8, 4, 16}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 8, 4, 16}, {data, 8, 4, 14}).code, ErrorCode::kInvalidImage);
  EXPECT_EQ(write({data, 0, 4, 16}, {data, 0, 4, 16}).code, ErrorCode::kInvalidImage);
  EXPECT_TRUE(test::same_image(before, map));
}

}  // namespace
}  // namespace mtstereo::free_space_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/neighbors.hpp"

#include <gtest/gtest.h>

#include "support/stages.hpp"

namespace mtstereo {
namespace {

using test::Random;

constexpr int kNone = -7;

/// Random values for the nodes of a level, some of them none.
template <typename T>
Buffer<T> random_values(const NodeLevel& level, Random& random, int of_ten_none) {
  Buffer<T> values;
  values.resize(level.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<T>(random.below(10) < of_ten_none ? kNone : random.between(0, 50));
  }
  return values;
}

/// Compares the medians of all nodes with those of a sorted list.
template <typename T>
void expect_reference(int width, int height, int most, int of_ten_none, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << most << " neighbors, "
                                  << of_ten_none << " of 10 without a value");
  const test::RandomLevels levels(width, height, 0, seed);
  Random random(seed);
  const Buffer<T> values = random_values<T>(levels.left, random, of_ten_none);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < levels.left.count[y]; ++i) {
      std::vector<int> found;
      for (const reference::Place& place :
           reference::surroundings(levels.plain_left, {y, i}, most)) {
        const T value = values[levels.left.first[place.y] + place.i];
        if (value != kNone) found.push_back(value);
      }
      ASSERT_EQ(
          reference::lower_median(found, kNone),
          median_over_neighbors(levels.left, y, i, most, values.data(), static_cast<T>(kNone)))
          << "row " << y << ", node " << i;
    }
  }
}

TEST(MedianOverNeighbors, EqualsReference) {
  for (const int of_ten_none : {0, 3, 8}) {
    for (const int most : {0, 1, 2, 10, 100}) {
      expect_reference<std::int32_t>(40, 31, most, of_ten_none, 1 + most);
      expect_reference<std::int16_t>(7, 50, most, of_ten_none, 2 + most);
    }
  }
}

TEST(MedianOverNeighbors, IsNoneWhereNothingIsKnown) {
  expect_reference<std::int32_t>(30, 12, 5, 10, 3);
}

TEST(MedianOverNeighbors, TakesTheLongestChains) {
  // One leaf of three columns in each row: every node has a hundred neighbors on both sides.
  test::GrayPlane rows(9, 301);
  for (int y = 0; y < 301; ++y) {
    for (int x = 3; x < 6; ++x) rows(x, y) = 1;
  }
  const NodeLevel level = test::level_of(test::trees_of(rows), 0, test::kAnyWidth);
  Buffer<std::int32_t> values;
  values.resize(level.size());
  for (int y = 0; y < 301; ++y) values[level.first[y]] = 1000 + y;
  EXPECT_EQ(1150, median_over_neighbors(level, 150, 0, 100, values.data(), 0));
  EXPECT_EQ(1000 + 50, median_over_neighbors(level, 0, 0, 100, values.data(), 0));
  EXPECT_EQ(1000 + 250, median_over_neighbors(level, 300, 0, 100, values.data(), 0));
}

}  // namespace
}  // namespace mtstereo

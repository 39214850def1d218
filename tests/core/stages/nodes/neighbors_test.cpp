// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/neighbors.hpp"

#include <gtest/gtest.h>

#include "support/stages.hpp"

namespace mtstereo::neighbors_test {
namespace {

constexpr int kNone = -7;

/// Random values for the nodes of a level, with some nodes without a value.
template <typename T>
Buffer<T> random_values(const NodeLevel& level, Random& random, int of_ten_none) {
  Buffer<T> values;
  values.resize(level.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<T>(random.below(10) < of_ten_none ? kNone : random.between(0, 50));
  }
  return values;
}

/// Compares the medians of all nodes with those of sorted lists.
template <typename T>
void expect_reference(int width, int height, int most, int of_ten_none, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << most << " neighbors, "
                                  << of_ten_none << " of 10 without a value");
  const test::RandomLevels levels(width, height, 0, seed);
  Random random(seed);
  const Buffer<T> begins = random_values<T>(levels.left, random, of_ten_none);
  const Buffer<T> ends = random_values<T>(levels.left, random, of_ten_none);
  for (int y = 0; y < height; ++y) {
    for (int i = 0; i < levels.left.count[y]; ++i) {
      std::vector<int> found_begins, found_ends;
      for (const reference::Place& place :
           reference::surroundings(levels.plain_left, {y, i}, most)) {
        const T begin = begins[levels.left.first[place.y] + place.i];
        const T end = ends[levels.left.first[place.y] + place.i];
        if (begin != kNone) found_begins.push_back(begin);
        if (end != kNone) found_ends.push_back(end);
      }
      const EndMedians median = medians_over_neighbors(levels.left, y, i, most, begins.data(),
                                                       ends.data(), static_cast<T>(kNone));
      ASSERT_EQ(reference::lower_median(found_begins, kNone), median.begin)
          << "row " << y << ", node " << i;
      ASSERT_EQ(reference::lower_median(found_ends, kNone), median.end)
          << "row " << y << ", node " << i;
    }
  }
}

TEST(MediansOverNeighbors, EqualsReference) {
  for (const int of_ten_none : {0, 3, 8}) {
    for (const int most : {0, 1, 2, 10, 100}) {
      expect_reference<std::int32_t>(40, 31, most, of_ten_none, 1 + most);
      expect_reference<std::int16_t>(7, 50, most, of_ten_none, 2 + most);
    }
  }
}

TEST(MediansOverNeighbors, IsNoneWithoutKnownValues) {
  expect_reference<std::int32_t>(30, 12, 5, 10, 3);
}

TEST(MediansOverNeighbors, IncludesTheLongestChains) {
  // One leaf of three columns in each row: each node in the middle has a hundred neighbors on both
  // sides.
  test::GrayPlane rows(9, 301);
  for (int y = 0; y < 301; ++y) {
    for (int x = 3; x < 6; ++x) rows(x, y) = 1;
  }
  const NodeLevel level = test::level_of(test::trees_of(rows), 0, test::kAnyWidth);
  Buffer<std::int32_t> begins, ends;
  begins.resize(level.size());
  ends.resize(level.size());
  for (int y = 0; y < 301; ++y) {
    begins[level.first[y]] = 1000 + y;
    ends[level.first[y]] = 5000 - y;
  }
  const auto medians = [&](int y) {
    const EndMedians median =
        medians_over_neighbors(level, y, 0, 100, begins.data(), ends.data(), 0);
    return std::pair(median.begin, median.end);
  };
  EXPECT_EQ(std::pair(1150, 4850), medians(150));
  EXPECT_EQ(std::pair(1050, 4950), medians(0));
  EXPECT_EQ(std::pair(1250, 4750), medians(300));
}

}  // namespace
}  // namespace mtstereo::neighbors_test

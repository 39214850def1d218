// SPDX-License-Identifier: LGPL-2.1-or-later
#include "alignment/coarse_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "support/plane.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::coarse_search_test {
namespace {

using Outcome = Place::Outcome;

constexpr SearchWindow kWindow = {-6, 40, 5};

/// The right view in which every point of the left one is `disparity` px further to the left and
/// `rows` px lower.
GrayPlane moved(const GrayPlane& left, int disparity, int rows) {
  GrayPlane right(left.width, left.height);
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) right(x, y) = left.clamped(x + disparity, y - rows);
  }
  return right;
}

Place find(const GrayPlane& left, const GrayPlane& right, int x, int y,
           const SearchWindow& window = kWindow) {
  SearchScratch scratch;
  return find_in_right_view(test::image_of(left), test::image_of(right), {x, y}, window, scratch);
}

TEST(CoarseSearch, FindsThePlaceInTheWholeWindow) {
  const GrayPlane left = test::texture(160, 60, 1);
  test::for_each_simd_target([&] {
    for (const int disparity : {-6, -1, 0, 13, 40}) {
      for (const int rows : {-5, 0, 2, 5}) {
        const Place place = find(left, moved(left, disparity, rows), 80, 30);
        ASSERT_TRUE(place.found()) << disparity << ", " << rows;
        EXPECT_EQ(80 - disparity, place.x);
        EXPECT_EQ(30 + rows, place.y);
      }
    }
  });
}

TEST(CoarseSearch, StaysInTheWindowAndInTheViews) {
  const GrayPlane left = test::texture(160, 60, 2), right = test::texture(160, 60, 4);
  for (int y = 9; y < 51; y += 3) {
    for (int x = 9; x < 151; x += 3) {
      const Place place = find(left, right, x, y);
      if (!place.found()) continue;
      EXPECT_TRUE(place.x >= std::max(x - 40, 8) && place.x <= std::min(x + 6, 152));
      EXPECT_TRUE(place.y >= std::max(y - 5, 5) && place.y <= std::min(y + 5, 54));
    }
  }
}

TEST(CoarseSearch, SeldomFindsAPlaceInUnrelatedViews) {
  const GrayPlane left = test::texture(160, 60, 3), right = test::texture(160, 60, 4);
  int found = 0;
  for (int x = 50; x < 150; x += 5) found += find(left, right, x, 30).found() ? 1 : 0;
  EXPECT_LE(found, 8) << "of 20";
}

TEST(CoarseSearch, ReportsRepeatedPatterns) {
  const GrayPlane tile = test::texture(12, 12, 5);
  GrayPlane left(160, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 160; ++x) left(x, y) = tile(x % 12, y % 12);
  }
  EXPECT_EQ(Outcome::kRepeated, find(left, moved(left, 5, 0), 80, 30).outcome);
}

/// The place by a search through all places, or nothing if it is not distinct.
std::optional<std::pair<int, int>> plain_search(const GrayPlane& from, int x, int y,
                                                const GrayPlane& in, int x0, int x1, int rows,
                                                double distinctness) {
  const auto cost_at = [&](int px, int py) {
    int cost = 0;
    for (int j = -5; j <= 5; ++j) {
      for (int i = -8; i < 8; ++i) cost += std::abs(from(x + i, y + j) - in(px + i, py + j));
    }
    return cost;
  };
  std::optional<std::pair<int, int>> best;
  int least = 0;
  const auto for_each_place = [&](auto&& body) {
    for (int py = std::max(y - rows, 5); py <= std::min(y + rows, in.height - 6); ++py) {
      for (int px = std::max(x0, 8); px <= std::min(x1, in.width - 8); ++px) {
        body(px, py, cost_at(px, py));
      }
    }
  };
  for_each_place([&](int px, int py, int cost) {
    if (best && cost >= least) return;
    best = {px, py};
    least = cost;
  });
  bool distinct = best.has_value();
  for_each_place([&](int px, int py, int cost) {
    const bool near = std::abs(px - best->first) <= 2 && std::abs(py - best->second) <= 2;
    if (!near && cost <= distinctness * least) distinct = false;
  });
  return distinct ? best : std::nullopt;
}

TEST(CoarseSearch, EqualsASearchThroughAllPlaces) {
  int found = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const test::Pair pair = test::slanted_pair(120, 50, 30, seed);
    for (int y = 9; y < 41; y += 4) {
      for (int x = 9; x < 111; x += 6) {
        const Place place = find(pair.left, pair.right, x, y);
        const auto there =
            plain_search(pair.left, x, y, pair.right, x - 40, x + 6, 5, kDistinctness);
        bool expected = there.has_value();
        if (expected) {
          const auto [px, py] = *there;
          const auto back = plain_search(pair.right, px, py, pair.left, px - 6, px + 40, 5, 0);
          expected = back && std::abs(back->first - x) <= 1 && std::abs(back->second - y) <= 1;
        }
        ASSERT_EQ(expected, place.found()) << x << ", " << y;
        if (!expected) continue;
        ++found;
        EXPECT_EQ(*there, std::pair(place.x, place.y));
      }
    }
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace mtstereo::coarse_search_test

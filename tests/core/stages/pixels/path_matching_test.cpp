// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/path_matching.hpp"

#include <gtest/gtest.h>

#include "reference/pixels/gray_balance.hpp"
#include "reference/pixels/path_matching.hpp"
#include "support/census.hpp"
#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/simd_targets.hpp"
#include "support/windows.hpp"

namespace mtstereo::path_matching_test {
namespace {

using reference::RatedMap;
using test::Pair;

/// How much darker the left view is made for the cost of gray values.
constexpr std::int16_t kBrighter = 3;

/// Matches a pair, from the last chunk to the first; with gray values if there is a half map.
RatedMap matched(const Pair& pair, const DisparityPlane* half_map,
                 const PathMatchingOptions& options, PathMatchingScratch& scratch,
                 const SearchWindows& windows = {}, WindowVotes* votes = nullptr) {
  const test::CensusPair census(pair.left.view(), pair.right.view());
  const int width = pair.left.width, height = pair.left.height;
  Image<std::int32_t> map, half;
  Image<std::uint8_t> ratio;
  map.resize(width, height);
  ratio.resize(width, height);
  test::poison(map);
  test::poison(ratio);
  if (half_map != nullptr) half = image_of(*half_map);
  scratch.resize(width, height, options);
  GrayBalance balance;
  balance.resize((width + 1) / 2, (height + 1) / 2);
  for (int y = 0; y < balance.around.height(); ++y) {
    std::fill_n(balance.around.row(y), balance.around.width(), kBrighter);
  }
  const GrayPair gray = {pair.left.view(), pair.right.view(), balance};
  const PathMatchingInput input = {
      pair.left.view(),
      {census.left, census.right, half_map == nullptr ? nullptr : &gray},
      half_map == nullptr ? nullptr : &half,
      windows};
  const int threads = height % 2 + 1;
  const int rows = path_rows(options, height, threads);
  for (int i = (height - 1) / rows; i >= 0; --i) {
    match_along_paths(input, options, i * rows, std::min((i + 1) * rows, height), scratch, map,
                      ratio, votes);
  }
  RatedMap out(width, height);
  out.map = copy_of(map);
  out.ratio = copy_of(ratio);
  return out;
}

TEST(PathMatching, KeepsTwoThreadsBusyAtReducedResolutions) {
  PathMatchingOptions options = {};
  options.column_paths = ColumnPaths::kFromAbove;
  options.most_rows = kReducedPathRows;
  // Half and quarter of 375, 480, 720 and 1080 rows.
  for (const int height : {188, 94, 240, 120, 360, 180, 540, 270}) {
    const int rows = path_rows(options, height, 2);
    EXPECT_LE(rows, kReducedPathRows);
    int first = 0;  // of threads that take chunks in turn
    for (int y = 0; y < height; y += 2 * rows) first += std::min(rows, height - y);
    EXPECT_LE(first, 0.55 * height) << height << " rows by " << rows;
  }
}

PathMatchingOptions random_options(int disparities, Random& random) {
  return {{disparities, 2 * random.below(3) + 1, random.below(33)},
          {random.below(51), random.below(51)},
          {disparities, 0.06 * random.below(2), false, random.between(-1, 2), random.below(2) == 0,
           random.below(50), random.between(-1, 3)},
          static_cast<ColumnPaths>(random.below(3)),
          kWindowTile * random.between(1, 4)};
}

/// A map of half the size with disparities near half of `around`, a third of it unknown.
DisparityPlane half_map_of(const Pair& pair, int disparities, int around, Random& random) {
  DisparityPlane half((pair.left.width + 1) / 2, (pair.left.height + 1) / 2);
  for (std::int32_t& d : half.pixels) {
    if (random.below(3) > 0) d = random.between(1, 256 * std::max((disparities + 1) / 2, 1) - 1);
    if (random.below(3) == 0) d = 128 * around + 1;
  }
  return half;
}

void expect_reference(int width, int height, PathMatchingScratch& scratch) {
  Random random(100 * width + height);
  const int disparities = random.between(1, width);
  const int shift = random.below(disparities);
  const Pair pair = test::shifted_pair(width, height, shift, width);
  const DisparityPlane half = half_map_of(pair, disparities, shift, random);
  for (const DisparityPlane* half_map : {static_cast<const DisparityPlane*>(nullptr), &half}) {
    const PathMatchingOptions options = random_options(disparities, random);
    const SearchWindows windows =
        half_map == nullptr ? SearchWindows()
                            : test::random_windows(width, height, cost_lanes(disparities), random);
    const GrayPlane balanced =
        reference::balanced(pair.left, test::Plane<int>(1, 1, kBrighter), 1 << 20);
    const RatedMap expected = reference::match_along_paths(
        {pair.left, pair.right, half_map, test::copy_of(windows, width, height), 2,
         half_map == nullptr ? nullptr : &balanced, &pair.right},
        options);
    const RatedMap actual = matched(pair, half_map, options, scratch, windows);
    EXPECT_TRUE(same_image(expected.map, actual.map)) << width << "x" << height;
    EXPECT_TRUE(same_image(expected.ratio, actual.ratio)) << width << "x" << height;
  }
}

TEST(PathMatching, EqualsReferenceAtEveryWidth) {
  PathMatchingScratch scratch;
  for (int width = 1; width <= 70; ++width) expect_reference(width, 1 + width % 7, scratch);
}

TEST(PathMatching, EqualsReferenceInSeveralChunks) {
  test::for_each_simd_target([] {
    PathMatchingScratch scratch;
    for (const int height : {1, 63, 64, 65, 79, 80, 128, 150, 200}) {
      expect_reference(11, height, scratch);
    }
  });
}

TEST(PathMatching, EqualsReferenceInManyWindows) {
  PathMatchingScratch scratch;
  for (const int width : {130, 160, 201}) expect_reference(width, 36, scratch);
}

TEST(PathMatching, CountsTheVotesOfPathsAndCosts) {
  PathMatchingScratch scratch;
  const int width = 70, height = 90;
  const Pair pair = test::shifted_pair(width, height, 9, 3);
  const PathMatchingOptions options = {
      {24, 3, 2}, {12, 51}, {24, 0, false, 2, true, 60}, ColumnPaths::kBoth};
  WindowVotes votes;
  votes.resize(2 * width, 2 * height, 64);
  const RatedMap out = matched(pair, nullptr, options, scratch, {}, &votes);
  SearchWindows windows;
  windows.resize(2 * width, 2 * height, 64);
  choose_windows(votes, windows);
  const DisparityPlane by_cost =
      reference::match_by_cost({pair.left, pair.right, nullptr}, options);
  const reference::Windows expected =
      reference::choose_windows(out.map, by_cost, 2 * width, 2 * height, 64);
  EXPECT_EQ(expected.tiles, test::copy_of(windows, 2 * width, 2 * height).tiles);
}

TEST(PathMatching, FindsTheDisparityOfEveryPixelThatBothViewsShow) {
  PathMatchingScratch scratch;
  const Pair pair = test::shifted_pair(120, 90, 17, 1);
  const PathMatchingOptions options = {
      {40, 3, 2}, {5, 30}, {40, 0, false, 1, true, 60}, ColumnPaths::kBoth};
  const RatedMap out = matched(pair, nullptr, options, scratch);
  long right = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 17; x < 120; ++x) right += std::abs(out.map(x, y) - 256 * 17) <= 128;
  }
  EXPECT_GT(right, 90 * 103 * 98 / 100);
}

TEST(PathMatching, PrefersWhatTheHalfMapExpects) {
  // Stripes that repeat every 8 px fit at 3, 11, 19 ... px alike.
  Pair pair = test::shifted_pair(120, 40, 0, 1);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 120; ++x) {
      pair.left(x, y) = static_cast<std::uint8_t>((x + 5) % 8 < 4 ? 200 : 40);
      pair.right(x, y) = static_cast<std::uint8_t>(x % 8 < 4 ? 200 : 40);
    }
  }
  PathMatchingScratch scratch;
  const PathMatchingOptions options = {
      {40, 3, 2}, {5, 30}, {40, -1, false, -1, true, 60}, ColumnPaths::kBoth};
  const DisparityPlane expected(60, 20, 128 * 19);
  const RatedMap out = matched(pair, &expected, options, scratch);
  for (int y = 8; y < 32; ++y) {
    for (int x = 48; x < 112; ++x) EXPECT_NEAR(out.map(x, y), 256 * 19, 256) << x << ", " << y;
  }
}

}  // namespace
}  // namespace mtstereo::path_matching_test

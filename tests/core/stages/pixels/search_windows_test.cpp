// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_windows.hpp"

#include <gtest/gtest.h>

#include "support/half_maps.hpp"
#include "support/windows.hpp"

namespace mtstereo::search_windows_test {
namespace {

/// The windows by the votes of both maps, counted in bands.
SearchWindows chosen(const DisparityPlane& by_path, const DisparityPlane& by_cost, int width,
                     int height, int lanes) {
  WindowVotes votes;
  votes.resize(width, height, lanes);
  std::fill_n(votes.known.data(), votes.known.size(), std::uint8_t{77});
  std::fill_n(votes.by_path.data(), votes.by_path.size(), std::uint8_t{77});
  std::fill_n(votes.by_cost.data(), votes.by_cost.size(), std::uint8_t{77});
  for (int y0 = 0; y0 < by_path.height; y0 += 64) {
    const int y1 = std::min(y0 + 64, by_path.height);
    clear_votes(y0, y1, votes);
    for (int y = y0; y < y1; ++y) {
      count_votes(&by_path(0, y), &by_cost(0, y), by_path.width, y, votes);
    }
  }
  SearchWindows windows;
  windows.resize(width, height, lanes);
  choose_windows(votes, windows);
  return windows;
}

TEST(SearchWindows, EqualReferenceAtEverySize) {
  Random random(1);
  long narrow = 0, tiles = 0;
  for (int i = 0; i < 300; ++i) {
    const int width = random.between(1, 120), height = random.between(1, 150);
    const int disparities = random.between(1, 300), lanes = cost_lanes(disparities);
    const DisparityPlane by_path =
        test::random_half_map(width, height, disparities, random.below(101), random);
    const DisparityPlane by_cost =
        test::random_half_map(width, height, disparities, random.below(40), random);
    const reference::Windows expected =
        reference::choose_windows(by_path, by_cost, width, height, lanes);
    const SearchWindows actual = chosen(by_path, by_cost, width, height, lanes);
    EXPECT_EQ(expected.tiles, test::copy_of(actual, width, height).tiles)
        << width << "x" << height << ", " << disparities << " disparities";
    for (const CostWindow& window : expected.tiles) {
      ++tiles;
      narrow += window.end - window.begin < lanes;
    }
  }
  EXPECT_GT(narrow, tiles / 5) << "most windows must not be all disparities";
}

TEST(SearchWindows, ConsistOfWholeVectorsInsideOfTheLanes) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const int width = random.between(1, 200), height = random.between(1, 100);
    const int lanes = 32 * random.between(1, 20);
    const SearchWindows windows = test::random_windows(width, height, lanes, random);
    for (const CostWindow& window : test::copy_of(windows, width, height).tiles) {
      EXPECT_LT(window.begin, window.end);
      EXPECT_LE(window.end, lanes);
      EXPECT_EQ(0, window.begin % 16);
      EXPECT_EQ(0, (window.end - window.begin) % 32);
    }
  }
}

TEST(SearchWindows, CoverTheWindowsOfSeveralRows) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const int width = random.between(1, 100), height = random.between(1, 100);
    const SearchWindows windows = test::random_windows(width, height, 256, random);
    for (int y = -2; y < height + 2; ++y) {
      for (const int rows : {1, 2, 6, kWindowTile}) {
        const CostWindow* covering = windows.covering(y, y + rows - 1);
        for (int other = y; other < y + rows; ++other) {
          const CostWindow* row = windows.row(std::clamp(other, 0, height - 1));
          for (int tile = 0; tile < (width + 15) / 16; ++tile) {
            EXPECT_LE(covering[tile].begin, row[tile].begin);
            EXPECT_GE(covering[tile].end, row[tile].end);
            EXPECT_EQ(0, (covering[tile].end - covering[tile].begin) % 32);
          }
        }
      }
    }
  }
}

TEST(SearchWindows, AreAllDisparitiesWithoutVotes) {
  const SearchWindows none;
  EXPECT_EQ(nullptr, none.row(5));
  EXPECT_EQ(nullptr, none.covering(3, 8));
  EXPECT_EQ((CostWindow{0, 96}), window_at(none.row(5), 96, 70));
  const DisparityPlane unknown(20, 20);
  const SearchWindows windows = chosen(unknown, unknown, 40, 40, 96);
  for (int x = 0; x < 40; ++x) EXPECT_EQ((CostWindow{0, 96}), window_at(windows.row(7), 96, x));
}

TEST(SearchWindows, ContainAThinObjectThatOnlyTheCostsSee) {
  // A wall at 10 px, and in it a post at 70 px of which eight pixels are seen.
  DisparityPlane by_path(40, 40, 256 * 5), by_cost = by_path;
  for (int y = 16; y < 24; ++y) by_cost(20, y) = 256 * 35;
  const SearchWindows windows = chosen(by_path, by_cost, 80, 80, 128);
  const CostWindow window = window_at(windows.row(40), 128, 40);
  EXPECT_LE(window.begin, 10);
  EXPECT_GT(window.end, 70);
  const CostWindow elsewhere = window_at(windows.row(0), 128, 0);
  EXPECT_EQ((CostWindow{0, 32}), elsewhere);
}

}  // namespace
}  // namespace mtstereo::search_windows_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/engine/border.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mtstereo::test::border_test {
namespace {

using plugin::DisparityUnit;
using plugin::remove_border;
using plugin::without_margin;
using Columns = std::vector<ValidColumns>;

constexpr int kWidth = 41;
constexpr int kHeight = 13;

Columns random_columns(std::mt19937& random) {
  Columns columns;
  for (int y = 0; y < kHeight; ++y) {
    const int a = static_cast<int>(random() % (kWidth + 1));
    const int b = static_cast<int>(random() % (kWidth + 1));
    columns.push_back(random() % 4 == 0 ? ValidColumns{0, kWidth}
                                        : ValidColumns{std::min(a, b), std::max(a, b)});
  }
  return columns;
}

bool contains(const Columns& columns, double x, int y) {
  if (columns.empty()) return true;
  const ValidColumns& row = columns[static_cast<std::size_t>(y)];
  return x >= row.begin && x <= row.end - 1;
}

TEST(Border, DisparitiesOfBorderPixelsAreRemoved) {
  std::mt19937 random(1);
  for (const DisparityUnit& unit :
       {DisparityUnit{256, 64, 0, 0}, DisparityUnit{16, 32, -8, -8}, DisparityUnit{1, 30, 5, 0}}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Columns left = trial % 5 == 0 ? Columns() : random_columns(random);
      const Columns right = trial % 7 == 0 ? Columns() : random_columns(random);
      std::vector<std::uint16_t> map(kWidth * kHeight);
      for (std::uint16_t& value : map) {
        const auto range = static_cast<unsigned>((unit.max_disparity - unit.offset) * unit.scale);
        value = static_cast<std::uint16_t>(random() % 3 == 0 ? 0 : 1 + random() % range);
      }
      std::vector<std::uint16_t> expected = map;
      long removed = 0;
      for (int i = 0; i < kWidth * kHeight; ++i) {
        std::uint16_t& value = expected[static_cast<std::size_t>(i)];
        const double disparity = static_cast<double>(value) / unit.scale + unit.offset;
        const int x = i % kWidth;
        const int y = i / kWidth;
        const bool restricted = !right.empty() && !contains(right, x - disparity, y) &&
                                (right[static_cast<std::size_t>(y)].begin > 0 ||
                                 right[static_cast<std::size_t>(y)].end < kWidth);
        if (value == 0 || (contains(left, x, y) && !restricted)) continue;
        value = 0;
        ++removed;
      }
      EXPECT_EQ(remove_border({map.data(), kWidth, kHeight, kWidth * 2}, left, right, unit),
                removed);
      ASSERT_EQ(map, expected) << trial;
    }
  }
}

TEST(Border, TheMarginIsAroundTheBorderInEveryDirection) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const int margin = trial % 6;
    const Columns columns = random_columns(random);
    const Columns smaller = without_margin(columns, kWidth, margin);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        bool inside = true;
        for (int near = std::max(y - margin, 0); near <= std::min(y + margin, kHeight - 1);
             ++near) {
          for (int at = std::max(x - margin, 0); at <= std::min(x + margin, kWidth - 1); ++at) {
            inside = inside && contains(columns, at, near);
          }
        }
        ASSERT_EQ(contains(smaller, x, y), inside) << x << " " << y << " margin " << margin;
      }
    }
  }
}

TEST(Border, TheEdgeOfTheImageHasNoMargin) {
  const Columns whole(kHeight, ValidColumns{0, kWidth});
  EXPECT_EQ(without_margin(whole, kWidth, 5), whole);
}

}  // namespace
}  // namespace mtstereo::test::border_test

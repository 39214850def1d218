// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/view_shift.hpp"

#include <gtest/gtest.h>

#include "support/compare.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::view_shift_test {
namespace {

TEST(ViewShift, CropsTheLeftViewAtItsStartAndTheRightViewAtItsEnd) {
  const GrayPlane plane = test::noise(23, 7, 1);
  const test::PaddedImage<std::uint8_t> view(plane, 5, 3);
  for (const int least : {1, 9, 22}) {
    const GrayView left = cropped_left(view.view(), least);
    const GrayView right = cropped_right(view.view(), least);
    EXPECT_EQ(left.width, 23 - least);
    EXPECT_EQ(right.width, 23 - least);
    EXPECT_TRUE(test::same_pixels(
        left.width, 7, [&](int x, int y) { return plane(x + least, y); },
        [&](int x, int y) { return left.row(y)[x]; }));
    EXPECT_TRUE(test::same_pixels(
        right.width, 7, [&](int x, int y) { return plane(x, y); },
        [&](int x, int y) { return right.row(y)[x]; }));
  }
}

TEST(ViewShift, ExtendsRowsByTheirFirstAndLastPixels) {
  for (const int width : {1, 2, 23}) {
    const GrayPlane plane = test::noise(width, 7, 1);
    const test::PaddedImage<std::uint8_t> view(plane, 5, 3);
    for (const auto& columns : {std::pair(0, 4), {9, 0}, {3, 2}, {0, 0}}) {
      const int before = columns.first;
      const int after = columns.second;
      Image<std::uint8_t> out;
      out.resize(width + before + after, 7);
      for (const int y0 : {4, 0}) extend_rows(view.view(), before, after, y0, y0 == 0 ? 4 : 7, out);
      EXPECT_TRUE(test::same_pixels(
          out.width(), 7,
          [&](int x, int y) { return plane(std::clamp(x - before, 0, width - 1), y); },
          [&](int x, int y) { return out.row(y)[x]; }));
    }
    EXPECT_TRUE(view.unchanged());
  }
}

}  // namespace
}  // namespace mtstereo::view_shift_test

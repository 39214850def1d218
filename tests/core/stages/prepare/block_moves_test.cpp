// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/block_moves.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reference/prepare/block_moves.hpp"
#include "stages/refine/holding.hpp"
#include "support/compare.hpp"
#include "support/means.hpp"
#include "support/random.hpp"
#include "support/simd_targets.hpp"

namespace mtstereo::block_moves_test {
namespace {

Image<float> disparities_of(const DisparityPlane& map, const MapPlace& place, int width,
                            int height) {
  Image<std::uint16_t> kept;
  kept.resize(map.width, map.height);
  copy_last(image_of(map), 0, map.height, kept);
  Image<float> found;
  found.resize((width + 7) / 8, (height + 7) / 8);
  for (int row = found.height() - 1; row >= 0; --row) {
    find_block_disparities(kept, place, row, row + 1, found);
  }
  return found;
}

BlockMoves moves_of(const CameraMotion& motion, const Image<float>& disparities, int side,
                    int width, int height) {
  BlockMoves moves;
  moves.resize(width, height);
  find_moves(motion, disparities, side, width, height, moves);
  return moves;
}

bool equal(const reference::Offsets& expected, const BlockMoves& moves) {
  for (int row = 0; row < expected.height; ++row) {
    for (int column = 0; column < expected.width; ++column) {
      const std::optional<reference::Offset>& offset = expected(column, row);
      const int x = moves.x.row(row)[column], y = moves.y.row(row)[column];
      if (offset ? offset->x != x || offset->y != y : x != BlockMoves::kUnknown) return false;
    }
  }
  return true;
}

/// A view with means.
reference::PastView past_view(int width, int height, Random& random) {
  reference::PastView past;
  past.mean = test::Plane<int>(width, height);
  for (int& mean : past.mean.pixels) mean = random.below(255 * kMeanOne + 1);
  past.filtered = GrayPlane(width, height);
  past.frames = GrayPlane((width + 7) / 8, (height + 7) / 8);
  for (std::uint8_t& frames : past.frames.pixels) {
    frames = static_cast<std::uint8_t>(random.between(kFramesOne, kMostFrames * kFramesOne));
  }
  return past;
}

Means means_of(const reference::PastView& past) {
  Means means;
  means.resize(past.mean.width, past.mean.height);
  for (int y = 0; y < past.mean.height; ++y) {
    for (int x = 0; x < past.mean.width; ++x) {
      const int steps = past.mean(x, y) + kMeanOne / 2, rest = steps % kMeanOne;
      means.filtered.row(y)[x] = static_cast<std::uint8_t>(steps / kMeanOne);
      std::uint8_t& both = means.rests.row(y / 2)[x];
      both = static_cast<std::uint8_t>(y % 2 == 0 ? rest : both + kMeanOne * rest);
    }
  }
  means.frames = image_of(past.frames);
  return means;
}

TEST(BlockMoves, EqualTheReferenceAtEverySizeOnEveryInstructionSet) {
  test::for_each_simd_target([] {
    Random random(1);
    for (int width = 1; width <= 120; width += random.between(1, 7)) {
      const int height = random.between(1, 60);
      const MapPlace place = {random.between(1, 2), random.between(-9, 9)};
      DisparityPlane map((std::max(width - place.column, 1) + place.scale - 1) / place.scale,
                         (height + place.scale - 1) / place.scale);
      for (int& disparity : map.pixels) {
        disparity = random.below(3) == 0 ? 0 : random.below(30 * kDisparityOne);
      }
      const auto term = [&](float most) { return most * random.between(-100, 100) / 100.0F; };
      const CameraMotion motion = {term(9),    term(9),     term(0.05F), term(0.3F),
                                   term(0.1F), term(2e-3F), term(1e-3F), term(1e-3F)};
      const auto known =
          reference::block_disparities(map, place.scale, place.column, width, height);
      const Image<float> found = disparities_of(map, place, width, height);
      const GrayPlane view = test::noise(width, height, width);
      for (const int side : {0, 1}) {
        const reference::Offsets offsets = reference::offsets(motion, known, side, width, height);
        const BlockMoves moves = moves_of(motion, found, side, width, height);
        ASSERT_TRUE(equal(offsets, moves)) << width << 'x' << height << ", side " << side;

        reference::PastView past = past_view(width, height, random);
        const Means last = means_of(past);
        Means moved;
        moved.resize(width, height);
        for (int y = 0; y < height; y += 8) {
          move_means(view.view(), moves, last, y, std::min(y + 8, height), moved);
        }
        reference::move(view, offsets, past);
        EXPECT_TRUE(same_image(past.mean, test::copy_of_means(moved))) << width << 'x' << height;
        EXPECT_TRUE(same_image(past.filtered, copy_of(moved.filtered))) << width << 'x' << height;
        EXPECT_TRUE(same_image(past.frames, copy_of(moved.frames))) << width << 'x' << height;
      }
    }
  });
}

TEST(BlockMoves, FollowTheMotionByTheDisparityInBothViews) {
  const DisparityPlane map(160, 80, 12 * kDisparityOne);
  const Image<float> disparities = disparities_of(map, {}, 160, 80);
  // The camera moves sideways: the present view is 3 px further left, and 6 px down.
  const CameraMotion motion = {.shift_y = 6, .parallax_x = 0.25F};
  for (const int side : {0, 1}) {
    const BlockMoves moves = moves_of(motion, disparities, side, 160, 80);
    for (int row = 1; row < 9; ++row) {
      for (int column = 1; column < 17; ++column) {
        EXPECT_EQ(3 * kMoveOne, moves.x.row(row)[column]) << side << ": " << column << ", " << row;
        EXPECT_EQ(-6 * kMoveOne, moves.y.row(row)[column]) << side;
      }
    }
  }
}

TEST(BlockMoves, TheNearerOfTwoBlocksDecides) {
  DisparityPlane map(64, 8, 4 * kDisparityOne);
  for (int y = 0; y < 8; ++y) {
    for (int x = 16; x < 24; ++x) map(x, y) = 12 * kDisparityOne;
  }
  // The near block moves by 24 px, onto the place of another one; the others stay.
  const CameraMotion motion = {.shift_x = -12, .parallax_x = -3};
  const BlockMoves moves = moves_of(motion, disparities_of(map, {}, 64, 8), 0, 64, 8);
  EXPECT_EQ(-24 * kMoveOne, moves.x.row(0)[5]);
  EXPECT_EQ(0, moves.x.row(0)[4]);
}

TEST(BlockMoves, AreUnknownWithoutAMapOrWithMotionsWithoutSense) {
  const DisparityPlane none(64, 40), map(64, 40, 5 * kDisparityOne);
  const BlockMoves without = moves_of({}, disparities_of(none, {}, 64, 40), 0, 64, 40);
  EXPECT_EQ(BlockMoves::kUnknown, without.x.row(2)[3]);
  for (const float term : {1e9F, std::numeric_limits<float>::quiet_NaN()}) {
    const BlockMoves moves = moves_of({term, term}, disparities_of(map, {}, 64, 40), 1, 64, 40);
    EXPECT_EQ(BlockMoves::kUnknown, moves.x.row(2)[3]) << term;
  }
}

TEST(BlockMoves, PointsAreThoseOfTheLargerView) {
  MotionPoints points, placed;
  points.resize(40, 40);
  for (int i = 0; i < points.columns * points.rows; ++i) points.points[i] = {10, 4, 7};
  place_points(points, {2, -6}, placed);
  ASSERT_EQ(points.columns, placed.columns);
  ASSERT_EQ(points.rows, placed.rows);
  EXPECT_FLOAT_EQ(14.5F, placed.points[3].x);  // the center of the pixels 14 and 15
  EXPECT_FLOAT_EQ(8.5F, placed.points[3].y);
  EXPECT_FLOAT_EQ(14, placed.points[3].disparity);
}

}  // namespace
}  // namespace mtstereo::block_moves_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "reference/pixels/gray_balance.hpp"
#include "reference/refine/reliability.hpp"
#include "stages/refine/reliability.hpp"
#include "support/compare.hpp"
#include "support/random_maps.hpp"

namespace mtstereo::test {

/// A complete map with a confidence of each pixel, and views of its size.
struct RandomRating {
  static constexpr int kTile = 16;

  RandomRating(int width, int height, std::uint64_t seed)
      : left(width, height),
        right(width, height),
        in{patches(width, height, 0, seed), GrayPlane(width, height)} {
    Random random(seed);
    for (int& disparity : in.map.pixels) disparity = std::max(disparity, 1);
    for (std::uint8_t& value : in.confidence.pixels)
      value = static_cast<std::uint8_t>(random.between(1, 255));
    // Flat on one side, with strong texture on the other.
    const int contrast = random.between(1, 120);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        left(x, y) = static_cast<std::uint8_t>(x < width / 4 ? 90 : random.between(0, contrast));
      }
      for (int x = 0; x < width; ++x) {
        right(x, y) = static_cast<std::uint8_t>(x < width / 4 ? 90 : random.between(0, contrast));
      }
    }
    agreement = GrayPlane((width + kTile - 1) / kTile, (height + kTile - 1) / kTile);
    for (std::uint8_t& share : agreement.pixels) {
      share = static_cast<std::uint8_t>(random.between(0, 31));
    }
    tiles = image_of(agreement);
    const int guide_width = (width + 1) / 2, guide_height = (height + 1) / 2;
    guide = {patches(guide_width, guide_height, 0, seed + 1), GrayPlane(guide_width, guide_height)};
    for (int y = 0; y < guide_height; ++y) {
      for (int x = 0; x < guide_width; ++x) {
        // Often near the pixel's own disparity.
        const int own = in.map.clamped(2 * x, 2 * y) / 2;
        const int near = std::max(own + random.between(-256, 256), 1);
        if (random.below(3) > 0) guide.map(x, y) = near;
        guide.confidence(x, y) = static_cast<std::uint8_t>(random.between(1, 255));
      }
    }
    guide_map = image_of(guide.map);
    guide_confidence = image_of(guide.confidence);
    differ(width, height, random);
  }
  GrayPlane left, right;
  reference::ConfidentMap in;
  GrayPlane agreement{1, 1};  ///< of tiles
  Image<std::uint8_t> tiles;  ///< the same
  GrayBalance balance;
  GrayPlane balanced, mapped;  ///< the views after it
  reference::ConfidentMap guide{DisparityPlane(1, 1), GrayPlane(1, 1)};
  Image<std::int32_t> guide_map;  ///< the same
  Image<std::uint8_t> guide_confidence;
  int clipped_from = kNothingClipped;
  float fine_detail = kUnknownDetail;
  int grid_level = 0;
  int block_side = 8;

  RatedViews views(float noise) const {
    return {left.view(), right.view(), noise,        &tiles,
            kTile,       &balance,     clipped_from, {&guide_map, &guide_confidence},
            fine_detail, grid_level,   block_side};
  }
  reference::RatedPair pair(float noise) const {
    return {balanced,     mapped, left,        noise,      agreement, kTile,
            clipped_from, &guide, fine_detail, grid_level, block_side};
  }

  /// Forgets the balance: equal gray values are alike.
  void unbalance() {
    balance.mapping = {};
    Image<std::int16_t>& around = balance.around;
    for (int y = 0; y < around.height(); ++y) std::fill_n(around.row(y), around.width(), 0);
  }

 private:
  /// A random balance, and the views after it.
  void differ(int width, int height, Random& random) {
    GrayMapping& mapping = balance.mapping;
    mapping.is_identity = random.below(2) == 0;
    for (std::uint8_t& gray : mapping.left_of_right) {
      gray = static_cast<std::uint8_t>(random.below(256));
    }
    mapped = right;
    for (std::uint8_t& gray : mapped.pixels) gray = mapping.of(gray);
    balance.resize((width + 1) / 2, (height + 1) / 2);
    Plane<int> differences(balance.around.width(), balance.around.height());
    for (int y = 0; y < differences.height; ++y) {
      for (int x = 0; x < differences.width; ++x) {
        differences(x, y) = random.between(-20, 20);
        balance.around.row(y)[x] = static_cast<std::int16_t>(differences(x, y));
      }
    }
    balanced = reference::balanced(left, differences, 2 * kTile);
  }
};

}  // namespace mtstereo::test

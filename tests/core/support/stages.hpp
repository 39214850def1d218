// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/nodes/node_matching.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/preprocess.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// Fills all memory of an image including its padding, so that reads of it change results.
template <typename T>
void poison(Image<T>& image) {
  std::fill_n(reinterpret_cast<std::uint8_t*>(image.row(0)),
              image.stride() * image.height() * sizeof(T), std::uint8_t{0xA5});
}

/// Pre-processes a whole view in bands of `band` rows.
inline PreprocessedView preprocess(GrayView image, int gray_levels, int band = 1 << 20) {
  PreprocessedView view;
  view.resize(image.width, image.height);
  view.resize_costs(image.width, image.height);
  poison(view.median);
  poison(view.level);
  for (Image<std::int16_t>* plane : {&view.gray, &view.sobel_x, &view.sobel_y}) poison(*plane);
  MedianScratch median_scratch;
  SobelScratch sobel_scratch;
  for (int y = 0; y < image.height; y += band) {
    median_rows(image, y, std::min(y + band, image.height), median_scratch, view.median);
  }
  for (int y = 0; y < image.height; y += band) {
    level_rows(gray_levels, y, std::min(y + band, image.height), sobel_scratch, view);
    cost_rows(view.median.view(), y, std::min(y + band, image.height), sobel_scratch, view);
  }
  return view;
}

/// Builds the Max-trees of the levels of a whole view in bands of `band` rows.
inline MaxTrees trees_of(const GrayPlane& levels, int band = 1 << 20) {
  MaxTrees trees;
  trees.resize(levels.width, levels.height);
  const Image<std::uint8_t> image = image_of(levels);
  for (int y = 0; y < levels.height; y += band) {
    build_max_trees(image, y, std::min(y + band, levels.height), trees);
  }
  return trees;
}

/// Selects and links the nodes of one level of a whole view in bands of `band` rows.
inline NodeLevel level_of(const MaxTrees& trees, int ancestor, WidthRange widths,
                          int band = 1 << 20) {
  NodeLevel level;
  level.resize(trees.width, trees.height);
  for (int y = 0; y < trees.height; y += band) {
    select_nodes(trees, ancestor, widths, y, std::min(y + band, trees.height), level);
  }
  for (int y = 0; y < trees.height; y += band) {
    link_neighbors(y, std::min(y + band, trees.height), level);
  }
  return level;
}

/// Selects every leaf, whatever its width.
inline constexpr WidthRange kAnyWidth = {0, 1e9};

/// A volume of random costs 0 .. largest, in the formats of the library and of the reference.
struct RandomVolume {
  CostVolume fast;
  reference::Volume plain;
};

inline RandomVolume random_volume(int width, int height, int disparities, int shift, Random& random,
                                  int largest = 24000) {
  RandomVolume volume;
  volume.fast.resize(width, height, disparities, shift);
  std::fill_n(volume.fast.cells.data(), volume.fast.cells.size(), std::uint16_t{0xA5A5});
  volume.plain.shift = shift;
  for (int d = 0; d < disparities; ++d) {
    Plane<int> slice(volume.fast.columns, volume.fast.rows);
    for (int y = 0; y < slice.height; ++y) {
      for (int x = 0; x < slice.width; ++x) {
        slice(x, y) = random.below(largest + 1);
        const std::ptrdiff_t row =
            (static_cast<std::ptrdiff_t>(y) * disparities + d) * volume.fast.stride;
        volume.fast.cells[row + x] = static_cast<std::uint16_t>(slice(x, y));
      }
    }
    volume.plain.slices.push_back(std::move(slice));
  }
  return volume;
}

/// One level of both views of a random pair, in the formats of the library and of the reference.
struct RandomLevels {
  RandomLevels(int width, int height, int ancestor, std::uint64_t seed)
      : RandomLevels(runs(width, height, seed, 5), runs(width, height, seed + 1, 5), ancestor) {}
  RandomLevels(const GrayPlane& left_levels, const GrayPlane& right_levels, int ancestor)
      : left_trees(trees_of(left_levels)),
        right_trees(trees_of(right_levels)),
        left(level_of(left_trees, ancestor, kAnyWidth)),
        right(level_of(right_trees, ancestor, kAnyWidth)),
        plain_left_trees(reference::max_trees(left_levels)),
        plain_right_trees(reference::max_trees(right_levels)),
        plain_left(reference::select_nodes(plain_left_trees, ancestor, 0, 1e9)),
        plain_right(reference::select_nodes(plain_right_trees, ancestor, 0, 1e9)) {}

  MaxTrees left_trees, right_trees;
  NodeLevel left, right;
  reference::Trees plain_left_trees, plain_right_trees;
  reference::Level plain_left, plain_right;

  PairCostInput input(const RandomVolume& volume, float alpha) const {
    return {left_trees, right_trees, left, right, volume.fast, alpha};
  }
  reference::PairInput plain_input(const RandomVolume& volume, float alpha) const {
    return {plain_left_trees, plain_right_trees, plain_left, plain_right, volume.plain, alpha};
  }
};

}  // namespace mtstereo::test

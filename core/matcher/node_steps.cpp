// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/node_steps.hpp"

#include <cstdint>

#include "stages/nodes/disparity_drawing.hpp"

namespace mtstereo {

void Nodes::resize(const Settings& settings, const FrameSize& size) {
  if (settings.by_paths()) return;
  const auto [width, height] = size.matched;
  for (int side = 0; side < 2; ++side) {
    preprocessed[side].resize(width, height);
    preprocessed[side].resize_costs(width, height);
    trees[side].resize(width, height);
  }
  level_count = settings.node_levels.count;
  for (int i = 0; i < level_count; ++i) {
    levels[i].left.resize(width, height);
    levels[i].right.resize(width, height);
    levels[i].intervals.resize(levels[i].left);
    levels[i].matches.resize(levels[i].left);
  }
  ends.resize(leaves().left);
  if (settings.outlier_radius > 0) votes.resize(width, height, settings.outlier_radius);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    worker.median.resize(width);
    worker.sobel.resize(width);
    worker.intervals.resize(width);
    worker.match.resize(width, settings.disparities, settings.max_neighbors);
  }
}

void Costs::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.matched;
  if (settings.by_paths()) return;
  scratch.resize(size.threads);
  const int shift = settings.cost_volume == CostVolumeResolution::kHalf ? 1 : 0;
  if (kernel.empty() || kernel_size != settings.cost_kernel_size || kernel_shift != shift) {
    kernel = smoothing_kernel(settings.cost_kernel_size, shift);
    kernel_size = settings.cost_kernel_size;
    kernel_shift = shift;
  }
  volume.resize(width, height, settings.disparities, shift);
  for (Scratch& worker : scratch) {
    worker.volume.resize(volume, kernel);
    worker.gradient.resize(width);
  }
}

void preprocess(const StepContext& step, const Views& views, Nodes& nodes) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    median_rows(views.matched[side], y0, y1, nodes.scratch[worker].median,
                nodes.preprocessed[side].median);
  });
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    PreprocessedView& view = nodes.preprocessed[side];
    SobelScratch& scratch = nodes.scratch[worker].sobel;
    level_rows(step.settings.gray_levels, y0, y1, scratch, view);
    cost_rows(view.median.view(), y0, y1, scratch, view);
  });
}

void build_trees(const StepContext& step, const Views& views, Nodes& nodes) {
  const Settings& settings = step.settings;
  const WidthRange widths = {1.0 * settings.min_node_width,
                             settings.max_node_width * views.matched[0].width};
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    build_max_trees(nodes.preprocessed[side].level, y0, y1, nodes.trees[side]);
    for (int i = 0; i < nodes.level_count; ++i) {
      NodeLevel& level = side == 0 ? nodes.levels[i].left : nodes.levels[i].right;
      select_nodes(nodes.trees[side], settings.node_levels.level[i], widths, y0, y1, level);
    }
  });
}

void compute_cost_volume(const StepContext& step, const Nodes& nodes, Costs& costs) {
  const int block = slices_per_block(costs.volume, costs.kernel);
  step.bands.blocks(costs.volume.disparities, block, [&](int d0, int d1, int worker) {
    compute_cost_slices(nodes.preprocessed[0], nodes.preprocessed[1], costs.kernel, d0, d1,
                        costs.scratch[worker].volume, costs.volume);
  });
}

namespace {

/// Links the neighbors of level i and finds the search intervals of its left nodes.
void prepare_level(const StepContext& step, int i, Nodes& nodes) {
  NodeLevelMatches& level = nodes.levels[i];
  const Settings& settings = step.settings;
  step.bands.rows([&](int y0, int y1, int worker) {
    link_neighbors(y0, y1, level.left);
    link_neighbors(y0, y1, level.right);
    if (i == 0) {
      first_intervals(level.left, settings.disparities, y0, y1, level.intervals);
    } else {
      const NodeLevelMatches& before = nodes.levels[i - 1];
      finer_intervals(level.left, before.left, before.matches, settings.max_neighbors, y0, y1,
                      nodes.scratch[worker].intervals, level.intervals);
    }
  });
}

void remove_outliers(const StepContext& step, VoteMap& votes, Image<std::int32_t>& map) {
  step.bands.rows([&](int y0, int y1, int) { copy_votes(map, y0, y1, votes); });
  step.bands.columns(votes.integral.width(),
                     [&](int x0, int x1, int) { sum_votes(x0, x1, votes); });
  step.bands.rows([&](int y0, int y1, int) { mtstereo::remove_outliers(votes, y0, y1, map); });
}

}  // namespace

void match_levels(const StepContext& step, const Costs& costs, Nodes& nodes) {
  const Settings& settings = step.settings;
  for (int i = 0; i < nodes.level_count; ++i) {
    prepare_level(step, i, nodes);
    NodeLevelMatches& level = nodes.levels[i];
    const PairCostInput input = {nodes.trees[0], nodes.trees[1], level.left,
                                 level.right,    costs.volume,   settings.intensity_weight};
    // Nodes may concentrate in one part of the view: a row costs as much time as it has possible
    // pairs.
    const auto work = [&](int y) {
      return 1 + std::int64_t{level.left.count[y]} * level.right.count[y];
    };
    step.bands.rows_by_work(work, [&](int y0, int y1, int worker) {
      match_nodes(input, level.intervals, settings.max_neighbors, settings.node_confidence, y0, y1,
                  nodes.scratch[worker].match, level.matches);
      const bool leaves = i + 1 == nodes.level_count;
      if (leaves) take_match_ends(level.left, level.matches, y0, y1, nodes.ends);
    });
  }
}

void draw_leaves(const StepContext& step, const Nodes& nodes, Maps& maps) {
  const NodeLevelMatches& leaves = nodes.leaves();
  step.bands.rows([&](int y0, int y1, int) {
    draw_matches(leaves.left, leaves.matches, y0, y1, maps.disparity);
  });
}

void remove_node_outliers(const StepContext& step, Nodes& nodes, Maps& maps) {
  remove_outliers(step, nodes.votes, maps.disparity);
  step.bands.rows([&](int y0, int y1, int) {
    read_leaf_ends(nodes.leaves().left, maps.disparity, y0, y1, nodes.ends);
  });
}

void extrapolate(const StepContext& step, Nodes& nodes, Maps& maps) {
  const Settings& settings = step.settings;
  step.bands.rows([&](int y0, int y1, int) {
    extrapolate_leaves(nodes.leaves().left, settings.max_neighbors, settings.drawn_end_width(), y0,
                       y1, nodes.ends, maps.disparity);
  });
}

void match_by_gradient(const StepContext& step, Costs& costs, Maps& maps) {
  const PixelMatchingOptions options = {step.settings.search_range, step.settings.selection};
  step.bands.rows([&](int y0, int y1, int worker) {
    match_pixels(costs.volume, options, y0, y1, costs.scratch[worker].gradient, maps.disparity,
                 maps.ratio);
  });
}

void remove_pixel_outliers(const StepContext& step, Nodes& nodes, Maps& maps) {
  remove_outliers(step, nodes.votes, maps.disparity);
}

}  // namespace mtstereo

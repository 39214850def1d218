// SPDX-License-Identifier: LGPL-2.1-or-later
// The steps of the method and their order. To add a step, add a stage with its test to stages/, a
// function here that calls it, and a line to the list at the end.
#include "matcher/steps.hpp"

#include <algorithm>

#include "matcher/path_steps.hpp"
#include "matcher/step_conditions.hpp"
#include "matcher/step_groups.hpp"
#include "matcher/thin_steps.hpp"
#include "stages/nodes/disparity_drawing.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/census_matching.hpp"
#include "stages/pixels/pixel_matching.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/halving.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/noise_filter.hpp"
#include "stages/prepare/noise_level.hpp"
#include "stages/prepare/preprocess.hpp"
#include "stages/prepare/row_alignment.hpp"
#include "stages/prepare/view_blur.hpp"
#include "stages/prepare/view_shift.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/disparity_refinement.hpp"
#include "stages/refine/enlarging.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/map_shift.hpp"
#include "stages/refine/map_smoothing.hpp"
#include "stages/refine/speckle_removal.hpp"

namespace mtstereo {
namespace {

// prepare

void align(const StepContext& step, Views& views) {
  step.input_bands.rows([&](int y0, int y1, int worker) {
    align_rows(views.input[1], step.settings.correction.rows, y0, y1,
               views.scratch[worker].alignment, views.aligned);
  });
  views.replace_input(1, views.aligned.view());
}

void match_sharpness(const StepContext& step, Views& views) {
  const ViewCorrection& correction = step.settings.correction;
  const float blurs[] = {correction.left_blur, correction.right_blur};
  for (int side = 0; side < 2; ++side) {
    if (blurs[side] <= 0) continue;
    const BlurKernel kernel = gaussian_kernel(blurs[side]);
    step.input_bands.rows([&](int y0, int y1, int worker) {
      blur_rows(views.input[side], kernel, y0, y1, views.scratch[worker].blur, views.blurred[side]);
    });
    views.replace_input(side, views.blurred[side].view());
  }
}

/// Makes the smallest disparity that of 0 px of the views to match.
void shift_views(const StepContext& step, Views& views) {
  const int least = step.settings.min_disparity;
  if (least > 0) {
    views.replace_input(0, cropped_left(views.input[0], least));
    views.replace_input(1, cropped_right(views.input[1], least));
    return;
  }
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    extend_rows(views.input[side], side == 0 ? -least : 0, side == 0 ? 0 : -least, y0, y1,
                views.extended[side]);
  });
  for (int side = 0; side < 2; ++side) views.replace_input(side, views.extended[side].view());
}

void halve(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    halve_rows(views.input[side], y0, y1, views.halves[side]);
  });
}

/// Both views are filtered alike, as the noisier one needs it.
void filter_noise(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    measure_blocks(views.matched[side], y0, y1, views.noise[side]);
  });
  const float levels[] = {noise_level(views.noise[0]), noise_level(views.noise[1])};
  views.noise_level = std::max(levels[0], levels[1]);
  const bool lightly = step.settings.by_paths() && !paths_need_filter(views.noise_level);
  if (lightly && step.settings.path_matching(0).column_paths != ColumnPaths::kNone) return;
  const float threshold = std::max(noise_threshold(levels[0]), noise_threshold(levels[1]));
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    NoiseFilterScratch& scratch = views.scratch[worker].noise_filter;
    if (lightly) {
      smooth_lightly(views.matched[side], y0, y1, scratch, views.filtered[side]);
    } else {
      mtstereo::filter_noise(views.matched[side], threshold, y0, y1, scratch, views.filtered[side]);
    }
  });
  for (int side = 0; side < 2; ++side) views.matched[side] = views.filtered[side].view();
}

void preprocess(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    median_rows(views.matched[side], y0, y1, views.scratch[worker].median,
                views.preprocessed[side].median);
  });
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    PreprocessedView& view = views.preprocessed[side];
    SobelScratch& scratch = views.scratch[worker].sobel;
    level_rows(step.settings.gray_levels, y0, y1, scratch, view);
    if (!step.settings.census()) cost_rows(view.median.view(), y0, y1, scratch, view);
  });
}

void build_trees(const StepContext& step, Views& views, Nodes& nodes) {
  const Settings& settings = step.settings;
  const WidthRange widths = {1.0 * settings.min_node_width,
                             settings.max_node_width * views.matched[0].width};
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    build_max_trees(views.preprocessed[side].level, y0, y1, views.trees[side]);
    for (int i = 0; i < nodes.level_count; ++i) {
      NodeLevel& level = side == 0 ? nodes.levels[i].left : nodes.levels[i].right;
      select_nodes(views.trees[side], settings.node_levels.level[i], widths, y0, y1, level);
    }
  });
}

void transform(const StepContext& step, Views& views) {
  step.bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(views.matched[side], step.settings.census_scales, y0, y1,
                views.scratch[worker].census, views.census[side]);
  });
}

void compute_cost_volume(const StepContext& step, const Views& views, Costs& costs) {
  const int block = slices_per_block(costs.volume, costs.kernel);
  step.bands.blocks(costs.volume.disparities, block, [&](int d0, int d1, int worker) {
    compute_cost_slices(views.preprocessed[0], views.preprocessed[1], costs.kernel, d0, d1,
                        costs.scratch[worker].volume, costs.volume);
  });
}

// nodes

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

void match_levels(const StepContext& step, const Views& views, const Costs& costs, Nodes& nodes) {
  const Settings& settings = step.settings;
  for (int i = 0; i < nodes.level_count; ++i) {
    prepare_level(step, i, nodes);
    NodeLevelMatches& level = nodes.levels[i];
    const PairCostInput input = {views.trees[0],
                                 views.trees[1],
                                 level.left,
                                 level.right,
                                 settings.census() ? nullptr : &costs.volume,
                                 &views.census,
                                 settings.intensity_weight};
    // Nodes may concentrate in one part of the view: a row costs as much time as it has possible
    // pairs.
    const auto work = [&](int y) {
      return 1 + std::int64_t{level.left.count[y]} * level.right.count[y];
    };
    step.bands.rows_by_work(work, [&](int y0, int y1, int worker) {
      match_nodes(input, level.intervals, settings.max_neighbors, settings.node_acceptance, y0, y1,
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

void remove_outliers(const StepContext& step, Maps& maps) {
  step.bands.rows([&](int y0, int y1, int) { copy_votes(maps.disparity, y0, y1, maps.votes); });
  step.bands.columns(maps.votes.integral.width(),
                     [&](int x0, int x1, int) { sum_votes(x0, x1, maps.votes); });
  step.bands.rows(
      [&](int y0, int y1, int) { mtstereo::remove_outliers(maps.votes, y0, y1, maps.disparity); });
}

/// Removes outliers from the map of the drawn nodes, then reads the remaining disparities at the
/// nodes' ends.
void remove_node_outliers(const StepContext& step, Nodes& nodes, Maps& maps) {
  remove_outliers(step, maps);
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

// pixels

void match_by_census(const StepContext& step, const Views& views, Costs& costs, Maps& maps) {
  const CensusMatchingOptions options = step.settings.census_matching();
  step.bands.rows_per_thread([&](int y0, int y1, int worker) {
    match_pixels_by_census(views.matched[0], views.census[0], views.census[1], options, y0, y1,
                           costs.scratch[worker].census, maps.disparity, maps.ratio);
  });
}

void match_by_gradient(const StepContext& step, Costs& costs, Maps& maps) {
  const PixelMatchingOptions options = {step.settings.search_range, step.settings.selection};
  step.bands.rows([&](int y0, int y1, int worker) {
    match_pixels(costs.volume, options, y0, y1, costs.scratch[worker].gradient, maps.disparity,
                 maps.ratio);
  });
}

// refine

/// Removes the areas of fewer than `size` px.
void remove_areas(const StepContext& step, int size, Maps& maps) {
  step.bands.rows([&](int y0, int y1, int) {
    find_runs(maps.disparity, kDisparityOne, y0, y1, maps.speckles);
  });
  join_bands(maps.disparity, kDisparityOne, Bands::kRows, maps.speckles);
  step.bands.rows([&](int y0, int y1, int) {
    remove_small(maps.speckles, size, y0, y1, maps.disparity, maps.area);
  });
}

void remove_speckles(const StepContext& step, Maps& maps) {
  remove_areas(step, step.settings.speckle_size, maps);
}

void rate_confidence(const StepContext& step, const Nodes& nodes, Maps& maps) {
  const Settings& settings = step.settings;
  step.bands.rows([&](int y0, int y1, int worker) {
    copy_support(maps.disparity, maps.ratio, y0, y1, maps.support);
    // Pixels that lose their disparity here still support others, but need no confidence.
    if (settings.keeps_only_ends()) {
      keep_leaf_ends(nodes.leaves().left, nodes.ends, settings.node_end_width, y0, y1,
                     maps.scratch[worker].marks, maps.disparity, maps.ratio);
    }
  });
  step.bands.rows([&](int y0, int y1, int worker) {
    rate_support(maps.support, maps.ratio, y0, y1, maps.scratch[worker].support, maps.confidence);
    if (if_speckles(settings)) weigh_confidence(maps.area, y0, y1, maps.confidence);
    if (settings.min_confidence > 0 && !settings.keeps_likely_only()) {
      remove_doubtful(settings.min_confidence, y0, y1, maps.disparity, maps.confidence);
    }
  });
}

/// Only small islands are left of some areas, with the disparities of highest confidence.
void remove_islands(const StepContext& step, Maps& maps) {
  constexpr int kSpeckleParts = 3;  // an island may be this much smaller than a speckle
  remove_areas(step, step.settings.speckle_size / kSpeckleParts, maps);
  step.bands.rows(
      [&](int y0, int y1, int) { clear_unknown(maps.disparity, y0, y1, maps.confidence); });
}

void fill_gaps(const StepContext& step, Maps& maps) {
  const GapFilling gaps = {step.settings.max_gap, kDisparityOne};
  step.bands.rows([&](int y0, int y1, int) {
    fill_gaps_along_rows(gaps, y0, y1, maps.disparity, maps.confidence);
  });
  step.bands.columns(maps.disparity.width(), [&](int x0, int x1, int worker) {
    fill_gaps_along_columns(gaps, x0, x1, maps.scratch[worker].columns, maps.disparity,
                            maps.confidence);
  });
}

void smooth(const StepContext& step, Maps& maps) {
  const int radius = step.settings.smoothing_radius;
  step.bands.rows([&](int y0, int y1, int worker) {
    smooth_along_rows(maps.disparity, radius, y0, y1, maps.scratch[worker].smoothing,
                      maps.smoothed);
  });
  step.bands.rows([&](int y0, int y1, int worker) {
    smooth_along_columns(maps.smoothed, radius, y0, y1, maps.scratch[worker].smoothing,
                         maps.disparity);
  });
}

void enlarge(const StepContext& step, const Maps& maps, EnlargedMaps& enlarged) {
  step.input_bands.rows([&](int y0, int y1, int) {
    enlarge_rows(maps.disparity, step.settings.view_disparities, y0, y1, enlarged.disparity);
    enlarge_confidence(maps.confidence, y0, y1, enlarged.confidence);
  });
}

void transform_input(const StepContext& step, Views& views) {
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(views.input[side], step.settings.census_scales, y0, y1,
                views.scratch[worker].census, views.input_census[side]);
  });
}

void refine(const StepContext& step, const Views& views, EnlargedMaps& enlarged) {
  step.input_bands.rows_per_thread([&](int y0, int y1, int worker) {
    refine_disparities(views.input_census[0], views.input_census[1], enlarged.disparity,
                       step.settings.view_disparities, y0, y1, enlarged.scratch[worker],
                       enlarged.refined);
  });
}

void shift_map(const StepContext& step, const Maps& maps, const EnlargedMaps& enlarged,
               OutputMaps& output) {
  const Settings& settings = step.settings;
  step.input_bands.rows([&](int y0, int y1, int) {
    mtstereo::shift_map(last_disparity(settings, maps, enlarged),
                        last_confidence(settings, maps, enlarged), settings.min_disparity, y0, y1,
                        output.disparity, output.confidence);
  });
}

// clang-format off
constexpr Step kSteps[] = {
    // name                 runs               runs on
    // prepare
    {"row-alignment",       if_aligned,        on<align, Views>},
    {"sharpness",           if_blurred,        on<match_sharpness, Views>},
    {"view-shift",          if_shifted,        on<shift_views, Views>},
    {"halving",             if_half,           on<halve, Views>},
    {"noise-filter",        if_noise_filter,   on<filter_noise, Views>},
    {"preprocessing",       if_nodes,           on<preprocess, Views>},
    {"max-trees",           if_nodes,           on<build_trees, Views, Nodes>},
    {"census",              if_census,         on<transform, Views>},
    {"cost-volume",         if_gradient,       on<compute_cost_volume, const Views, Costs>},
    // nodes
    {"node-matching",       if_nodes,           on<match_levels, const Views, const Costs, Nodes>},
    {"node-drawing",        if_outliers,       on<draw_leaves, const Nodes, Maps>},
    {"node-outliers",       if_outliers,       on<remove_node_outliers, Nodes, Maps>},
    {"node-extrapolation",  if_nodes,           on<extrapolate, Nodes, Maps>},
    // pixels
    {"reduced-matching",    if_paths,          on<match_reduced, Views, Pyramid>},
    {"search-windows",      if_paths,          on<choose_search_windows, Pyramid>},
    {"path-matching",       if_paths,          on<match_by_paths, const Views, Pyramid, Maps>},
    {"guide-support",       if_paths,          on<support_guide, Pyramid, Maps>},
    {"guide-rating",        if_paths,          on<rate_guide, const Views, Pyramid, Completion>},
    {"census-matching",     if_guided_census,  on<match_by_census, const Views, Costs, Maps>},
    {"gradient-matching",   if_gradient,       on<match_by_gradient, Costs, Maps>},
    // refine
    {"pixel-outliers",      if_pixel_outliers, on<remove_outliers, Maps>},
    {"thin-search",         if_thin,           on<find_thin_objects, const Views, Maps>},
    {"speckle-removal",     if_speckles,       on<remove_speckles, Maps>},
    {"confidence",          always,            on<rate_confidence, const Nodes, Maps>},
    {"island-removal",      if_islands,        on<remove_islands, Maps>},
    {"thin-restoring",      if_thin_restoring, on<restore_thin_objects, Maps>},
    {"gap-filling",         if_gaps,           on<fill_gaps, Maps>},
    {"gap-guard",           if_guard,          on<guard_gaps, Maps>},
    {"smoothing",           if_smoothing,      on<smooth, Maps>},
    {"enlarging",           if_half,           on<enlarge, const Maps, EnlargedMaps>},
    {"input-census",        if_refined,        on<transform_input, Views>},
    {"refinement",          if_refined,        on<refine, const Views, EnlargedMaps>},
    {"map-shift",           if_shifted,        on<shift_map, const Maps, const EnlargedMaps, OutputMaps>},
    {"completion",          if_paths,          on<complete_map, Maps, EnlargedMaps, OutputMaps>},
    {"edge-alignment",      if_paths,          on<align_map_edges, const Views, Maps, EnlargedMaps, OutputMaps, Completion>},
    {"reliability",         if_paths,          on<rate_map, const Views, const Pyramid, Maps, EnlargedMaps, OutputMaps, Completion>},
    {"left-strip",          if_left_strip,     on<correct_strip, Maps, EnlargedMaps, OutputMaps>},
    {"rejection",           if_rejection,      on<reject_unlikely, Maps, EnlargedMaps, OutputMaps, Completion>},
    {"gap-closing",         if_closing,        on<close_gaps, Maps, EnlargedMaps, OutputMaps>},
    {"thin-drawing",        if_thin_drawing,   on<draw_thin, Maps, EnlargedMaps, OutputMaps>},
};
// clang-format on

}  // namespace

std::span<const Step> steps() { return kSteps; }

}  // namespace mtstereo

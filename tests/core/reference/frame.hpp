// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "matcher/settings.hpp"
#include "reference/fine_detail.hpp"
#include "reference/nodes/node_extrapolation.hpp"
#include "reference/nodes/outlier_removal.hpp"
#include "reference/pixels/agreement.hpp"
#include "reference/pixels/gray_balance.hpp"
#include "reference/pixels/gray_mapping.hpp"
#include "reference/pixels/path_matching.hpp"
#include "reference/pixels/pixel_matching.hpp"
#include "reference/prepare/block_borders.hpp"
#include "reference/prepare/block_moves.hpp"
#include "reference/prepare/contrast.hpp"
#include "reference/prepare/halving.hpp"
#include "reference/prepare/noise_filter.hpp"
#include "reference/prepare/time_filter.hpp"
#include "reference/refine/completion.hpp"
#include "reference/refine/confidence.hpp"
#include "reference/refine/disparity_refinement.hpp"
#include "reference/refine/edge_alignment.hpp"
#include "reference/refine/enlarging.hpp"
#include "reference/refine/flat_planes.hpp"
#include "reference/refine/gap_filling.hpp"
#include "reference/refine/holding.hpp"
#include "reference/refine/left_strip.hpp"
#include "reference/refine/map_smoothing.hpp"
#include "reference/refine/reliability.hpp"
#include "reference/refine/speckle_removal.hpp"
#include "reference/refine/thin_chains.hpp"
#include "reference/refine/thin_structures.hpp"
#include "stages/prepare/noise_filter.hpp"
#include "stages/refine/clues.hpp"
#include "stages/refine/thin_chains.hpp"

namespace mtstereo::reference {

/// The data that the scalar versions of the steps keep for one frame.
struct Frame {
  Frame(const GrayPlane& left_view, const GrayPlane& right, const Settings& s)
      : settings(s), left(left_view), input{left_view, right}, plain(input), views(input) {}

  const Settings settings;
  GrayPlane left;  ///< as the caller passes it, or averaged
  std::array<GrayPlane, 2> input;
  std::array<GrayPlane, 2> plain;  ///< the matched views with their noise
  std::array<GrayPlane, 2> views;  ///< the matched views
  float input_noise = 0;           ///< of the noisier view, if the views are averaged
  float noise = 0;                 ///< of the noisier view, if the noise filter runs
  float rated_noise = 0;           ///< the same, before the views were averaged
  float detail = 1;                ///< the share of the finest octave, if it is measured
  double borders = 0;              ///< how clearly the left view shows blocks
  int edge = 32;                   ///< the change that halves large steps [1/8 gray value]
  int clipped_from = 256;          ///< the gray values that the camera clipped, if measured
  int grid = 0;                    ///< the level of the block grid
  int block = 8;                   ///< side of its blocks [px]
  std::array<GrayPlane, 2> medians;
  std::array<GrayPlane, 2> levels;
  std::array<Trees, 2> trees;
  Volume volume;
  Level leaves;
  Matches matches;
  DisparityPlane half_map;  ///< of the views at half the matched resolution
  GrayPlane half_ratio;
  ConfidentMap guide;               ///< the same, complete and rated
  DisparityPlane half_map_by_cost;  ///< the same without paths
  Windows windows;                  ///< of the views
  GrayPlane agreement;              ///< of the tiles of the views
  Grays grays;                      ///< what those of the right view are in the left one
  test::Plane<int> balance;         ///< of tiles of 32x32 px
  DisparityPlane nodes;             ///< the drawn leaves; without outliers after their removal
  DisparityPlane map;
  DisparityPlane found;  ///< the map before the filters, negative at thin structures
  GrayPlane ratio;
  GrayPlane area;  ///< weights of the areas
  GrayPlane confidence;
  GrayPlane replaced;                    ///< by the planes of flat areas
  PastViews past;                        ///< with empty views: the pair is the first one
  DisparityPlane last;                   ///< the last map, empty for the first pair
  DisparityPlane kept;                   ///< this map, to be the last one of the next pair
  std::optional<CameraMotion> motion;    ///< to the last pair; the caller finds it
  std::optional<CameraMotion> followed;  ///< from the last pair, by the views; likewise
};

/// Left pixels before the first column, and right ones after the last one, repeat these.
inline void shift_views(Frame& f) {
  const int least = f.settings.min_disparity, width = f.input[0].width;
  for (int side = 0; side < 2; ++side) {
    GrayPlane shifted(width - least, f.input[side].height);
    for (int y = 0; y < shifted.height; ++y) {
      for (int x = 0; x < shifted.width; ++x) {
        const int from = side == 0 ? x + least : x;
        shifted(x, y) = f.input[side](std::clamp(from, 0, width - 1), y);
      }
    }
    f.views[side] = f.plain[side] = f.input[side] = shifted;
  }
}

inline void take(Frame& f, const ConfidentMap& result) {
  f.map = result.map;
  f.confidence = result.confidence;
}

inline void complete(Frame& f) { take(f, complete(ConfidentMap{f.map, f.confidence})); }

inline void shift_map(Frame& f) {
  const int least = f.settings.min_disparity, width = f.map.width + least;
  DisparityPlane map(width, f.map.height);
  GrayPlane confidence(width, f.map.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = std::max(least, 0); x < width; ++x) {
      const int value = f.map(x - least, y);
      const int partner = 256 * (x - least) - value;
      if (value == 0 || partner > 256 * (width - 1)) continue;
      map(x, y) = value + 256 * std::max(least, 0);
      confidence(x, y) = f.confidence(x - least, y);
    }
  }
  f.map = map;
  f.confidence = confidence;
  if (f.settings.keeps_all()) complete(f);
}

inline void halve(Frame& f) {
  for (int side = 0; side < 2; ++side) f.views[side] = f.plain[side] = halve(f.input[side]);
}

/// Moves the means of both views along the motion of the camera.
inline void follow_camera(Frame& f) {
  const int width = f.input[0].width, height = f.input[0].height;
  const auto disparities =
      block_disparities(f.last, f.settings.half() ? 2 : 1, f.settings.min_disparity, width, height);
  for (int side = 0; side < 2; ++side) {
    move(f.input[side], offsets(*f.followed, disparities, side, width, height), f.past.views[side]);
  }
}

inline void filter_in_time(Frame& f) {
  PastViews& past = f.past;
  past.averaged = past.followed = false;
  std::array<float, 2> noise{};
  if (past.views[0].filtered.width > 0) {
    const auto still = [&] {
      std::array<double, 2> share{};
      for (int side = 0; side < 2; ++side) {
        noise[side] = noise_level(f.input[side]);
        share[side] = rate_changes(f.input[side], noise[side], past.views[side]);
      }
      return std::min(share[0], share[1]);
    };
    past.averaged = still() >= 0.85;
    if (!past.averaged && f.followed) {
      follow_camera(f);
      past.averaged = past.followed = still() >= 0.4;
    }
  }
  if (past.averaged) f.input_noise = std::max(noise[0], noise[1]) / (f.settings.half() ? 2 : 1);
  for (int side = 0; side < 2; ++side) {
    average(f.input[side], !past.averaged, past.views[side]);
    f.input[side] = f.plain[side] = f.views[side] = past.views[side].filtered;
  }
  f.left = f.input[0];
}

inline void measure_block_borders(Frame& f) {
  f.block = f.settings.half() ? 4 : 8;
  f.borders = border_visibility(f.plain[0], f.block);
}

inline void measure_contrast(Frame& f) {
  f.edge = std::clamp(gray_range(f.plain[0]) / 3, 4, 32);
  f.clipped_from = clipped_from(f.plain[0]);
}

inline PathMatchingOptions path_options(const Frame& f, int level) {
  PathMatchingOptions options = f.settings.path_matching(level);
  options.smoothness.edge = f.edge;
  return options;
}

inline void filter_noise(Frame& f) {
  const float levels[] = {noise_level(f.views[0]), noise_level(f.views[1])};
  f.noise = std::max(levels[0], levels[1]);
  f.rated_noise = std::max(f.noise, f.input_noise);
  const float blocks = compression_threshold(f.borders);
  float threshold = std::max({noise_threshold(levels[0]), noise_threshold(levels[1]), blocks});
  if (f.settings.by_paths() && blocks == 0 && !paths_need_filter(f.noise)) {
    if (f.settings.mode == Mode::kDense || f.settings.mode == Mode::kFull) return;
    threshold = 0;
  }
  for (GrayPlane& view : f.views) view = filter_noise(view, threshold);
}

inline void preprocess(Frame& f) {
  for (int side = 0; side < 2; ++side) {
    f.medians[side] = median5(f.views[side]);
    f.levels[side] = levels(f.medians[side], f.settings.gray_levels);
  }
}

inline void build_trees(Frame& f) {
  for (int side = 0; side < 2; ++side) f.trees[side] = max_trees(f.levels[side]);
}

inline void compute_costs(Frame& f) {
  f.volume = cost_volume(cost_input(f.medians[0]), cost_input(f.medians[1]), f.settings.disparities,
                         f.settings.cost_kernel_size,
                         f.settings.cost_volume == CostVolumeResolution::kHalf ? 1 : 0);
}

inline void match_levels(Frame& f) {
  const Settings& s = f.settings;
  const int width = f.views[0].width;
  for (int n = 0; n < s.node_levels.count; ++n) {
    const double below = s.max_node_width * width;
    const Level left = select_nodes(f.trees[0], s.node_levels.level[n], s.min_node_width, below);
    const Level right = select_nodes(f.trees[1], s.node_levels.level[n], s.min_node_width, below);
    const Intervals intervals = n == 0
                                    ? first_intervals(left, s.disparities)
                                    : finer_intervals(left, f.leaves, f.matches, s.max_neighbors);
    const PairInput input{f.trees[0], f.trees[1], left, right, f.volume, s.intensity_weight};
    f.matches =
        match_nodes(input, intervals, s.max_neighbors, s.disparities, s.node_confidence, width);
    f.leaves = left;
  }
  f.nodes = draw_matches(f.leaves, f.matches, width);
}

inline void draw_nodes(Frame& f) { f.map = f.nodes; }

inline void remove_node_outliers(Frame& f) {
  f.map = f.nodes = remove_outliers(f.nodes, f.settings.outlier_radius);
}

inline void extrapolate(Frame& f) {
  f.map = extrapolate(f.leaves, f.nodes, f.settings.max_neighbors, f.settings.drawn_end_width());
}

inline void take(Frame& f, const RatedMap& pixels) {
  f.map = pixels.map;
  f.ratio = pixels.ratio;
}

inline void match_by_gradient(Frame& f) {
  take(f, match_pixels(f.volume, {f.settings.search_range, f.settings.selection}, f.map));
}

inline void match_reduced(Frame& f) {
  std::array<std::array<GrayPlane, 2>, 4> views = {f.views};
  for (int i = 1; i < 4; ++i) {
    for (int side = 0; side < 2; ++side) views[i][side] = halve(views[i - 1][side]);
  }
  for (int i = 3; i > 0; --i) {
    const DisparityPlane coarser = f.half_map;
    const PathInput input = {views[i][0], views[i][1], i == 3 ? nullptr : &coarser, {}, 1};
    const RatedMap half = match_along_paths(input, path_options(f, i));
    f.half_map = half.map;
    f.half_ratio = half.ratio;
    if (i == 1) f.half_map_by_cost = match_by_cost(input, path_options(f, i));
  }
}

inline void choose_windows(Frame& f) {
  f.windows = choose_windows(f.half_map, f.half_map_by_cost, f.views[0].width, f.views[0].height,
                             cost_lanes(f.settings.disparities));
  f.agreement =
      share_agreement(f.half_map, f.half_map_by_cost, f.views[0].width, f.views[0].height);
}

inline void balance_grays(Frame& f) {
  const GrayPlane left = halve(f.views[0]), right = halve(f.views[1]);
  f.grays = map_grays(left, right, f.half_map);
  f.balance = balance_of(left, mapped(right, f.grays), f.half_map);
}

inline void match_by_paths(Frame& f) {
  const GrayPlane left = balanced(f.views[0], f.balance, 32), right = mapped(f.views[1], f.grays);
  const PathInput input = {f.views[0], f.views[1], &f.half_map, f.windows, f.settings.census_scales,
                           &left,      &right};
  take(f, match_along_paths(input, path_options(f, 0)));
}

inline void support_guide(Frame& f) {
  f.guide = complete(ConfidentMap{f.half_map, rate_support(f.half_map, f.half_ratio, 2)});
}

inline void rate_guide(Frame& f) {
  std::array<GrayPlane, 2> halves;
  for (int side = 0; side < 2; ++side) halves[side] = halve(f.views[side]);
  const GrayPlane left = balanced(halves[0], f.balance, 16), right = mapped(halves[1], f.grays);
  const RatedPair pair = {left, right, halves[0], f.noise, f.agreement, 8, f.clipped_from};
  const auto table = static_cast<int>(mtstereo::RatedMap::kGuide);
  const auto entries =
      table_of(kReliabilityTables[table], f.noise, mtstereo::kUnknownDetail, 0, true);
  f.guide.confidence = rate_reliability(pair, f.guide, entries, false);
}

inline void remove_pixel_outliers(Frame& f) {
  f.map = remove_outliers(f.map, f.settings.outlier_radius);
}

inline void find_thin(Frame& f) {
  const bool clear = f.noise <= kMostThinNoise;
  f.found = clear ? mark_thin(f.views[0], f.views[1], f.map) : f.map;
}

inline void remove_speckles(Frame& f) {
  const Areas areas = remove_speckles(f.map, 256, f.settings.speckle_size);
  f.map = areas.map;
  f.area = areas.weight;
}

inline void rate_confidence(Frame& f) {
  const Settings& s = f.settings;
  f.confidence = rate_support(f.map, f.ratio, s.by_paths() ? 2 : 1);
  if (s.speckle_size > 1) f.confidence = weighed(f.confidence, f.area);
  const auto keep_where = [&](auto&& keep) {
    for (std::size_t i = 0; i < f.map.pixels.size(); ++i) {
      if (!keep(i)) f.map.pixels[i] = f.confidence.pixels[i] = 0;
    }
  };
  const int least = s.keeps_likely_only() ? 0 : s.min_confidence;
  keep_where([&](std::size_t i) { return f.confidence.pixels[i] >= least; });
}

inline void measure_fine_detail(Frame& f) {
  const FineDetail detail =
      measure_detail(f.plain[0], f.plain[1], ConfidentMap{f.map, f.confidence}, 0);
  if (detail.share()) f.detail = static_cast<float>(*detail.share());
}

inline void measure_block_grid(Frame& f) {
  f.grid = grid_level(f.borders, ConfidentMap{f.map, f.confidence}, f.block);
}

inline void align_edges(Frame& f) {
  take(f, align_edges(f.plain[0], ConfidentMap{f.map, f.confidence}));
}

inline void doubt_edges(Frame& f) {
  f.confidence = align_edges(f.plain[0], ConfidentMap{f.map, f.confidence}).confidence;
}

inline void calibrate_confidence(Frame& f) {
  const ConfidentMap complete = {f.map, f.confidence};
  const GrayPlane left = balanced(f.plain[0], f.balance, 32), right = mapped(f.plain[1], f.grays);
  const RatedPair pair = {left,           right,    f.plain[0], f.rated_noise, f.agreement, 16,
                          f.clipped_from, &f.guide, f.detail,   f.grid,        f.block};
  const bool apart = !f.settings.keeps_inferred();
  const auto table = static_cast<int>(f.settings.rated_map());
  const auto entries =
      table_of(kReliabilityTables[table], f.rated_noise, f.detail, f.grid, f.settings.half());
  f.confidence = rate_reliability(pair, complete, entries, apart);
}

inline void correct_strip(Frame& f) {
  take(f, correct_left_strip(ConfidentMap{f.map, f.confidence}, f.settings.disparities));
}

inline void complete_flat_areas(Frame& f) {
  take(f, complete_flat_areas(f.plain[0], f.rated_noise, ConfidentMap{f.map, f.confidence},
                              f.replaced));
}

inline void align_plane_edges(Frame& f) {
  take(f, align_edges(f.plain[0], ConfidentMap{f.map, f.confidence}, &f.replaced));
}

inline void check_flat_areas(Frame& f) {
  const bool infers = f.settings.infers();
  take(f, check_flat_areas(infers ? f.plain[0] : f.views[0], infers ? 2 : 4, infers ? 1 : 16,
                           f.rated_noise, f.grid, ConfidentMap{f.map, f.confidence}));
}

inline void draw_thin_structures(Frame& f) {
  draw_thin_structures(f.found, std::max(f.settings.min_confidence, 16),
                       f.settings.keeps_likely_only(), f.map, f.confidence);
}

inline void hold_known(Frame& f) {
  if (!f.motion) return;
  const auto [usual, known, fresh] = f.settings.least_confidence(f.noise);
  const float offset = f.settings.min_disparity / (f.settings.half() ? 2.0F : 1.0F);
  const GrayPlane least = least_confidence(f.map, f.last, *f.motion, offset, {usual, known, fresh});
  for (std::size_t i = 0; i < least.pixels.size(); ++i) {
    std::uint8_t& confidence = f.confidence.pixels[i];
    if (confidence >= known && confidence < least.pixels[i]) confidence = 0;
  }
}

inline void reject_unlikely(Frame& f) {
  const bool held = f.settings.holds() && f.motion;
  const int least =
      held ? f.settings.least_confidence(f.noise).known : f.settings.least_reliability();
  for (std::size_t i = 0; i < f.map.pixels.size(); ++i) {
    if (f.confidence.pixels[i] < least) f.map.pixels[i] = f.confidence.pixels[i] = 0;
  }
  f.map = remove_speckles(f.map, 256, f.settings.speckle_size).map;
  for (std::size_t i = 0; i < f.map.pixels.size(); ++i) {
    if (f.map.pixels[i] == 0) f.confidence.pixels[i] = 0;
  }
}

inline void keep_pair(Frame& f) { f.kept = f.map; }

inline void close_gaps(Frame& f) {
  const int max_gap = f.settings.max_gap;
  const ConfidentMap rows = fill_gaps({f.map, f.confidence}, max_gap, 256, 1, 0, 15);
  take(f, fill_gaps(rows, max_gap, 256, 0, 1, 15));
}

inline void smooth(Frame& f) { f.map = smooth(f.map, f.settings.smoothing_radius); }

inline void refine(Frame& f) {
  const int scales = f.settings.census_scales;
  f.map = refine(census(f.input[0], scales), census(f.input[1], scales), f.map,
                 f.settings.view_disparities);
}

inline void enlarge(Frame& f) {
  const int width = f.input[0].width, height = f.input[0].height;
  f.map = enlarge(f.map, width, height, f.settings.view_disparities);
  f.confidence = enlarge_confidence(f.confidence, width, height);
}

inline void align_enlarged(Frame& f) {
  take(f, align_edges(f.input[0], ConfidentMap{f.map, f.confidence}));
}

inline void nothing(Frame&) {}  // the scalar versions of later steps include it

/// The scalar version of each step of the matcher, by the name of the step.
inline constexpr std::pair<std::string_view, void (*)(Frame&)> kScalarSteps[] = {
    {"time-filter", filter_in_time},
    {"view-shift", shift_views},
    {"halving", halve},
    {"block-borders", measure_block_borders},
    {"contrast", measure_contrast},
    {"noise-filter", filter_noise},
    {"preprocessing", preprocess},
    {"max-trees", build_trees},
    {"census", nothing},
    {"cost-volume", compute_costs},
    {"node-matching", match_levels},
    {"node-drawing", draw_nodes},
    {"node-outliers", remove_node_outliers},
    {"node-extrapolation", extrapolate},
    {"reduced-matching", match_reduced},
    {"search-windows", choose_windows},
    {"gray-balance", balance_grays},
    {"path-matching", match_by_paths},
    {"guide-support", support_guide},
    {"guide-rating", rate_guide},
    {"gradient-matching", match_by_gradient},
    {"pixel-outliers", remove_pixel_outliers},
    {"thin-search", find_thin},
    {"speckle-removal", remove_speckles},
    {"confidence", rate_confidence},
    {"smoothing", smooth},
    {"input-census", nothing},
    {"refinement", refine},
    {"enlarging", enlarge},
    {"enlarged-edges", align_enlarged},
    {"map-shift", shift_map},
    {"fine-detail", measure_fine_detail},
    {"block-grid", measure_block_grid},
    {"completion", complete},
    {"edge-check", doubt_edges},
    {"edge-alignment", align_edges},
    {"reliability", calibrate_confidence},
    {"left-strip", correct_strip},
    {"flat-planes", nothing},
    {"plane-check", check_flat_areas},
    {"plane-completion", complete_flat_areas},
    {"plane-edges", align_plane_edges},
    {"holding", hold_known},
    {"rejection", reject_unlikely},
    {"gap-closing", close_gaps},
    {"thin-drawing", draw_thin_structures},
    {"pair-keeping", keep_pair},
};

/// Runs the scalar version of a step. A step without one leaves the frame unchanged: if the step
/// changes a map, the comparison after it fails.
inline void run(std::string_view step, Frame& frame) {
  const auto* found = std::find_if(std::begin(kScalarSteps), std::end(kScalarSteps),
                                   [&](const auto& scalar) { return scalar.first == step; });
  if (found != std::end(kScalarSteps)) found->second(frame);
}

}  // namespace mtstereo::reference

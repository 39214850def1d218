// SPDX-License-Identifier: LGPL-2.1-or-later
// The steps of the method in their order: what a matcher does with one frame.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "matcher_state.hpp"

namespace mtstereo {
namespace {

int thread_count(const Parameters& parameters) {
  const int wanted = parameters.integer(Parameter::kThreads);
  return wanted > 0 ? wanted : std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
}

/// Counts in 32 bits, as wide as the disparities: vectors of both fit.
int known_pixels(const std::int32_t* row, int width) {
  int known = 0;
  for (int x = 0; x < width; ++x) known += row[x] != kNoDisparity;
  return known;
}

}  // namespace

void Matcher::State::take(const Parameters& p) {
  bool resize = false;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.reallocates && parameters.text(info.id) != p.text(info.id)) resize = true;
  }
  const Settings taken(p);  // may throw: before anything has changed
  parameters = p;
  settings = taken;
  if (resize) sized = false;
}

/// After a frame that failed: what is half done is not to be seen.
void Matcher::State::forget_frame() {
  sized = false;
  result = {};
  rated = {};
  for (PreprocessedView& view : views) view.level.resize(0, 0);
  for (Image<std::int32_t>& stage : kept) stage.resize(0, 0);
}

void Matcher::State::size_buffers() {
  sized = false;
  width = settings.half ? half_of(frame_width) : frame_width;
  height = settings.half ? half_of(frame_height) : frame_height;
  const int threads = thread_count(parameters);
  if (!pool || pool->threads() != threads) {
    pool.reset();
    pool.emplace(threads);
  }
  workers.resize(threads);
  for (int side = 0; side < 2; ++side) {
    views[side].resize(width, height);
    if (settings.needs_volume()) views[side].resize_costs(width, height);
    trees[side].resize(width, height);
  }
  for (int i = 0; i < settings.node_levels.count; ++i) {
    levels[i].left.resize(width, height);
    levels[i].right.resize(width, height);
    levels[i].intervals.resize(levels[i].left);
    levels[i].matches.resize(levels[i].left);
  }
  if (settings.needs_volume()) {
    kernel = smoothing_kernel(settings.cost_kernel_size, settings.cost_shift);
    volume.resize(width, height, settings.disparities, settings.cost_shift);
  }
  if (settings.outlier_radius > 0) votes.resize(width, height, settings.outlier_radius);
  ends.resize(leaves().left);
  map.resize(width, height);
  ratio.resize(width, height);
  confidence.resize(width, height);
  support.resize(width, height);
  speckles.resize(width, height);
  rim_marks.resize(width, height);
  smoothed.resize(width, height);
  if (settings.half) {
    for (Image<std::uint8_t>& half : halves) half.resize(width, height);
    enlarged_map.resize(frame_width, frame_height);
    enlarged_confidence.resize(frame_width, frame_height);
  }
  if (settings.refined) {
    for (CensusImage& image : frame_census) image.resize(frame_width, frame_height);
    refined_map.resize(frame_width, frame_height);
  }
  if (settings.needs_census()) {
    for (CensusImage& image : census) image.resize(width, height);
  }
  for (WorkerState& worker : workers) {
    // As large as the stages ask for: which thread gets which band differs from frame to frame, and
    // none is to allocate when its first one, or a higher one, comes late.
    worker.median.resize(width);
    worker.sobel.resize(width);
    worker.marks.resize(width);
    worker.intervals.resize(2 * most_leaves(width));
    if (settings.needs_volume()) worker.cost.resize(volume, kernel);
    worker.match.resize(width, settings.disparities, settings.max_neighbors);
    worker.pixels.resize(width);
    worker.support.resize(width);
    // For any rim, which changes from frame to frame without sizing anything anew.
    worker.rim.resize(width, static_cast<int>(parameter_info(Parameter::kRimTrim).maximum));
    worker.columns.resize(kColumns);
    // For any radius too.
    worker.smoothing.resize(width,
                            static_cast<int>(parameter_info(Parameter::kSmoothingRadius).maximum));
    if (settings.needs_census()) worker.padded.resize(width + 4, std::min(kBand, height) + 4);
    if (settings.census) worker.census.resize(width, census_options());
    if (settings.refined) {
      worker.frame_padded.resize(frame_width + 4, std::min(2 * kBand, frame_height) + 4);
      worker.refinement.resize(frame_width);
    }
  }
  sized = true;
}

void Matcher::State::compute(GrayView left, GrayView right) {
  const auto start = std::chrono::steady_clock::now();
  if (settings.half) {
    halve(left, right);
    match(halves[0].view(), halves[1].view());
    enlarge();
    if (settings.refined) refine(left, right);
  } else {
    match(left, right);
  }
  result = settings.refined ? refined_map.view() : settings.half ? enlarged_map.view() : map.view();
  rated = settings.half ? enlarged_confidence.view() : confidence.view();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  statistics = {took.count(), density()};
}

void Matcher::State::match(GrayView left, GrayView right) {
  preprocess(left, right);
  build_trees();
  if (settings.needs_census()) transform(left, right);
  if (settings.needs_volume()) compute_costs();
  for (int i = 0; i < settings.node_levels.count; ++i) match_level(i);
  draw_nodes();
  keep(Stage::kNodeMatching);
  remove_outliers();
  keep(Stage::kNodesFiltered);
  extrapolate();
  keep(Stage::kExtrapolated);
  match_pixels(left);
  keep(Stage::kPixelMatching);
  if (settings.pixel_outliers) remove_outliers();
  remove_speckles();
  rate_confidence();
  trim_rims();
  keep_node_ends();
  fill_gaps();
  smooth();
  keep(Stage::kFinal);
}

void Matcher::State::halve(GrayView left, GrayView right) {
  for_rows([&](int y0, int y1, WorkerState&) {
    halve_rows(left, y0, y1, halves[0]);
    halve_rows(right, y0, y1, halves[1]);
  });
}

void Matcher::State::preprocess(GrayView left, GrayView right) {
  const std::array<GrayView, 2> images = {left, right};
  for_rows_of_both([&](int side, int y0, int y1, WorkerState& worker) {
    median_rows(images[side], y0, y1, worker.median, views[side].median);
  });
  for_rows_of_both([&](int side, int y0, int y1, WorkerState& worker) {
    level_rows(settings.gray_levels, y0, y1, worker.sobel, views[side]);
    if (!settings.needs_volume()) return;
    const GrayView costs_from = settings.median_in_costs ? views[side].median.view() : images[side];
    cost_rows(costs_from, y0, y1, worker.sobel, views[side]);
  });
}

void Matcher::State::build_trees() {
  const WidthRange widths = {1.0 * settings.min_node_width, settings.max_node_width * width};
  for_rows_of_both([&](int side, int y0, int y1, WorkerState&) {
    build_max_trees(views[side].level, y0, y1, trees[side]);
    for (int i = 0; i < settings.node_levels.count; ++i) {
      NodeLevel& level = side == 0 ? levels[i].left : levels[i].right;
      select_nodes(trees[side], settings.node_levels.level[i], widths, y0, y1, level);
    }
  });
}

void Matcher::State::transform(GrayView left, GrayView right) {
  for_rows([&](int y0, int y1, WorkerState& worker) {
    census_rows(left, y0, y1, worker.padded, census[0]);
    census_rows(right, y0, y1, worker.padded, census[1]);
  });
}

void Matcher::State::compute_costs() {
  const int block = slices_per_block(volume, kernel);
  const int blocks = (volume.disparities + block - 1) / block;
  pool->run(blocks, [&](int i, int worker) {
    const int d0 = i * block;
    const int d1 = std::min(d0 + block, volume.disparities);
    compute_cost_slices(views[0], views[1], kernel, d0, d1, workers[worker].cost, volume);
  });
}

void Matcher::State::match_level(int index) {
  LevelState& level = levels[index];
  for_rows([&](int y0, int y1, WorkerState& worker) {
    link_neighbors(y0, y1, level.left);
    link_neighbors(y0, y1, level.right);
    if (index == 0) {
      first_intervals(level.left, settings.disparities, y0, y1, level.intervals);
    } else {
      finer_intervals(level.left, levels[index - 1].left, levels[index - 1].matches,
                      settings.max_neighbors, y0, y1, worker.intervals, level.intervals);
    }
  });
  const PairCostInput input = {trees[0],
                               trees[1],
                               level.left,
                               level.right,
                               settings.node_census ? nullptr : &volume,
                               &census,
                               settings.intensity_weight};
  // Nodes may be crowded in one part of the view: as many pairs of them as there are is the work.
  const auto work = [&](int y) {
    return 1 + std::int64_t{level.left.count[y]} * level.right.count[y];
  };
  for_rows_of_work(work, [&](int y0, int y1, WorkerState& worker) {
    match_nodes(input, level.intervals, settings.max_neighbors, settings.node_confidence, y0, y1,
                worker.match, level.matches);
    const bool leaf = index + 1 == settings.node_levels.count;
    if (leaf && !nodes_are_drawn()) take_match_ends(level.left, level.matches, y0, y1, ends);
  });
}

/// Whether the map of the matched nodes is needed: else only their ends are.
bool Matcher::State::nodes_are_drawn() const { return keep_stages || settings.outlier_radius > 0; }

void Matcher::State::draw_nodes() {
  if (!nodes_are_drawn()) return;
  for_rows([&](int y0, int y1, WorkerState&) {
    draw_matches(leaves().left, leaves().matches, y0, y1, map);
  });
}

void Matcher::State::remove_outliers() {
  if (settings.outlier_radius == 0) return;
  for_rows([&](int y0, int y1, WorkerState&) { copy_votes(map, y0, y1, votes); });
  for_columns(votes.integral.width(),
              [&](int x0, int x1, WorkerState&) { sum_votes(x0, x1, votes); });
  for_rows([&](int y0, int y1, WorkerState&) { mtstereo::remove_outliers(votes, y0, y1, map); });
}

void Matcher::State::extrapolate() {
  const NodeLevel& level = leaves().left;
  // The census costs are only guided by the nodes: there whole nodes help in every mode.
  const bool whole = settings.census || settings.mode != Mode::kSparse;
  const int end_width = whole ? 0 : settings.node_end_width;
  if (nodes_are_drawn()) {
    for_rows([&](int y0, int y1, WorkerState&) { read_leaf_ends(level, map, y0, y1, ends); });
  }
  for_rows([&](int y0, int y1, WorkerState&) {
    extrapolate_leaves(level, settings.max_neighbors, end_width, y0, y1, ends, map);
  });
}

CensusMatchingOptions Matcher::State::census_options() const {
  return {settings.search_range, settings.census_cost, settings.smoothness, settings.selection};
}

void Matcher::State::match_pixels(GrayView left) {
  if (!settings.census) {
    const PixelMatchingOptions options = {settings.search_range, settings.selection};
    for_rows([&](int y0, int y1, WorkerState& worker) {
      mtstereo::match_pixels(volume, options, y0, y1, worker.pixels, map, ratio);
    });
    return;
  }
  const CensusMatchingOptions options = census_options();
  constexpr bool kPerThread = true;
  for_rows(
      [&](int y0, int y1, WorkerState& worker) {
        match_pixels_by_census(left, census[0], census[1], options, y0, y1, worker.census, map,
                               ratio);
      },
      kPerThread);
}

void Matcher::State::remove_speckles() {
  if (settings.speckle_size <= 1) return;
  for_rows([&](int y0, int y1, WorkerState&) { find_runs(map, kDisparityOne, y0, y1, speckles); });
  join_bands(map, kDisparityOne, kBand, speckles);
  for_rows([&](int y0, int y1, WorkerState&) {
    remove_small(speckles, settings.speckle_size, y0, y1, map);
  });
}

void Matcher::State::rate_confidence() {
  // Pixels that are not kept support others, but need no rating.
  const bool only_ends = keeps_only_ends() && settings.rim_trim == 0;
  for_rows([&](int y0, int y1, WorkerState& worker) {
    copy_support(map, ratio, y0, y1, support);
    if (only_ends) {
      keep_leaf_ends(leaves().left, ends, settings.node_end_width, y0, y1, worker.marks, map,
                     ratio);
    }
  });
  for_rows([&](int y0, int y1, WorkerState& worker) {
    rate_support(support, ratio, y0, y1, worker.support, confidence);
    if (settings.min_confidence > 0) {
      remove_doubtful(settings.min_confidence, y0, y1, map, confidence);
    }
  });
}

void Matcher::State::trim_rims() {
  if (settings.rim_trim == 0) return;
  for_rows([&](int y0, int y1, WorkerState& worker) {
    mark_rim(map, settings.rim_trim, y0, y1, worker.rim, rim_marks);
  });
  for_rows([&](int y0, int y1, WorkerState& worker) {
    trim_rim(rim_marks, settings.rim_trim, y0, y1, worker.rim, map);
    clear_confidence(map, y0, y1, confidence);
  });
}

/// Whether the pixels' disparities are kept at the ends of the finest nodes only.
bool Matcher::State::keeps_only_ends() const {
  return settings.mode == Mode::kSparse && settings.census;
}

void Matcher::State::keep_node_ends() {
  if (!keeps_only_ends() || settings.rim_trim == 0) return;  // done before the rating
  for_rows([&](int y0, int y1, WorkerState& worker) {
    keep_leaf_ends(leaves().left, ends, settings.node_end_width, y0, y1, worker.marks, map,
                   confidence);
  });
}

void Matcher::State::fill_gaps() {
  if (settings.max_gap == 0) return;
  for_rows([&](int y0, int y1, WorkerState&) {
    fill_gaps_along_rows(settings.max_gap, kDisparityOne, y0, y1, map, confidence);
  });
  for_columns(width, [&](int x0, int x1, WorkerState& worker) {
    fill_gaps_along_columns(settings.max_gap, kDisparityOne, x0, x1, worker.columns, map,
                            confidence);
  });
}

void Matcher::State::smooth() {
  const int radius = settings.smoothing_radius;
  if (radius == 0) return;
  for_rows([&](int y0, int y1, WorkerState& worker) {
    smooth_along_rows(map, radius, y0, y1, worker.smoothing, smoothed);
  });
  for_rows([&](int y0, int y1, WorkerState& worker) {
    smooth_along_columns(smoothed, radius, y0, y1, worker.smoothing, map);
  });
}

void Matcher::State::enlarge() {
  for_rows([&](int y0, int y1, WorkerState&) {
    const int end = std::min(2 * y1, frame_height);
    enlarge_rows(map, settings.max_disparity, 2 * y0, end, enlarged_map);
    enlarge_confidence(confidence, 2 * y0, end, enlarged_confidence);
  });
}

void Matcher::State::refine(GrayView left, GrayView right) {
  const auto frame_rows = [&](int y) { return std::min(2 * y, frame_height); };
  for_rows([&](int y0, int y1, WorkerState& worker) {
    census_rows(left, 2 * y0, frame_rows(y1), worker.frame_padded, frame_census[0]);
    census_rows(right, 2 * y0, frame_rows(y1), worker.frame_padded, frame_census[1]);
  });
  constexpr bool kPerThread = true;
  for_rows(
      [&](int y0, int y1, WorkerState& worker) {
        refine_disparities(frame_census[0], frame_census[1], enlarged_map, settings.max_disparity,
                           2 * y0, frame_rows(y1), worker.refinement, refined_map);
      },
      kPerThread);
}

void Matcher::State::keep(Stage stage) {
  Image<std::int32_t>& copy = kept[static_cast<int>(stage)];
  if (!keep_stages) {
    copy.resize(0, 0);  // what is there belongs to an earlier frame
    return;
  }
  copy.resize(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(copy.row(y), map.row(y), width * sizeof(std::int32_t));
  }
}

double Matcher::State::density() {
  std::atomic<std::int64_t> known{0};
  const int bands = (result.height + kBand - 1) / kBand;
  pool->run(bands, [&](int band, int) {
    std::int64_t in_band = 0;
    for (int y = band * kBand; y < std::min((band + 1) * kBand, result.height); ++y) {
      in_band += known_pixels(result.row(y), result.width);
    }
    known += in_band;
  });
  return static_cast<double>(known) / (static_cast<double>(result.width) * result.height);
}

}  // namespace mtstereo

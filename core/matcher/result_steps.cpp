// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/result_steps.hpp"

#include <algorithm>

#include "matcher/fine_detail.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/holding.hpp"
#include "stages/refine/left_strip.hpp"
#include "stages/refine/reliability_table.hpp"
#include "stages/refine/thin_structures.hpp"

namespace mtstereo {

void ResultBuffers::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  if (!settings.by_paths()) return;
  const auto [width, height] = size.matched;
  const ImageSize aligned = settings.keeps_all() ? size.frame : size.matched;
  reused.start_group();  // the alignment of edges, and the planes before it
  edges.resize(aligned.width, aligned.height, &reused);
  if (settings.mode == Mode::kFull) replaced.resize(width, height, &reused);
  rating.resize(width, height, size.threads, reused);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) worker.edges.resize(aligned.width);
  if (!settings.infers() && !settings.checks_planes()) return;
  areas.scale = settings.flat_scale();
  areas.resize(width / areas.scale, height / areas.scale);
  planes.resize(areas.first.size());
  for (Scratch& worker : scratch) worker.votes.resize();
}

void measure_fine_detail(const StepContext& step, const Views& views, ResultMaps& result) {
  const DetailViews compared = {views.plain[0], views.plain[1], result.disparity->view(),
                                result.confidence->view(), 0};
  const std::optional<double> share = measure_detail(step.bands, compared).share();
  if (share) result.fine_detail = static_cast<float>(*share);
}

void LastPair::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  const auto [width, height] = size.matched;
  const bool begins = disparity.width() != width || disparity.height() != height;
  if (begins || !settings.follows()) restart();
  if (!settings.follows()) return;
  reused.start_group();  // find_camera_motion() only
  present.resize(width, height, &reused);
  view.resize(width, height);
  points.resize(width, height);
  disparity.resize(width, height);
}

void measure_block_grid(const StepContext& step, const Views& views, ResultMaps& result) {
  const int side = views.borders.side;
  const BlockGrid grid = step.bands.sum_of_rows(BlockGrid(), [&](int y0, int y1) {
    return measure_grid(result.disparity->view(), result.confidence->view(), side, y0, y1);
  });
  result.grid_level = grid.level(views.borders);
  result.block_side = side;
}

void complete_map(const StepContext& step, ResultMaps& result) { complete_all(step.bands, result); }

namespace {

void find_edges(const Bands& bands, GrayView left_view, const ResultMaps& result,
                const Image<std::uint8_t>* changed, ResultBuffers& buffers) {
  bands.rows([&](int y0, int y1, int) {
    find_jumps(left_view, *result.disparity, changed, y0, y1, buffers.edges);
  });
}

void align_edges_of(const Bands& bands, GrayView left_view, ResultMaps& result,
                    const Image<std::uint8_t>* changed, ResultBuffers& buffers) {
  find_edges(bands, left_view, result, changed, buffers);
  bands.rows([&](int y0, int y1, int worker) {
    align_edges(buffers.edges, y0, y1, buffers.scratch[worker].edges, *result.disparity,
                *result.confidence);
  });
}

}  // namespace

void doubt_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers) {
  find_edges(step.bands, views.plain[0], result, nullptr, buffers);
  step.bands.rows([&](int y0, int y1, int worker) {
    doubt_edges(buffers.edges, y0, y1, buffers.scratch[worker].edges, *result.confidence);
  });
}

void align_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers) {
  align_edges_of(step.bands, views.plain[0], result, nullptr, buffers);
}

void align_plane_edges(const StepContext& step, const Views& views, ResultMaps& result,
                       ResultBuffers& buffers) {
  align_edges_of(step.bands, views.plain[0], result, &buffers.replaced, buffers);
}

void align_enlarged_edges(const StepContext& step, const Views& views, ResultMaps& result,
                          ResultBuffers& buffers) {
  align_edges_of(step.input_bands, views.input[0], result, nullptr, buffers);
}

RatedViews rated_views(const Settings& settings, const Views& views, const Pyramid& pyramid,
                       const ResultMaps& result) {
  return {views.plain[0],     views.plain[1],
          views.rated_noise,  &pyramid.agreement,
          kWindowTile,        &pyramid.balance,
          views.clipped_from, {&pyramid.levels[0].disparity, &pyramid.confidence},
          result.fine_detail, result.grid_level,
          result.block_side,  settings.half()};
}

void calibrate_confidence(const StepContext& step, const Views& views, const Pyramid& pyramid,
                          ResultMaps& result, ResultBuffers& buffers) {
  const Settings& settings = step.settings;
  const TableParts& parts = kReliabilityTables[static_cast<int>(settings.rated_map())];
  const Inferred inferred = settings.keeps_inferred() ? Inferred::kLikeMatched : Inferred::kApart;
  rate(step.bands, rated_views(step.settings, views, pyramid, result), *result.disparity, parts,
       inferred, buffers.rating, *result.confidence);
}

void correct_strip(const StepContext& step, ResultMaps& result) {
  const int strip = step.settings.disparities;
  step.bands.rows([&](int y0, int y1, int) {
    correct_left_strip(strip, y0, y1, *result.disparity, *result.confidence);
  });
}

void fit_flat_areas(const StepContext& step, const Views& views, const Pyramid& pyramid,
                    const ResultMaps& result, ResultBuffers& buffers) {
  FlatAreas& areas = buffers.areas;
  const GrayView view = areas.scale == 2 ? views.plain[0] : pyramid.levels[0].views[0].view();
  areas.count = 0;
  if (areas.gray.width() == 0 || areas.gray.height() == 0) return;
  const Bands bands = step.bands.of_height(areas.gray.height());
  const GrayTotals grays = bands.sum_of_rows(
      GrayTotals(), [&](int y0, int y1) { return sum_grays(view, y0, y1, areas); });
  const int connected = flat_step(grays, areas.scale, views.rated_noise);
  bands.rows([&](int y0, int y1, int) { find_runs(areas.gray, connected, y0, y1, areas.runs); });
  join_bands(areas.gray, connected, Bands::kRows, areas.runs);
  number_areas(areas);
  // One area may take as long as all others.
  bands.blocks(areas.count, 1, [&](int first, int last, int worker) {
    fit_planes(areas, first, last, *result.disparity, *result.confidence,
               buffers.scratch[worker].votes, buffers.planes);
  });
}

void complete_flat_areas(const StepContext& step, ResultMaps& result, ResultBuffers& buffers) {
  step.bands.rows([&](int y0, int y1, int) {
    complete_planes(buffers.areas, buffers.planes, y0, y1, *result.confidence, *result.disparity,
                    buffers.replaced);
  });
}

void check_flat_areas(const StepContext& step, const Views& views, ResultMaps& result,
                      const ResultBuffers& buffers) {
  const PlaneWeight weight = {plane_bonus(views.rated_noise, result.grid_level),
                              step.settings.infers() ? 1 : kMostInferred + 1};
  step.bands.rows([&](int y0, int y1, int) {
    check_planes(buffers.areas, buffers.planes, weight, y0, y1, *result.disparity,
                 *result.confidence);
  });
}

void find_camera_motion(const StepContext& step, const Views& views, const ResultMaps& result,
                        LastPair& last) {
  last.motion.reset();
  build_pyramid(step.bands, views.plain[0], last.present);
  if (last.present.count == 0) return;
  step.bands.blocks(last.points.rows, 1, [&](int row0, int row1, int) {
    choose_points(last.present.levels[0], *result.disparity, *result.confidence,
                  step.settings.matched_offset(), row0, row1, last.points);
  });
  if (last.valid && step.settings.holds()) {
    last.motion = find_motion(last.points, last.present, last.view, result.disparity->width(),
                              result.disparity->height());
  }
  last.view.take(last.present);
}

void hold_known(const StepContext& step, const Views& views, const LastPair& last,
                ResultMaps& result) {
  if (!last.motion) return;
  const LeastConfidence least = step.settings.least_confidence(views.noise_level);
  const float offset = step.settings.matched_offset();
  step.bands.rows([&](int y0, int y1, int) {
    doubt_by_last(least, *last.motion, offset, last.disparity, *result.disparity, y0, y1,
                  *result.confidence);
  });
}

void reject_unlikely(const StepContext& step, const Views& views, const LastPair& last, Maps& maps,
                     ResultMaps& result) {
  const Settings& settings = step.settings;
  const bool held = settings.holds() && last.motion.has_value();
  const int least =
      held ? settings.least_confidence(views.noise_level).known : settings.least_reliability();
  step.bands.rows([&](int y0, int y1, int) {
    threshold_confidence(least, y0, y1, *result.disparity, *result.confidence);
    find_runs(*result.disparity, kDisparityOne, y0, y1, maps.speckles);
  });
  join_bands(*result.disparity, kDisparityOne, Bands::kRows, maps.speckles);
  step.bands.rows([&](int y0, int y1, int) {
    remove_small(maps.speckles, settings.speckle_size, y0, y1, *result.disparity, nullptr);
    clear_unknown(*result.disparity, y0, y1, *result.confidence);
  });
}

void close_gaps(const StepContext& step, ResultMaps& result) {
  const GapFilling gaps = {step.settings.max_gap, kDisparityOne, kMostInferred};
  step.bands.rows([&](int y0, int y1, int) {
    fill_gaps_along_rows(gaps, y0, y1, *result.disparity, *result.confidence);
  });
  step.bands.columns(result.disparity->width(), [&](int x0, int x1, int) {
    fill_gaps_along_columns(gaps, x0, x1, *result.disparity, *result.confidence);
  });
}

void draw_thin_structures(const StepContext& step, const Maps& maps, ResultMaps& result) {
  const Settings& settings = step.settings;
  const int confidence = std::max(settings.min_confidence, kMostInferred + 1);
  step.bands.rows([&](int y0, int y1, int) {
    draw_thin(maps.unfiltered, confidence, y0, y1, *result.disparity, *result.confidence);
    if (!settings.keeps_likely_only()) return;
    remove_covered(maps.unfiltered, y0, y1, *result.disparity, *result.confidence);
  });
}

void keep_pair(const StepContext& step, const ResultMaps& result, LastPair& last) {
  step.bands.rows(
      [&](int y0, int y1, int) { copy_last(*result.disparity, y0, y1, last.disparity); });
  last.valid = true;
}

}  // namespace mtstereo

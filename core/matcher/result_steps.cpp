// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/result_steps.hpp"

#include <algorithm>
#include <atomic>

#include "matcher/fine_detail.hpp"
#include "stages/refine/completion.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/holding.hpp"
#include "stages/refine/left_strip.hpp"
#include "stages/refine/reliability_table.hpp"
#include "stages/refine/thin_structures.hpp"

namespace mtstereo {
namespace {

/// The view must be still in this share of its blocks for the last pair to decide anything. After a
/// cut it is in 0.25 of them or less, even if both scenes have the same sky.
constexpr double kLeastStill = 0.4;

/// Areas that a thread takes at once; most are small.
constexpr int kAreasAtOnce = 8;

static_assert(Bands::kRows % kStillBlock == 0 && kStillBlock == kTimeBlock);

}  // namespace

void ResultBuffers::resize(const Settings& settings, const FrameSize& size) {
  if (!settings.by_paths()) return;
  const auto [width, height] = size.input;
  edges.resize(width, height);
  // With a negative min-disparity, the right view and the guide may be wider than the map.
  rating.resize(width, height, std::max(width, size.frame.width), size.threads);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    worker.edges.resize(width);
    worker.columns.resize(Bands::kColumns);
  }
  if (settings.keeps_likely_only()) islands.resize(width, height);
  if (settings.mode != Mode::kFull) return;
  areas.resize(width, height);
  planes.resize(areas.first.size());
  for (Scratch& worker : scratch) worker.votes.resize();
}

void measure_fine_detail(const StepContext& step, const Views& views, ResultMaps& result) {
  const DetailViews compared = {views.left, views.input[1], result.disparity->view(),
                                result.confidence->view(), result.place.disparity_offset()};
  const std::optional<double> share = measure_detail(step.input_bands, compared).share();
  if (share) result.fine_detail = static_cast<float>(*share);
}

void LastPair::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.input;
  const bool compares = settings.holds() && !settings.filters();
  const bool sized = disparity.width() == width && disparity.height() == height;
  if (settings.holds() && sized && compares == (view.width() > 0)) return;
  restart();
  view.resize(0, 0);
  if (!settings.holds()) return;
  disparity.resize(width, height);
  least.resize(width, height);
  if (!compares) return;
  view.resize(width, height);
  still.resize(still_blocks(width), still_blocks(height));
  noise.resize(width, height);
}

void measure_block_grid(const StepContext& step, const Views& views, ResultMaps& result,
                        ResultBuffers& buffers) {
  const GridViews measured = {views.left, result.disparity->view(), result.confidence->view(),
                              result.place.disparity_offset()};
  for (ResultBuffers::Scratch& worker : buffers.scratch) worker.grid = {};
  step.input_bands.rows([&](int y0, int y1, int worker) {
    buffers.scratch[worker].grid.add(measure_grid(measured, y0, y1));
  });
  BlockGrid grid;
  for (const ResultBuffers::Scratch& worker : buffers.scratch) grid.add(worker.grid);
  result.grid_level = grid.level();
}

void complete_map(const StepContext& step, ResultMaps& result) {
  step.input_bands.rows(
      [&](int y0, int y1, int) { complete_rows(y0, y1, *result.disparity, *result.confidence); });
  complete_empty_rows(*result.disparity, *result.confidence);
}

void align_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers) {
  step.input_bands.rows([&](int y0, int y1, int) {
    find_jumps(views.left, *result.disparity, y0, y1, buffers.edges);
  });
  step.input_bands.rows([&](int y0, int y1, int worker) {
    align_edges(buffers.edges, y0, y1, buffers.scratch[worker].edges, *result.disparity,
                *result.confidence);
  });
}

RatedViews rated_views(const Views& views, const Pyramid& pyramid, const ResultMaps& result) {
  const MapPlace& place = result.place;
  return {views.left,
          views.input[1],
          place.disparity_offset(),
          views.rated_noise,
          &pyramid.agreement,
          kWindowTile * place.scale,
          -place.column,
          {&pyramid.levels[0].disparity, &pyramid.confidence, 2 * place.scale, -place.column,
           place.added},
          result.fine_detail,
          result.grid_level};
}

void calibrate_confidence(const StepContext& step, const Views& views, const Pyramid& pyramid,
                          ResultMaps& result, ResultBuffers& buffers) {
  const Settings& settings = step.settings;
  const ReliabilityTable& table = kReliabilityTables[static_cast<int>(settings.rated_map())];
  const Inferred inferred = settings.keeps_inferred() ? Inferred::kLikeMatched : Inferred::kApart;
  rate(step.input_bands, rated_views(views, pyramid, result), *result.disparity, table, inferred,
       buffers.rating, *result.confidence);
}

void correct_strip(const StepContext& step, ResultMaps& result) {
  const int strip = result.place.column + step.settings.view_disparities;
  step.input_bands.rows([&](int y0, int y1, int) {
    correct_left_strip(strip, y0, y1, *result.disparity, *result.confidence);
  });
}

void complete_flat_areas(const StepContext& step, const Views& views, ResultMaps& result,
                         ResultBuffers& buffers) {
  FlatAreas& areas = buffers.areas;
  if (areas.gray.width() == 0 || areas.gray.height() == 0) return;
  const Bands bands = step.input_bands.of_height(areas.gray.height());
  for (ResultBuffers::Scratch& worker : buffers.scratch) worker.grays = {};
  bands.rows([&](int y0, int y1, int worker) {
    buffers.scratch[worker].grays.add(sum_grays(views.left, y0, y1, areas));
  });
  GrayTotals grays;
  for (const ResultBuffers::Scratch& worker : buffers.scratch) grays.add(worker.grays);
  const int connected = flat_step(grays, views.rated_noise);
  bands.rows([&](int y0, int y1, int) { find_runs(areas.gray, connected, y0, y1, areas.runs); });
  join_bands(areas.gray, connected, Bands::kRows, areas.runs);
  number_areas(areas);
  bands.blocks(areas.count, kAreasAtOnce, [&](int first, int last, int worker) {
    fit_planes(areas, first, last, *result.disparity, *result.confidence,
               buffers.scratch[worker].votes, buffers.planes);
  });
  step.input_bands.rows([&](int y0, int y1, int) {
    complete_planes(areas, buffers.planes, y0, y1, *result.confidence, *result.disparity);
  });
}

void compare_views(const StepContext& step, const Views& views, LastPair& last) {
  const Bands& bands = step.input_bands;
  bands.rows([&](int y0, int y1, int) { measure_blocks(views.left, y0, y1, last.noise); });
  const float noise = noise_level(last.noise);
  std::atomic<int> still{0};
  bands.rows([&](int y0, int y1, int) {
    still += find_still(views.left, last.view, noise, y0, y1, last.still);
  });
  last.share = still / (static_cast<double>(last.still.width()) * last.still.height());
}

void hold_known(const StepContext& step, const Views& views, const PastViews& past,
                const ResultMaps& result, LastPair& last) {
  last.decides = false;
  if (!last.valid) return;
  const bool filters = step.settings.filters();
  if (!filters) compare_views(step, views, last);
  last.decides = filters ? past.averaged : last.share >= kLeastStill;
  if (!last.decides) return;
  const Image<std::uint8_t>& still = filters ? past.views[0].blocks.still : last.still;
  const LeastConfidence least = step.settings.least_confidence();
  step.input_bands.rows([&](int y0, int y1, int) {
    choose_least(least, still, last.disparity, *result.disparity, y0, y1, last.least);
  });
}

void reject_unlikely(const StepContext& step, const LastPair& last, ResultMaps& result,
                     ResultBuffers& buffers) {
  const Settings& settings = step.settings;
  const bool each = settings.holds() && last.decides;
  step.input_bands.rows([&](int y0, int y1, int) {
    if (each) {
      threshold_each(last.least, y0, y1, *result.disparity, *result.confidence);
    } else {
      threshold_confidence(settings.least_reliability(), y0, y1, *result.disparity,
                           *result.confidence);
    }
    find_runs(*result.disparity, kDisparityOne, y0, y1, buffers.islands);
  });
  join_bands(*result.disparity, kDisparityOne, Bands::kRows, buffers.islands);
  step.input_bands.rows([&](int y0, int y1, int) {
    remove_small(buffers.islands, settings.speckle_size, y0, y1, *result.disparity, nullptr);
    clear_unknown(*result.disparity, y0, y1, *result.confidence);
  });
}

void close_gaps(const StepContext& step, ResultMaps& result, ResultBuffers& buffers) {
  const GapFilling gaps = {step.settings.max_gap * result.place.scale, kDisparityOne,
                           kMostInferred};
  step.input_bands.rows([&](int y0, int y1, int) {
    fill_gaps_along_rows(gaps, y0, y1, *result.disparity, *result.confidence);
  });
  step.input_bands.columns(result.disparity->width(), [&](int x0, int x1, int worker) {
    fill_gaps_along_columns(gaps, x0, x1, buffers.scratch[worker].columns, *result.disparity,
                            *result.confidence);
  });
}

void draw_thin_structures(const StepContext& step, const Maps& maps, ResultMaps& result) {
  const Settings& settings = step.settings;
  const int confidence = std::max(settings.min_confidence, kMostInferred + 1);
  step.input_bands.rows([&](int y0, int y1, int) {
    draw_thin(maps.unfiltered, result.place, confidence, y0, y1, *result.disparity,
              *result.confidence);
    if (!settings.keeps_likely_only()) return;
    remove_covered(maps.unfiltered, result.place, y0, y1, *result.disparity, *result.confidence);
  });
}

void keep_pair(const StepContext& step, const Views& views, const ResultMaps& result,
               LastPair& last) {
  const bool compares = !step.settings.filters();
  step.input_bands.rows([&](int y0, int y1, int) {
    for (int y = y0; compares && y < y1; ++y) {
      std::copy_n(views.left.row(y), views.left.width, last.view.row(y));
    }
    copy_last(*result.disparity, y0, y1, last.disparity);
  });
  last.valid = true;
}

}  // namespace mtstereo

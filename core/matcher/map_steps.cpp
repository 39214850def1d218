// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/map_steps.hpp"

#include "stages/refine/completion.hpp"
#include "stages/refine/enlarging.hpp"
#include "stages/refine/map_shift.hpp"

namespace mtstereo {

void Maps::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  const auto [width, height] = size.matched;
  disparity.resize(width, height);
  ratio.resize(width, height);
  confidence.resize(width, height);
  speckles.resize(width, height);
  if (settings.removes_speckles()) area.resize(width, height);
  reused.start_group();  // rate_confidence() only
  support.resize(width, height, &reused);
  if (settings.thin_objects) {
    thin.resize(width, height);
    unfiltered.resize(width, height);
  }
  reused.start_group();  // smooth() only
  if (settings.smoothing_radius > 0) smoothed.resize(width, height, &reused);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    worker.support.resize(width);
    if (settings.thin_objects) {
      worker.thin.resize(width, height);
      worker.columns.resize(height, Bands::kColumns);
    }
    worker.smoothing.resize(width, settings.smoothing_radius);
  }
}

void ResultMaps::start(Maps& maps) {
  disparity = &maps.disparity;
  confidence = &maps.confidence;
  fine_detail = kUnknownDetail;
  grid_level = 0;
  block_side = kBlockSide;
}

void ResultMaps::resize(const Settings& settings, const FrameSize& size) {
  if (settings.shifted()) {
    shifted.resize(size.input.width, size.input.height);
    shifted_confidence.resize(size.input.width, size.input.height);
  }
  const auto [width, height] = size.frame;
  if (settings.half()) {
    enlarged.resize(width, height);
    enlarged_confidence.resize(width, height);
  }
  if (!settings.refined()) return;
  refined.resize(size.matched.width, size.matched.height);
  scratch.resize(size.threads);
  for (RefinementScratch& worker : scratch) worker.resize(size.matched.width);
}

namespace {

/// The parts of the search between and after those that read the lines. `lines` runs a function on
/// all bands of lines.
template <typename ForLines>
void follow_chains(const Views& views, ForLines&& lines, Maps& maps) {
  const ThinViews matched = {views.matched[0], views.matched[1]};
  link_thin_runs(maps.thin);
  lines([&](int line0, int line1, int) { rate_thin_runs(matched, line0, line1, maps.thin); });
  accept_chains(maps.thin);
  lines([&](int line0, int line1, int) {
    mark_thin_pixels(maps.thin, line0, line1, maps.unfiltered);
  });
}

}  // namespace

void find_thin_structures(const StepContext& step, const Views& views, Maps& maps) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  maps.thin.start(Lines::kRows, width, height);
  step.bands.rows([&](int y0, int y1, int worker) {
    copy_map(maps.disparity, y0, y1, maps.unfiltered);
    find_thin_runs(maps.disparity, y0, y0, y1, maps.scratch[worker].thin, maps.thin);
  });
  if (views.noise_level > kMostThinNoise) return;
  follow_chains(
      views, [&](auto&& body) { step.bands.rows(body); }, maps);

  maps.thin.start(Lines::kColumns, width, height);
  step.bands.columns(width, [&](int x0, int x1, int worker) {
    Maps::Scratch& scratch = maps.scratch[worker];
    transpose(maps.disparity, x0, x1, scratch.columns);
    find_thin_runs(scratch.columns, 0, x0, x1, scratch.thin, maps.thin);
  });
  follow_chains(
      views, [&](auto&& body) { step.bands.columns(width, body); }, maps);
}

void remove_areas(const Bands& bands, int size, SpeckleRuns& runs, Image<std::int32_t>& map,
                  Image<std::uint8_t>* area) {
  bands.rows([&](int y0, int y1, int) { find_runs(map, kDisparityOne, y0, y1, runs); });
  join_bands(map, kDisparityOne, Bands::kRows, runs);
  bands.rows([&](int y0, int y1, int) { remove_small(runs, size, y0, y1, map, area); });
}

void remove_speckles(const StepContext& step, Maps& maps) {
  remove_areas(step.bands, step.settings.speckle_size, maps.speckles, maps.disparity, &maps.area);
}

void rate_confidence(const StepContext& step, Maps& maps) {
  step.bands.rows(
      [&](int y0, int y1, int) { copy_support(maps.disparity, maps.ratio, y0, y1, maps.support); });
  threshold_support(step, maps);
}

void threshold_support(const StepContext& step, Maps& maps) {
  const Settings& settings = step.settings;
  step.bands.rows([&](int y0, int y1, int worker) {
    rate_support(maps.support, maps.ratio, settings.by_paths() ? kSupportStep : 1, y0, y1,
                 maps.scratch[worker].support, maps.confidence);
    if (settings.removes_speckles()) weigh_confidence(maps.area, y0, y1, maps.confidence);
    if (settings.min_confidence > 0 && !settings.keeps_likely_only()) {
      threshold_confidence(settings.min_confidence, y0, y1, maps.disparity, maps.confidence);
    }
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

void complete_all(const Bands& bands, ResultMaps& result) {
  bands.rows(
      [&](int y0, int y1, int) { complete_rows(y0, y1, *result.disparity, *result.confidence); });
  complete_empty_rows(*result.disparity, *result.confidence);
}

void refine(const StepContext& step, const Views& views, ResultMaps& result) {
  step.bands.rows_per_thread([&](int y0, int y1, int worker) {
    refine_disparities(views.input_census[0], views.input_census[1], *result.disparity,
                       step.settings.view_disparities, y0, y1, result.scratch[worker],
                       result.refined);
  });
  result.disparity = &result.refined;
}

void enlarge(const StepContext& step, ResultMaps& result) {
  step.input_bands.rows([&](int y0, int y1, int) {
    enlarge_rows(*result.disparity, step.settings.view_disparities, y0, y1, result.enlarged);
    enlarge_confidence(*result.confidence, y0, y1, result.enlarged_confidence);
  });
  result.disparity = &result.enlarged;
  result.confidence = &result.enlarged_confidence;
}

void shift_result(const StepContext& step, ResultMaps& result) {
  const int least = step.settings.min_disparity;
  step.input_bands.rows([&](int y0, int y1, int) {
    shift_map(*result.disparity, *result.confidence, least, y0, y1, result.shifted,
              result.shifted_confidence);
  });
  result.disparity = &result.shifted;
  result.confidence = &result.shifted_confidence;
  if (step.settings.keeps_all()) complete_all(step.input_bands, result);
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/thin_steps.hpp"

#include <algorithm>

#include "stages/refine/thin_chains.hpp"
#include "stages/refine/withheld.hpp"

namespace mtstereo {
namespace {

/// The parts of the search between and after those that read the lines. `lines` runs a function on
/// all bands of lines.
template <typename ForLines>
void follow_chains(const Views& views, ForLines&& lines, Maps& maps) {
  const ThinViews matched = {views.matched[0], views.matched[1]};
  link_thin_runs(maps.thin);
  lines([&](int line0, int line1, int) { rate_thin_runs(matched, line0, line1, maps.thin); });
  accept_chains(maps.thin);
  lines(
      [&](int line0, int line1, int) { mark_thin_pixels(maps.thin, line0, line1, maps.withheld); });
}

}  // namespace

void find_thin_objects(const StepContext& step, const Views& views, Maps& maps) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  maps.thin.start(Lines::kRows, width, height);
  step.bands.rows([&](int y0, int y1, int worker) {
    copy_map(maps.disparity, y0, y1, maps.withheld);
    find_thin_runs(maps.disparity, y0, y1, maps.scratch[worker].thin, maps.thin);
  });
  if (views.noise_level > kMostThinNoise) return;
  follow_chains(
      views, [&](auto&& body) { step.bands.rows(body); }, maps);

  maps.thin.start(Lines::kColumns, width, height);
  step.bands.columns(width, [&](int x0, int x1, int worker) {
    transpose(maps.disparity, x0, x1, maps.columns);
    find_thin_runs(maps.columns, x0, x1, maps.scratch[worker].thin, maps.thin);
  });
  follow_chains(
      views, [&](auto&& body) { step.bands.columns(width, body); }, maps);
}

void restore_thin_objects(const StepContext& step, Maps& maps) {
  step.bands.rows([&](int y0, int y1, int) {
    restore_kept(step.settings.min_confidence, y0, y1, maps.withheld, maps.disparity,
                 maps.confidence);
  });
}

void guard_gaps(const StepContext& step, Maps& maps) {
  step.bands.rows([&](int y0, int y1, int) {
    mark_guarded(maps.disparity, maps.withheld, y0, y1, maps.guarded);
  });
  step.bands.rows([&](int y0, int y1, int) {
    remove_guarded(maps.withheld, maps.guarded, y0, y1, maps.disparity, maps.confidence);
  });
}

void draw_thin(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output) {
  const Settings& settings = step.settings;
  const auto result = callers_maps(settings, maps, enlarged, output);
  const WithheldPlace place = {settings.min_disparity, settings.half() ? 2 : 1,
                               std::max(settings.min_disparity, 0) * kDisparityOne};
  const int confidence = std::max(settings.min_confidence, kMostInferred + 1);
  step.input_bands.rows([&](int y0, int y1, int) {
    draw_thin_objects(maps.withheld, place, confidence, y0, y1, result.disparity,
                      result.confidence);
    if (!settings.keeps_likely_only()) return;
    remove_covered(maps.withheld, place, y0, y1, result.disparity, result.confidence);
  });
}

}  // namespace mtstereo

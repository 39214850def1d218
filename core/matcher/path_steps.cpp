// SPDX-License-Identifier: LGPL-2.1-or-later
// The steps with guide=pyramid, for the list in steps.cpp.
#include "matcher/path_steps.hpp"

#include <algorithm>

#include "stages/pixels/agreement.hpp"
#include "stages/pixels/path_matching.hpp"
#include "stages/pixels/search_windows.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/halving.hpp"
#include "stages/refine/clues.hpp"
#include "stages/refine/completion.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/edge_alignment.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/gray_mapping.hpp"
#include "stages/refine/guide_clue.hpp"
#include "stages/refine/left_strip.hpp"
#include "stages/refine/reliability.hpp"
#include "stages/refine/speckle_removal.hpp"

namespace mtstereo {
namespace {

/// Writes the views of a level and their census transforms.
void reduce(const StepContext& step, const std::array<GrayView, 2>& views,
            std::vector<Views::Scratch>& scratch, PyramidLevel& level) {
  const Bands bands = step.bands.of_height(level.views[0].height());
  bands.rows_of_both_views(
      [&](int side, int y0, int y1, int) { halve_rows(views[side], y0, y1, level.views[side]); });
  bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(level.views[side].view(), 1, y0, y1, scratch[worker].census, level.census[side]);
  });
}

/// Replaces the confidence of a map by its reliability.
void rate(const Bands& bands, const RatedViews& views, const Image<std::int32_t>& map,
          const ReliabilityTable& table, Inferred inferred, ClueMaps& clues, Completion& completion,
          Image<std::uint8_t>& confidence) {
  // Few rows: a part of a millisecond for a view of many megapixels.
  const GrayMapping grays = find_gray_mapping(views, map, confidence);
  bands.rows([&](int y0, int y1, int worker) {
    gather_clues(views, grays, map, confidence, y0, y1, completion.clue_scratch[worker], clues);
  });
  bands.rows([&](int y0, int y1, int worker) {
    rate_reliability(views, map, clues, table, inferred, y0, y1,
                     completion.reliability_scratch[worker], confidence);
  });
}

}  // namespace

void match_reduced(const StepContext& step, Views& views, Pyramid& pyramid) {
  std::array<GrayView, 2> finer = views.matched;
  for (PyramidLevel& level : pyramid.levels) {
    reduce(step, finer, views.scratch, level);
    for (int side = 0; side < 2; ++side) finer[side] = level.views[side].view();
  }
  const Image<std::int32_t>* expected = nullptr;
  const SearchWindows all;
  for (int i = kPyramidLevels - 1; i >= 0; --i) {
    PyramidLevel& level = pyramid.levels[i];
    const PathMatchingOptions options = step.settings.path_matching(i + 1);
    const PathMatchingInput input = {level.views[0].view(), level.census[0], level.census[1],
                                     expected, all};
    WindowVotes* votes = i == 0 ? &pyramid.votes : nullptr;
    step.bands.blocks(level.disparity.height(), path_rows(options.column_paths),
                      [&](int y0, int y1, int worker) {
                        match_along_paths(input, options, y0, y1, pyramid.scratch[worker],
                                          level.disparity, level.ratio, votes);
                      });
    expected = &level.disparity;
  }
}

void choose_search_windows(const StepContext&, Pyramid& pyramid) {
  // A millisecond for a view of many megapixels.
  choose_windows(pyramid.votes, pyramid.windows);
  share_agreement(pyramid.votes, pyramid.agreement);
}

void match_by_paths(const StepContext& step, const Views& views, Pyramid& pyramid, Maps& maps) {
  const PathMatchingOptions options = step.settings.path_matching(0);
  const PathMatchingInput input = {views.matched[0], views.census[0], views.census[1],
                                   &pyramid.levels[0].disparity, pyramid.windows};
  step.bands.blocks(maps.disparity.height(), path_rows(options.column_paths),
                    [&](int y0, int y1, int worker) {
                      match_along_paths(input, options, y0, y1, pyramid.scratch[worker],
                                        maps.disparity, maps.ratio, nullptr);
                    });
}

void support_guide(const StepContext& step, Pyramid& pyramid, Maps& maps) {
  PyramidLevel& level = pyramid.levels[0];
  const Bands bands = step.bands.of_height(level.disparity.height());
  bands.rows([&](int y0, int y1, int) {
    copy_support(level.disparity, level.ratio, y0, y1, pyramid.support);
  });
  bands.rows([&](int y0, int y1, int worker) {
    rate_support(pyramid.support, level.ratio, y0, y1, maps.scratch[worker].support,
                 pyramid.confidence);
    complete_rows(y0, y1, level.disparity, pyramid.confidence);
  });
  complete_empty_rows(level.disparity, pyramid.confidence);
}

RatedViews rated_guide_views(const Views& views, const Pyramid& pyramid) {
  const PyramidLevel& level = pyramid.levels[0];
  return {level.views[0].view(), level.views[1].view(), 0, views.noise_level,
          &pyramid.agreement,    kWindowTile / 2,       0};
}

void rate_guide(const StepContext& step, const Views& views, Pyramid& pyramid,
                Completion& completion) {
  const Image<std::int32_t>& map = pyramid.levels[0].disparity;
  const Bands bands = step.bands.of_height(map.height());
  const RatedViews rated = rated_guide_views(views, pyramid);
  const ReliabilityTable& table = kReliabilityTables[static_cast<int>(RatedMap::kGuide)];
  rate(bands, rated, map, table, Inferred::kLikeMatched, pyramid.clues, completion,
       pyramid.confidence);
}

void complete_map(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output) {
  const auto result = callers_maps(step.settings, maps, enlarged, output);
  step.input_bands.rows(
      [&](int y0, int y1, int) { complete_rows(y0, y1, result.disparity, result.confidence); });
  complete_empty_rows(result.disparity, result.confidence);
}

void align_map_edges(const StepContext& step, const Views& views, Maps& maps,
                     EnlargedMaps& enlarged, OutputMaps& output, Completion& completion) {
  const auto result = callers_maps(step.settings, maps, enlarged, output);
  step.input_bands.rows([&](int y0, int y1, int) {
    find_jumps(views.left, result.disparity, y0, y1, completion.edges);
  });
  step.input_bands.rows([&](int y0, int y1, int worker) {
    align_edges(completion.edges, y0, y1, completion.scratch[worker], result.disparity,
                result.confidence);
  });
}

RatedViews rated_views(const Settings& settings, const Views& views, const Pyramid& pyramid) {
  return {views.left,
          views.input[1],
          std::min(settings.min_disparity, 0),
          views.noise_level,
          &pyramid.agreement,
          settings.half() ? 2 * kWindowTile : kWindowTile,
          -settings.min_disparity,
          {&pyramid.levels[0].disparity, &pyramid.confidence, settings.half() ? 4 : 2,
           -settings.min_disparity, std::max(settings.min_disparity, 0)}};
}

void rate_map(const StepContext& step, const Views& views, const Pyramid& pyramid, Maps& maps,
              EnlargedMaps& enlarged, OutputMaps& output, Completion& completion) {
  const Settings& settings = step.settings;
  const auto result = callers_maps(settings, maps, enlarged, output);
  const RatedViews rated = rated_views(settings, views, pyramid);
  const ReliabilityTable& table = kReliabilityTables[static_cast<int>(settings.rated_map())];
  const Inferred inferred = settings.keeps_inferred() ? Inferred::kLikeMatched : Inferred::kApart;
  rate(step.input_bands, rated, result.disparity, table, inferred, completion.clues, completion,
       result.confidence);
}

void correct_strip(const StepContext& step, Maps& maps, EnlargedMaps& enlarged,
                   OutputMaps& output) {
  const auto result = callers_maps(step.settings, maps, enlarged, output);
  const int strip = step.settings.min_disparity + step.settings.view_disparities;
  step.input_bands.rows([&](int y0, int y1, int) {
    correct_left_strip(strip, y0, y1, result.disparity, result.confidence);
  });
}

void reject_unlikely(const StepContext& step, Maps& maps, EnlargedMaps& enlarged,
                     OutputMaps& output, Completion& completion) {
  const Settings& settings = step.settings;
  const auto result = callers_maps(settings, maps, enlarged, output);
  step.input_bands.rows([&](int y0, int y1, int) {
    remove_doubtful(settings.least_reliability(), y0, y1, result.disparity, result.confidence);
    find_runs(result.disparity, kDisparityOne, y0, y1, completion.islands);
  });
  join_bands(result.disparity, kDisparityOne, Bands::kRows, completion.islands);
  step.input_bands.rows([&](int y0, int y1, int) {
    remove_small(completion.islands, settings.speckle_size, y0, y1, result.disparity,
                 completion.weight);
    clear_unknown(result.disparity, y0, y1, result.confidence);
  });
}

/// What it fills is inferred, not matched.
void close_gaps(const StepContext& step, Maps& maps, EnlargedMaps& enlarged, OutputMaps& output) {
  const Settings& settings = step.settings;
  const auto result = callers_maps(settings, maps, enlarged, output);
  const GapFilling gaps = {settings.max_gap * (settings.half() ? 2 : 1), kDisparityOne,
                           kMostInferred};
  step.input_bands.rows([&](int y0, int y1, int) {
    fill_gaps_along_rows(gaps, y0, y1, result.disparity, result.confidence);
  });
  step.input_bands.columns(result.disparity.width(), [&](int x0, int x1, int worker) {
    fill_gaps_along_columns(gaps, x0, x1, maps.scratch[worker].columns, result.disparity,
                            result.confidence);
  });
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/path_steps.hpp"

#include "stages/pixels/agreement.hpp"
#include "stages/prepare/halving.hpp"
#include "stages/refine/completion.hpp"
#include "stages/refine/reliability_table.hpp"

namespace mtstereo {
namespace {

/// Matches views in chunks of rows.
void match(const Bands& bands, const PathMatchingInput& input, const PathMatchingOptions& options,
           std::vector<Pyramid::Scratch>& scratch, Image<std::int32_t>& map,
           Image<std::uint8_t>& ratio, WindowVotes* votes) {
  const int rows = path_rows(options, map.height(), bands.threads());
  bands.blocks(map.height(), rows, [&](int y0, int y1, int worker) {
    match_along_paths(input, options, y0, y1, scratch[worker].matching, map, ratio, votes);
  });
}

/// Writes the views of a level and their census transforms.
void reduce(const StepContext& step, const std::array<GrayView, 2>& views,
            std::vector<Pyramid::Scratch>& scratch, PyramidLevel& level) {
  const Bands bands = step.bands.of_height(level.views[0].height());
  bands.rows_of_both_views(
      [&](int side, int y0, int y1, int) { halve_rows(views[side], y0, y1, level.views[side]); });
  bands.rows_of_both_views([&](int side, int y0, int y1, int worker) {
    census_rows(level.views[side].view(), 1, 1, y0, y1, scratch[worker].census, level.census[side]);
  });
}

}  // namespace

void Pyramid::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  if (!settings.by_paths()) return;
  scratch.resize(size.threads);
  ImageSize reduced = size.matched;
  votes.resize(reduced.width, reduced.height, cost_lanes(settings.disparities));
  windows.resize(reduced.width, reduced.height, cost_lanes(settings.disparities));
  agreement.resize(votes.columns, votes.rows);
  const ImageSize half = {half_of(reduced.width), half_of(reduced.height)};
  balance.resize(half.width, half.height);
  reused.start_group();  // support_guide() only
  support.resize(half.width, half.height, &reused);
  confidence.resize(half.width, half.height);
  rating.resize(half.width, half.height, size.threads, reused);
  const auto prepare_scratch = [&](int level) {
    for (Scratch& worker : scratch) {
      worker.matching.resize(reduced.width, reduced.height, settings.path_matching(level));
    }
  };
  for (Scratch& worker : scratch) {
    worker.census.resize(half.width, half.band_rows());
    worker.support.resize(half.width);
  }
  prepare_scratch(0);
  reused.start_group();  // match_reduced() only
  for (int i = 0; i < kPyramidLevels; ++i) {
    PyramidLevel& level = levels[i];
    reduced = {half_of(reduced.width), half_of(reduced.height)};
    prepare_scratch(i + 1);
    for (int side = 0; side < 2; ++side) {
      level.views[side].resize(reduced.width, reduced.height);
      level.census[side].resize(reduced.width, reduced.height, &reused);
    }
    level.disparity.resize(reduced.width, reduced.height);
    level.ratio.resize(reduced.width, reduced.height);
  }
}

void match_reduced(const StepContext& step, const Views& views, Pyramid& pyramid) {
  std::array<GrayView, 2> finer = views.matched;
  for (PyramidLevel& level : pyramid.levels) {
    reduce(step, finer, pyramid.scratch, level);
    for (int side = 0; side < 2; ++side) finer[side] = level.views[side].view();
  }
  const Image<std::int32_t>* expected = nullptr;
  const SearchWindows all;
  for (int i = kPyramidLevels - 1; i >= 0; --i) {
    PyramidLevel& level = pyramid.levels[i];
    PathMatchingOptions options = step.settings.path_matching(i + 1);
    options.smoothness.edge = views.edge;
    const PathMatchingInput input = {
        level.views[0].view(), {level.census[0], level.census[1]}, expected, all};
    WindowVotes* votes = i == 0 ? &pyramid.votes : nullptr;
    match(step.bands, input, options, pyramid.scratch, level.disparity, level.ratio, votes);
    expected = &level.disparity;
  }
}

void choose_search_windows(const StepContext&, Pyramid& pyramid) {
  // A millisecond for a view of many megapixels.
  choose_windows(pyramid.votes, pyramid.windows);
  share_agreement(pyramid.votes, pyramid.agreement);
}

void balance_grays(const StepContext& step, Pyramid& pyramid) {
  const PyramidLevel& level = pyramid.levels[0];
  GrayBalance& balance = pyramid.balance;
  // Few rows: a part of a millisecond for a view of many megapixels.
  balance.mapping =
      find_gray_mapping(level.views[0].view(), level.views[1].view(), level.disparity);
  const int rows = balance.own.height();
  step.bands.blocks(rows, 1, [&](int row0, int row1, int) {
    measure_differences(level.views[0].view(), level.views[1].view(), level.disparity, row0, row1,
                        balance);
  });
  const std::int16_t common = common_difference(balance);
  step.bands.blocks(rows, 1,
                    [&](int row0, int row1, int) { balance_tiles(common, row0, row1, balance); });
}

void match_by_paths(const StepContext& step, const Views& views, Pyramid& pyramid, Maps& maps) {
  PathMatchingOptions options = step.settings.path_matching(0);
  options.smoothness.edge = views.edge;
  const GrayPair gray = {views.matched[0], views.matched[1], pyramid.balance};
  const PathMatchingInput input = {views.matched[0],
                                   {views.census[0], views.census[1], &gray},
                                   &pyramid.levels[0].disparity,
                                   pyramid.windows};
  match(step.bands, input, options, pyramid.scratch, maps.disparity, maps.ratio, nullptr);
}

void support_guide(const StepContext& step, Pyramid& pyramid) {
  PyramidLevel& level = pyramid.levels[0];
  const Bands bands = step.bands.of_height(level.disparity.height());
  bands.rows([&](int y0, int y1, int) {
    copy_support(level.disparity, level.ratio, y0, y1, pyramid.support);
  });
  bands.rows([&](int y0, int y1, int worker) {
    rate_support(pyramid.support, level.ratio, kSupportStep, y0, y1,
                 pyramid.scratch[worker].support, pyramid.confidence);
    complete_rows(y0, y1, level.disparity, pyramid.confidence);
  });
  complete_empty_rows(level.disparity, pyramid.confidence);
}

RatedViews rated_guide_views(const Views& views, const Pyramid& pyramid) {
  const PyramidLevel& level = pyramid.levels[0];
  return {level.views[0].view(), level.views[1].view(), views.noise_level, &pyramid.agreement,
          kWindowTile / 2,       &pyramid.balance,      views.clipped_from};
}

void rate_guide(const StepContext& step, const Views& views, Pyramid& pyramid) {
  const Image<std::int32_t>& map = pyramid.levels[0].disparity;
  const TableParts& parts = kReliabilityTables[static_cast<int>(RatedMap::kGuide)];
  rate(step.bands.of_height(map.height()), rated_guide_views(views, pyramid), map, parts,
       Inferred::kLikeMatched, pyramid.rating, pyramid.confidence);
}

}  // namespace mtstereo

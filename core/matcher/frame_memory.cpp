// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_memory.hpp"

#include <algorithm>

#include "base/bands.hpp"
#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

/// Rows of a full band, or of the image if it has fewer.
int band_rows(const ImageSize& size) { return std::min(Bands::kRows, size.height); }

}  // namespace

void Views::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.matched;
  if (settings.aligned()) aligned.resize(size.input.width, size.input.height);
  const float blurs[] = {settings.correction.left_blur, settings.correction.right_blur};
  for (int side = 0; side < 2; ++side) {
    if (blurs[side] > 0) blurred[side].resize(size.input.width, size.input.height);
    if (settings.min_disparity < 0) extended[side].resize(size.frame.width, size.frame.height);
    if (settings.half()) halves[side].resize(width, height);
    if (settings.noise_filter) {
      noise[side].resize(width, height);
      filtered[side].resize(width, height);
    }
    if (!settings.by_paths()) {
      preprocessed[side].resize(width, height);
      trees[side].resize(width, height);
    }
    if (!settings.census()) preprocessed[side].resize_costs(width, height);
    if (settings.census()) census[side].resize(width, height);
    if (settings.refined()) input_census[side].resize(size.frame.width, size.frame.height);
  }
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    if (settings.aligned()) worker.alignment.resize(size.input.width);
    if (settings.blurred()) worker.blur.resize(size.input.width);
    if (settings.noise_filter) worker.noise_filter.resize(width, band_rows(size.matched));
    worker.median.resize(width);
    worker.sobel.resize(width);
    const ImageSize& largest = settings.refined() ? size.frame : size.matched;
    worker.census.resize(largest.width, band_rows(largest));
  }
}

void Nodes::resize(const Settings& settings, const FrameSize& size) {
  if (settings.by_paths()) return;
  const auto [width, height] = size.matched;
  level_count = settings.node_levels.count;
  for (int i = 0; i < level_count; ++i) {
    levels[i].left.resize(width, height);
    levels[i].right.resize(width, height);
    levels[i].intervals.resize(levels[i].left);
    levels[i].matches.resize(levels[i].left);
  }
  ends.resize(leaves().left);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    worker.intervals.resize(width);
    worker.match.resize(width, settings.disparities, settings.max_neighbors);
  }
}

void Costs::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.matched;
  if (settings.by_paths()) return;
  scratch.resize(size.threads);
  if (settings.census()) {
    for (Scratch& worker : scratch) worker.census.resize(width, settings.census_matching());
    return;
  }
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

void Pyramid::resize(const Settings& settings, const FrameSize& size) {
  if (!settings.by_paths()) return;
  scratch.resize(size.threads);
  ImageSize reduced = size.matched;
  votes.resize(reduced.width, reduced.height, cost_lanes(settings.disparities));
  windows.resize(reduced.width, reduced.height);
  agreement.resize(votes.columns, votes.rows);
  const ImageSize half = {half_of(reduced.width), half_of(reduced.height)};
  support.resize(half.width, half.height);
  confidence.resize(half.width, half.height);
  clues.resize(half.width, half.height);
  const auto prepare_scratch = [&](int level) {
    for (PathMatchingScratch& worker : scratch) {
      worker.resize(reduced.width, reduced.height, settings.path_matching(level));
    }
  };
  prepare_scratch(0);
  for (int i = 0; i < kPyramidLevels; ++i) {
    PyramidLevel& level = levels[i];
    reduced = {half_of(reduced.width), half_of(reduced.height)};
    prepare_scratch(i + 1);
    for (int side = 0; side < 2; ++side) {
      level.views[side].resize(reduced.width, reduced.height);
      level.census[side].resize(reduced.width, reduced.height);
    }
    level.disparity.resize(reduced.width, reduced.height);
    level.ratio.resize(reduced.width, reduced.height);
  }
}

void Maps::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.matched;
  disparity.resize(width, height);
  ratio.resize(width, height);
  confidence.resize(width, height);
  if (settings.outlier_radius > 0) votes.resize(width, height, settings.outlier_radius);
  speckles.resize(width, height);
  if (settings.speckle_size > 1) area.resize(width, height);
  support.resize(width, height);
  if (settings.thin_objects) {
    thin.resize(width, height);
    columns.resize(height, width);
    withheld.resize(width, height);
    if (!settings.by_paths() && settings.max_gap > 0) guarded.resize(width, height);
  }
  if (settings.smoothing_radius > 0) smoothed.resize(width, height);
  scratch.resize(size.threads);
  for (Scratch& worker : scratch) {
    worker.marks.resize(width);
    worker.support.resize(width);
    worker.columns.resize(Bands::kColumns);
    if (settings.thin_objects) worker.thin.resize(width, height);
    worker.smoothing.resize(width, settings.smoothing_radius);
  }
}

void EnlargedMaps::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.frame;
  if (settings.half()) {
    disparity.resize(width, height);
    confidence.resize(width, height);
  }
  if (!settings.refined()) return;
  refined.resize(width, height);
  scratch.resize(size.threads);
  for (RefinementScratch& worker : scratch) worker.resize(width);
}

void OutputMaps::resize(const Settings& settings, const FrameSize& size) {
  if (!settings.shifted()) return;
  disparity.resize(size.input.width, size.input.height);
  confidence.resize(size.input.width, size.input.height);
}

void Completion::resize(const Settings& settings, const FrameSize& size) {
  if (!settings.by_paths()) return;
  edges.resize(size.input.width, size.input.height);
  scratch.resize(size.threads);
  for (EdgeScratch& worker : scratch) worker.resize(size.input.width);
  clues.resize(size.input.width, size.input.height);
  // With a negative min-disparity, the right view and the guide may be wider than the map.
  const int widest = std::max(size.input.width, size.frame.width);
  reliability_scratch.resize(size.threads);
  for (ReliabilityScratch& worker : reliability_scratch) worker.resize(widest);
  clue_scratch.resize(size.threads);
  for (ClueScratch& worker : clue_scratch) worker.resize(widest);
  if (!settings.keeps_likely_only()) return;
  islands.resize(size.input.width, size.input.height);
  weight.resize(size.input.width, size.input.height);
}

void FrameMemory::resize(const Settings& settings, const FrameSize& size) {
  views.resize(settings, size);
  nodes.resize(settings, size);
  costs.resize(settings, size);
  pyramid.resize(settings, size);
  maps.resize(settings, size);
  enlarged.resize(settings, size);
  output.resize(settings, size);
  completion.resize(settings, size);
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/time_steps.hpp"

#include <algorithm>

#include "stages/prepare/halving.hpp"

namespace mtstereo {
namespace {

/// Both views must be still in this share of their blocks to be averaged where they are. A slow
/// camera has less: its views must follow the motion.
constexpr double kLeastSteady = 0.85;

/// The same for views that follow the motion of the camera: if fewer blocks fit, the motion is
/// wrong.
constexpr double kLeastFollowing = 0.4;

/// With less noise, what the interpolation of moved means takes outweighs what the mean brings.
constexpr float kLeastFollowedNoise = 2;

static_assert(Bands::kRows % kTimeBlock == 0);

/// Compares the views with their means. Returns the least share of blocks that are still.
double compare(const StepContext& step, const Views& views, PastViews& past) {
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    measure_changes(views.input[side], past.last_means(side).filtered, y0, y1,
                    past.views[side].blocks);
  });
  double still = 1;
  for (int side = 0; side < 2; ++side) {
    PastViews::View& view = past.views[side];
    const Image<std::uint8_t>& frames = past.last_means(side).frames;
    still = std::min(still, rate_changes(noise_level(view.noise), frames, view.blocks));
  }
  return still;
}

/// Moves the means along the motion of the camera, if it can be found.
bool follow_camera(const StepContext& step, const LastPair& last, const Views& views,
                   PastViews& past) {
  if (!last.valid || past.present.count == 0) return false;
  const auto [left, width, height, stride] = views.input[0];
  const MapPlace place = {step.settings.half() ? 2 : 1, step.settings.min_disparity};
  place_points(last.points, place, past.points);
  past.motion = find_motion(past.points, past.last, past.present, width, height);
  if (!past.motion) return false;
  step.input_bands.of_height(past.disparities.height()).rows([&](int row0, int row1, int) {
    find_block_disparities(last.disparity, place, row0, row1, past.disparities);
  });
  for (int side = 0; side < 2; ++side) {
    PastViews::View& view = past.views[side];
    find_moves(*past.motion, past.disparities, side, width, height, view.moves);
    step.input_bands.rows([&](int y0, int y1, int) {
      move_means(views.input[side], view.moves, past.means[side], y0, y1, view.moved);
    });
  }
  return true;
}

/// Whether the views may be averaged: as they are, or along the motion of the camera.
bool may_average(const StepContext& step, const LastPair& last, const Views& views,
                 PastViews& past) {
  if (!past.valid) return false;
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    measure_blocks(views.input[side], y0, y1, past.views[side].noise);
  });
  if (compare(step, views, past) >= kLeastSteady) return true;
  float noise = 0;
  for (PastViews::View& view : past.views) noise = std::max(noise, noise_level(view.noise));
  return noise >= kLeastFollowedNoise && follow_camera(step, last, views, past) &&
         compare(step, views, past) >= kLeastFollowing;
}

}  // namespace

void PastViews::resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused) {
  const auto [width, height] = size.input;
  const Image<std::uint8_t>& left = means[0].filtered;
  const bool begins = left.width() != width || left.height() != height;
  if (begins || !settings.filters()) restart();
  if (!settings.filters()) return;
  reused.start_group();  // filter_in_time() only
  for (int side = 0; side < 2; ++side) {
    View& view = views[side];
    view.blocks.resize(width, height, &reused);
    view.noise.resize(width, height);
    view.moves.resize(width, height, &reused);
    view.moved.resize(width, height, &reused);
    means[side].resize(width, height);
    if (begins) means[side].clear();
  }
  last.resize(width, height);
  present.resize(width, height, &reused);
  // For maps of both resolutions.
  points.resize(half_of(size.frame.width), half_of(size.frame.height));
  points.resize(size.frame.width, size.frame.height);
  disparities.resize(time_blocks(width), time_blocks(height), &reused);
}

void filter_in_time(const StepContext& step, const LastPair& last, Views& views, PastViews& past) {
  const bool follows = step.settings.follows();
  past.motion.reset();
  if (follows) build_pyramid(step.input_bands, views.input[0], past.present);
  past.averaged = may_average(step, last, views, past);
  for (int side = 0; side < 2; ++side) {
    PastViews::View& view = past.views[side];
    count_frames(!past.averaged, past.last_means(side).frames, view.blocks,
                 past.means[side].frames);
    // Halved views have half of their noise.
    const float noise = past.averaged ? noise_level(view.noise) : 0;
    views.input_noise = std::max(views.input_noise, step.settings.half() ? noise / 2 : noise);
  }
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    average_rows(views.input[side], y0, y1, past.views[side].blocks, past.last_means(side),
                 past.means[side]);
  });
  for (int side = 0; side < 2; ++side) views.replace_input(side, past.means[side].filtered.view());
  views.left = views.input[0];
  if (follows) past.last.take(past.present);
  past.valid = true;
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/time_steps.hpp"

#include <algorithm>
#include <utility>

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
    PastViews::View& view = past.views[side];
    measure_changes(views.input[side], view.filtered, y0, y1, view.blocks);
  });
  double still = 1;
  for (PastViews::View& view : past.views) {
    still = std::min(still, rate_changes(noise_level(view.noise), view.blocks));
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
      move_means(views.input[side], view.moves, view.mean, view.blocks.frames, y0, y1, past.moved,
                 view.filtered);
    });
    std::swap(view.mean, past.moved.mean);
    std::swap(view.blocks.frames, past.moved.frames);
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

void PastViews::resize(const Settings& settings, const FrameSize& size) {
  const auto [width, height] = size.input;
  const Image<std::uint8_t>& left = views[0].filtered;
  if (settings.filters() && left.width() == width && left.height() == height) return;
  restart();
  if (!settings.filters()) return;
  for (View& view : views) {
    view.mean.resize(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(view.mean.row(y), width, std::uint16_t{0});
    view.filtered.resize(width, height);
    view.blocks.resize(width, height);
    view.noise.resize(width, height);
    view.moves.resize(width, height);
  }
  moved.resize(width, height);
  for (ViewPyramid* pyramid : {&last, &present}) pyramid->resize(width, height);
  // For maps of both resolutions.
  points.resize(half_of(size.frame.width), half_of(size.frame.height));
  points.resize(size.frame.width, size.frame.height);
  disparities.resize(time_blocks(width), time_blocks(height));
}

void filter_in_time(const StepContext& step, const LastPair& last, Views& views, PastViews& past) {
  past.motion.reset();
  if (step.settings.follows()) build_pyramid(step.input_bands, views.input[0], past.present);
  past.averaged = may_average(step, last, views, past);
  for (PastViews::View& view : past.views) {
    count_frames(!past.averaged, view.blocks);
    // Halved views have half of their noise.
    const float noise = past.averaged ? noise_level(view.noise) : 0;
    views.input_noise = std::max(views.input_noise, step.settings.half() ? noise / 2 : noise);
  }
  step.input_bands.rows_of_both_views([&](int side, int y0, int y1, int) {
    PastViews::View& view = past.views[side];
    average_rows(views.input[side], y0, y1, view.blocks, view.mean, view.filtered);
  });
  for (int side = 0; side < 2; ++side) views.replace_input(side, past.views[side].filtered.view());
  views.left = views.input[0];
  std::swap(past.last, past.present);
  past.valid = true;
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/buffer.hpp"
#include "matcher/result_steps.hpp"
#include "matcher/view_steps.hpp"
#include "stages/prepare/block_moves.hpp"
#include "stages/prepare/camera_motion.hpp"
#include "stages/prepare/noise_level.hpp"
#include "stages/prepare/time_filter.hpp"

/// The step that averages the views over time, and its memory.

namespace mtstereo {

/// What the steps of a pair know of the views before: their means.
struct PastViews {
  struct View {
    Image<std::uint16_t> mean;     ///< [1 / kMeanOne gray values]
    Image<std::uint8_t> filtered;  ///< the same in gray values: the view of this frame
    TimeBlocks blocks;
    NoiseBlocks noise;
    BlockMoves moves;
  };
  std::array<View, 2> views;  ///< by Side
  Means moved;                ///< the means of a view along the motion of the camera
  ViewPyramid last, present;  ///< the left views, as the caller passes them
  bool valid = false;         ///< there was a pair

  // of the present pair
  bool averaged = false;               ///< the views are averages over time
  std::optional<CameraMotion> motion;  ///< from the last pair, if the means were moved
  MotionPoints points;                 ///< of the last map in the input views
  Image<float> disparities;            ///< of the blocks of the last left view

  /// Begins anew, as for another stream.
  void restart() { valid = averaged = false; }
  void resize(const Settings& settings, const FrameSize& size);
};

/// Averages the views over time where they are still, or where they follow the camera.
void filter_in_time(const StepContext& step, const LastPair& last, Views& views, PastViews& past);

}  // namespace mtstereo

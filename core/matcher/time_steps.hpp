// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
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
  std::array<Means, 2> means;  ///< by Side; their filtered views are those of this frame
  ViewPyramid last;            ///< the left view, as the caller passes it
  bool valid = false;          ///< there was a pair

  // of the present pair, in filter_in_time() only
  struct View {
    TimeBlocks blocks;
    NoiseBlocks noise;
    BlockMoves moves;
    Means moved;  ///< the means along the motion of the camera
  };
  std::array<View, 2> views;  ///< by Side
  ViewPyramid present;        ///< the left view, as the caller passes it
  MotionPoints points;        ///< of the last map in the input views
  Image<float> disparities;   ///< of the blocks of the last left view

  // of the present pair
  bool averaged = false;               ///< the views are averages over time
  std::optional<CameraMotion> motion;  ///< from the last pair, if the means were moved

  /// The means to which a view is added.
  const Means& last_means(int side) const { return motion ? views[side].moved : means[side]; }
  /// Begins anew, as for another stream.
  void restart() { valid = averaged = false; }
  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// Averages the views over time where they are still, or where they follow the camera.
void filter_in_time(const StepContext& step, const LastPair& last, Views& views, PastViews& past);

}  // namespace mtstereo

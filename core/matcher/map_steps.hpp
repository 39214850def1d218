// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/bands.hpp"
#include "base/buffer.hpp"
#include "matcher/frame_size.hpp"
#include "matcher/step.hpp"
#include "matcher/view_steps.hpp"
#include "stages/refine/clues.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/disparity_refinement.hpp"
#include "stages/refine/map_smoothing.hpp"
#include "stages/refine/speckle_removal.hpp"
#include "stages/refine/thin_chains.hpp"
#include "stages/refine/thin_structures.hpp"

/// The steps that change the map of either matcher and give it the size of the caller's views, and
/// their memory.

namespace mtstereo {

/// The disparity map of the matched views and the buffers of the stages that change it.
struct Maps {
  Image<std::int32_t> disparity;
  Image<std::uint8_t> ratio;       ///< peak ratios
  Image<std::uint8_t> confidence;  ///< 1 .. 255, 0 where there is no disparity
  SpeckleRuns speckles;            ///< of this map, then of the one that the rejection leaves
  Image<std::uint8_t> area;        ///< weights of the areas' sizes in the confidence
  SupportMap support;
  ThinRuns thin;
  UnfilteredMap unfiltered;      ///< the map before the filters
  Image<std::int32_t> smoothed;  ///< smoothed along the rows only

  struct Scratch {
    SupportScratch support;
    ThinScratch thin;
    Image<std::int32_t> columns;  ///< a block of the map's columns as rows
    SmoothingScratch smoothing;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// The map on its way to the caller. A step that writes another map makes that one the result.
struct ResultMaps {
  Image<std::int32_t>* disparity = nullptr;
  Image<std::uint8_t>* confidence = nullptr;
  float fine_detail = kUnknownDetail;  ///< of the views, FineDetail::share()
  int grid_level = 0;                  ///< of the left view and the map, BlockGrid::level()
  int block_side = kBlockSide;         ///< of the blocks of that level

  Image<std::int32_t> refined;
  Image<std::int32_t> enlarged;
  Image<std::uint8_t> enlarged_confidence;
  Image<std::int32_t> shifted;
  Image<std::uint8_t> shifted_confidence;
  std::vector<RefinementScratch> scratch;  ///< one for each thread

  /// Begins a frame with the map of the matched views as the result.
  void start(Maps& maps);
  void resize(const Settings& settings, const FrameSize& size);
};

/// Finds thin structures in the map of the matching and keeps a copy of that map.
void find_thin_structures(const StepContext& step, const Views& views, Maps& maps);

/// Removes the areas with fewer than `size` pixels from a map. `area` becomes the weights of the
/// sizes of the others; nullptr if they are not needed.
void remove_areas(const Bands& bands, int size, SpeckleRuns& runs, Image<std::int32_t>& map,
                  Image<std::uint8_t>* area);

/// Removes small areas.
void remove_speckles(const StepContext& step, Maps& maps);

/// Rates the confidence of the map.
void rate_confidence(const StepContext& step, Maps& maps);

/// The part of it after copy_support(), and the removal of pixels of low confidence.
void threshold_support(const StepContext& step, Maps& maps);

/// Smooths the map along each surface.
void smooth(const StepContext& step, Maps& maps);

/// Refines the map of halved views by the input views.
void refine(const StepContext& step, const Views& views, ResultMaps& result);

/// Enlarges the result of halved views to the size of the input views.
void enlarge(const StepContext& step, ResultMaps& result);

/// Gives all pixels without a disparity one.
void complete_all(const Bands& bands, ResultMaps& result);

/// Undoes the shift of the views in the map. In mode full, columns that only one shifted view has
/// continue what is beside them.
void shift_result(const StepContext& step, ResultMaps& result);

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "matcher/map_steps.hpp"
#include "matcher/path_steps.hpp"
#include "matcher/rating.hpp"
#include "matcher/view_steps.hpp"
#include "stages/refine/edge_alignment.hpp"
#include "stages/refine/speckle_removal.hpp"

/// The steps that complete the map of the paths, rate it and reject what is not reliable, and their
/// memory. The map has the size of the caller's views.

namespace mtstereo {

struct ResultBuffers {
  EdgeMap edges;
  Rating rating;
  SpeckleRuns islands;  ///< of what the rejection leaves

  struct Scratch {
    EdgeScratch edges;
    Buffer<std::int32_t> columns;  ///< a block of columns
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// Measures how sharp the views are, at the pixels that were matched.
void measure_fine_detail(const StepContext& step, const Views& views, ResultMaps& result);

/// Gives the remaining pixels a disparity.
void complete_map(const StepContext& step, ResultMaps& result);

/// Moves jumps of the complete map to the edges of the left view.
void align_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers);

/// What the clues of the reliability are about; all arguments must outlive it.
RatedViews rated_views(const Views& views, const Pyramid& pyramid, const ResultMaps& result);

/// Replaces the confidence of the complete map by its reliability.
void calibrate_confidence(const StepContext& step, const Views& views, const Pyramid& pyramid,
                          ResultMaps& result, ResultBuffers& buffers);

/// Corrects what the right camera may not see at the left of the complete, rated map.
void correct_strip(const StepContext& step, ResultMaps& result);

/// Removes what is less reliable than asked for, and small islands that are left.
void reject_unlikely(const StepContext& step, ResultMaps& result, ResultBuffers& buffers);

/// Fills small gaps that the rejection has left in a surface. What it fills is inferred, not
/// matched.
void close_gaps(const StepContext& step, ResultMaps& result, ResultBuffers& buffers);

/// Draws the thin structures into the map.
void draw_thin_structures(const StepContext& step, const Maps& maps, ResultMaps& result);

}  // namespace mtstereo

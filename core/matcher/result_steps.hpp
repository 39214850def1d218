// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/buffer.hpp"
#include "matcher/map_steps.hpp"
#include "matcher/path_steps.hpp"
#include "matcher/rating.hpp"
#include "matcher/view_steps.hpp"
#include "stages/prepare/camera_motion.hpp"
#include "stages/refine/block_grid.hpp"
#include "stages/refine/edge_alignment.hpp"
#include "stages/refine/flat_planes.hpp"
#include "stages/refine/speckle_removal.hpp"

/// The steps that complete the map of the paths, rate it and reject what is not reliable, and their
/// memory. The map has the size of the matched views.

namespace mtstereo {

struct ResultBuffers {
  EdgeMap edges;
  Image<std::uint8_t> replaced;  ///< the pixels that have a plane, until their edges are aligned
  Rating rating;
  FlatAreas areas;
  Buffer<FlatPlane> planes;  ///< of the areas

  struct Scratch {
    EdgeScratch edges;
    PlaneVotes votes;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// Measures how sharp the views are, at the pixels that were matched.
void measure_fine_detail(const StepContext& step, const Views& views, ResultMaps& result);

/// The last pair of the stream: all that the steps of a pair know of those before.
struct LastPair {
  ViewPyramid view;                ///< the left one
  Image<std::uint16_t> disparity;  ///< its map [1 / kHeldOne px], 0 = unknown
  bool valid = false;              ///< there was one

  // of the present pair
  ViewPyramid present;                 ///< the left view, in find_camera_motion() only
  MotionPoints points;                 ///< of the left view and the map; kept for the next pair
  std::optional<CameraMotion> motion;  ///< if the last pair shows the same scene

  /// Begins anew, as for another stream.
  void restart() { valid = false; }
  void resize(const Settings& settings, const FrameSize& size, ReusedMemory& reused);
};

/// Finds whether the map matches the blocks of the views' compression.
void measure_block_grid(const StepContext& step, const Views& views, ResultMaps& result);

/// Gives the remaining pixels a disparity.
void complete_map(const StepContext& step, ResultMaps& result);

/// Doubts the pixels that align_map_edges() would change.
void doubt_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers);

/// Moves jumps of the complete map to the edges of the left view.
void align_map_edges(const StepContext& step, const Views& views, ResultMaps& result,
                     ResultBuffers& buffers);

/// The same of the jumps that complete_flat_areas() has made.
void align_plane_edges(const StepContext& step, const Views& views, ResultMaps& result,
                       ResultBuffers& buffers);

/// The same of the map that is enlarged to the size of the input views.
void align_enlarged_edges(const StepContext& step, const Views& views, ResultMaps& result,
                          ResultBuffers& buffers);

/// What the clues of the reliability are about; all arguments must outlive it.
RatedViews rated_views(const Settings& settings, const Views& views, const Pyramid& pyramid,
                       const ResultMaps& result);

/// Replaces the confidence of the complete map by its reliability.
void calibrate_confidence(const StepContext& step, const Views& views, const Pyramid& pyramid,
                          ResultMaps& result, ResultBuffers& buffers);

/// Corrects what the right camera may not see at the left of the complete, rated map.
void correct_strip(const StepContext& step, ResultMaps& result);

/// Finds the planes of the flat areas of the left view.
void fit_flat_areas(const StepContext& step, const Views& views, const Pyramid& pyramid,
                    const ResultMaps& result, ResultBuffers& buffers);

/// Gives the doubted pixels of flat areas their planes.
void complete_flat_areas(const StepContext& step, ResultMaps& result, ResultBuffers& buffers);

/// Raises the confidence of what agrees with the planes of flat areas, and lowers that of what
/// contradicts them.
void check_flat_areas(const StepContext& step, const Views& views, ResultMaps& result,
                      const ResultBuffers& buffers);

/// Finds how the camera moved since the last pair, and keeps the left view for the next one.
void find_camera_motion(const StepContext& step, const Views& views, const ResultMaps& result,
                        LastPair& last);

/// Removes the disparities whose confidence is below what the last map asks for at their place.
/// Does nothing if the motion of the camera is unknown.
void hold_known(const StepContext& step, const Views& views, const LastPair& last,
                ResultMaps& result);

/// Removes what is less reliable than asked for, unless hold_known() has done so, and the small
/// islands that are left.
void reject_unlikely(const StepContext& step, const Views& views, const LastPair& last, Maps& maps,
                     ResultMaps& result);

/// Fills small gaps that the rejection has left in a surface. What it fills is inferred, not
/// matched.
void close_gaps(const StepContext& step, ResultMaps& result);

/// Draws the thin structures into the map.
void draw_thin_structures(const StepContext& step, const Maps& maps, ResultMaps& result);

/// Keeps the map for the next pair.
void keep_pair(const StepContext& step, const ResultMaps& result, LastPair& last);

}  // namespace mtstereo

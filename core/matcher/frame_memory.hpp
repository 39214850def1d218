// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/buffer.hpp"
#include "base/limits.hpp"
#include "matcher/settings.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/census_matching.hpp"
#include "stages/pixels/path_matching.hpp"
#include "stages/pixels/pixel_matching.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/noise_filter.hpp"
#include "stages/prepare/noise_level.hpp"
#include "stages/prepare/preprocess.hpp"
#include "stages/prepare/row_alignment.hpp"
#include "stages/prepare/view_blur.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/disparity_refinement.hpp"
#include "stages/refine/edge_alignment.hpp"
#include "stages/refine/map_smoothing.hpp"
#include "stages/refine/reliability.hpp"
#include "stages/refine/speckle_removal.hpp"
#include "stages/refine/thin_chains.hpp"
#include "stages/refine/withheld.hpp"

namespace mtstereo {

/// The memory of one matcher, in groups. A group holds the results of its stages, which later
/// stages read, and the scratch memory of each thread. Its resize() is the only place that
/// allocates; call it after every change of settings or size. Buffers only grow, so resize() is
/// cheap if nothing larger is needed.

/// A width and a height [px].
struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// What determines the sizes of the groups.
struct FrameSize {
  ImageSize input;    ///< of the caller's views and the result
  ImageSize frame;    ///< of the input views after their shift by the smallest disparity
  ImageSize matched;  ///< of the matched views: the frame's size or half of it
  int threads = 1;
};

/// The two views and what the stages in prepare/ compute from them. All arrays are indexed by Side.
struct Views {
  GrayView left;                    ///< the caller's left view
  std::array<GrayView, 2> input;    ///< the views of this frame: the caller's or corrected ones
  std::array<GrayView, 2> matched;  ///< those to match: the input, its halves, or these filtered
  Image<std::uint8_t> aligned;      ///< the right view with its rows aligned
  std::array<Image<std::uint8_t>, 2> blurred;
  std::array<Image<std::uint8_t>, 2> extended;  ///< with more columns, for negative disparities
  std::array<Image<std::uint8_t>, 2> halves;
  std::array<NoiseBlocks, 2> noise;
  float noise_level = 0;  ///< of the noisier view, before it was filtered; 0 without the filter
  std::array<Image<std::uint8_t>, 2> filtered;  ///< without noise
  std::array<PreprocessedView, 2> preprocessed;
  std::array<MaxTrees, 2> trees;
  std::array<CensusImage, 2> census;        ///< of the matched views
  std::array<CensusImage, 2> input_census;  ///< of the input views, for the refinement

  struct Scratch {
    AlignmentScratch alignment;
    BlurScratch blur;
    NoiseFilterScratch noise_filter;
    MedianScratch median;
    SobelScratch sobel;
    CensusScratch census;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  /// Makes a corrected view the input of the later steps.
  void replace_input(int side, GrayView corrected) {
    if (matched[side].data == input[side].data) matched[side] = corrected;
    input[side] = corrected;
  }
  void resize(const Settings& settings, const FrameSize& size);
};

/// One level of S: its nodes and their matches.
struct NodeLevelMatches {
  NodeLevel left;
  NodeLevel right;
  SearchIntervals intervals;
  NodeMatches matches;
};

/// The nodes and their matches: the stages in nodes/.
struct Nodes {
  std::array<NodeLevelMatches, kMostNodeLevels> levels;  ///< coarse to fine
  int level_count = 0;                                   ///< number of levels in use
  LeafDisparities ends;                                  ///< of the leaves, the finest level

  struct Scratch {
    IntervalScratch intervals;
    MatchScratch match;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  const NodeLevelMatches& leaves() const { return levels[level_count - 1]; }
  void resize(const Settings& settings, const FrameSize& size);
};

/// The costs of pixels: the cost volume (gradient cost), or a few rows of census costs in the
/// scratch memory of each thread.
struct Costs {
  SmoothingKernel kernel;
  int kernel_size = 0;   ///< the size [px] that the kernel was made for
  int kernel_shift = 0;  ///< the volume's shift that it was made for
  CostVolume volume;

  struct Scratch {
    CostScratch volume;
    CensusMatchingScratch census;
    PixelMatchingScratch gradient;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// Number of reduced resolutions with guide=pyramid: 1/2, 1/4 and 1/8.
inline constexpr int kPyramidLevels = 3;

/// The views at 1 / 2^level of the matched resolution, and their disparity map.
struct PyramidLevel {
  std::array<Image<std::uint8_t>, 2> views;
  std::array<CensusImage, 2> census;
  Image<std::int32_t> disparity;
  Image<std::uint8_t> ratio;
};

/// The matching along paths, with guide=pyramid.
struct Pyramid {
  std::array<PyramidLevel, kPyramidLevels> levels;  ///< fine to coarse, from 1/2 on
  WindowVotes votes;                                ///< of the level of 1/2
  SearchWindows windows;                            ///< of full resolution
  Image<std::uint8_t> agreement;                    ///< a pixel for each tile of the votes
  SupportMap support;                               ///< of the level of 1/2
  Image<std::uint8_t> confidence;                   ///< of that level
  ClueMaps clues;                                   ///< of that level
  std::vector<PathMatchingScratch> scratch;         ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// The disparity map of the matched views and the buffers of the stages that change it.
struct Maps {
  Image<std::int32_t> disparity;
  Image<std::uint8_t> ratio;       ///< peak ratios
  Image<std::uint8_t> confidence;  ///< 1 .. 255, 0 where there is no disparity
  VoteMap votes;
  SpeckleRuns speckles;
  Image<std::uint8_t> area;  ///< weights of the areas' sizes in the confidence
  SupportMap support;
  ThinRuns thin;
  Image<std::int32_t> columns;  ///< the map with its columns as rows
  WithheldMap withheld;
  Image<std::uint8_t> guarded;   ///< 1 where something nearer is in a gap
  Image<std::int32_t> smoothed;  ///< smoothed along the rows only

  struct Scratch {
    Buffer<std::uint8_t> marks;  ///< a row
    SupportScratch support;
    Buffer<std::int32_t> columns;  ///< a block of columns
    ThinScratch thin;
    SmoothingScratch smoothing;
  };
  std::vector<Scratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// The map at the size of the input views, for matching at half resolution.
struct EnlargedMaps {
  Image<std::int32_t> disparity;
  Image<std::uint8_t> confidence;
  Image<std::int32_t> refined;
  std::vector<RefinementScratch> scratch;  ///< one for each thread

  void resize(const Settings& settings, const FrameSize& size);
};

/// The map before its shift, with these settings. The arguments may be const.
template <typename OfMaps, typename OfEnlarged>
auto& last_disparity(const Settings& settings, OfMaps& maps, OfEnlarged& enlarged) {
  if (settings.refined()) return enlarged.refined;
  return settings.half() ? enlarged.disparity : maps.disparity;
}
template <typename OfMaps, typename OfEnlarged>
auto& last_confidence(const Settings& settings, OfMaps& maps, OfEnlarged& enlarged) {
  return settings.half() ? enlarged.confidence : maps.confidence;
}

/// The result, if the smallest disparity differs from 0: the size of the caller's views.
struct OutputMaps {
  Image<std::int32_t> disparity;
  Image<std::uint8_t> confidence;

  void resize(const Settings& settings, const FrameSize& size);
};

/// What guide=pyramid needs to complete and rate the result, which has the size of the caller's
/// views.
struct Completion {
  EdgeMap edges;
  std::vector<EdgeScratch> scratch;  ///< one for each thread
  ClueMaps clues;
  std::vector<ClueScratch> clue_scratch;                ///< one for each thread
  std::vector<ReliabilityScratch> reliability_scratch;  ///< one for each thread
  SpeckleRuns islands;                                  ///< of what the rejection leaves
  Image<std::uint8_t> weight;  ///< weights of the islands' sizes, which nothing reads

  void resize(const Settings& settings, const FrameSize& size);
};

/// The maps that the caller gets. The arguments may be const.
template <typename OfMaps, typename OfEnlarged, typename OfOutput>
auto callers_maps(const Settings& settings, OfMaps& maps, OfEnlarged& enlarged, OfOutput& output) {
  struct {
    decltype((output.disparity)) disparity;
    decltype((output.confidence)) confidence;
  } result = {settings.shifted() ? output.disparity : last_disparity(settings, maps, enlarged),
              settings.shifted() ? output.confidence : last_confidence(settings, maps, enlarged)};
  return result;
}

/// All groups.
struct FrameMemory {
  Views views;
  Nodes nodes;
  Costs costs;
  Pyramid pyramid;
  Maps maps;
  EnlargedMaps enlarged;
  OutputMaps output;
  Completion completion;

  void resize(const Settings& settings, const FrameSize& size);
};

}  // namespace mtstereo

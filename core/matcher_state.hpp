// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "base/buffer.hpp"
#include "base/settings.hpp"
#include "base/thread_pool.hpp"
#include "mtstereo/matcher.hpp"
#include "stages/nodes/disparity_drawing.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/census_matching.hpp"
#include "stages/pixels/pixel_matching.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/halving.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/preprocess.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/disparity_refinement.hpp"
#include "stages/refine/enlarging.hpp"
#include "stages/refine/gap_filling.hpp"
#include "stages/refine/map_smoothing.hpp"
#include "stages/refine/rim_trimming.hpp"
#include "stages/refine/speckle_removal.hpp"

namespace mtstereo {

inline constexpr int kStages = 5;
inline constexpr int kMostLevels =
    static_cast<int>(std::tuple_size_v<decltype(Parameters::Levels::level)>);

/// What one level of S is matched with.
struct LevelState {
  NodeLevel left;
  NodeLevel right;
  SearchIntervals intervals;
  NodeMatches matches;
};

/// Scratch memory of one thread.
struct WorkerState {
  MedianScratch median;
  SobelScratch sobel;
  Buffer<std::uint8_t> marks;
  Buffer<std::int32_t> intervals;
  CostScratch cost;
  MatchScratch match;
  Image<std::uint8_t> padded;
  CensusMatchingScratch census;
  PixelMatchingScratch pixels;
  SupportScratch support;
  RimScratch rim;
  Buffer<std::int32_t> columns;
  SmoothingScratch smoothing;
  Image<std::uint8_t> frame_padded;
  RefinementScratch refinement;
};

/// All that a matcher keeps from frame to frame. The functions follow the order of the method.
/// Hidden by name, since it would be shown with the class it belongs to.
struct __attribute__((visibility("hidden"))) Matcher::State {
  explicit State(const Parameters& p) : parameters(p), settings(p) {}

  Parameters parameters;
  Settings settings;
  bool keep_stages = false;
  bool sized = false;  ///< the buffers fit the frame's size and the settings
  int frame_width = 0;
  int frame_height = 0;
  int width = 0;  ///< of what is matched: the frame, or its half
  int height = 0;
  std::optional<ThreadPool> pool;

  std::array<Image<std::uint8_t>, 2> halves;  ///< the views at half resolution
  std::array<PreprocessedView, 2> views;      ///< indexed by Side, as all pairs here
  std::array<MaxTrees, 2> trees;
  std::array<LevelState, kMostLevels> levels;  ///< the first settings.node_levels.count are used
  SmoothingKernel kernel;
  CostVolume volume;
  VoteMap votes;
  LeafDisparities ends;
  std::array<CensusImage, 2> census;
  Image<std::int32_t> map;
  Image<std::uint8_t> ratio;       ///< peak ratios of the map
  Image<std::uint8_t> confidence;  ///< of the map
  SupportMap support;
  SpeckleRuns speckles;
  Image<std::uint8_t> rim_marks;
  Image<std::int32_t> smoothed;      ///< the map, smoothed along its rows
  Image<std::int32_t> enlarged_map;  ///< the map and its confidence at the frame's resolution
  Image<std::uint8_t> enlarged_confidence;
  std::array<CensusImage, 2> frame_census;  ///< of the views as they are
  Image<std::int32_t> refined_map;
  std::array<Image<std::int32_t>, kStages> kept;
  std::vector<WorkerState> workers;
  DisparityView result;  ///< of the last frame, empty where it failed
  GrayView rated;        ///< its confidence
  FrameStatistics statistics;

  void take(const Parameters& p);
  void forget_frame();
  void size_buffers();
  void compute(GrayView left, GrayView right);
  void match(GrayView left, GrayView right);

  void halve(GrayView left, GrayView right);
  void preprocess(GrayView left, GrayView right);
  void build_trees();  ///< and selects the nodes that are to be matched
  void transform(GrayView left, GrayView right);
  void compute_costs();
  void match_level(int index);
  bool nodes_are_drawn() const;
  void draw_nodes();
  void remove_outliers();
  void extrapolate();
  void match_pixels(GrayView left);
  void remove_speckles();
  void rate_confidence();
  void trim_rims();
  bool keeps_only_ends() const;
  void keep_node_ends();
  void fill_gaps();
  void smooth();
  void enlarge();
  void refine(GrayView left, GrayView right);
  CensusMatchingOptions census_options() const;
  void keep(Stage stage);
  double density();

  const LevelState& leaves() const { return levels[settings.node_levels.count - 1]; }

  static constexpr int kBand = 32;     ///< [rows]
  static constexpr int kColumns = 64;  ///< of a block of columns, whose cache lines are its own

  /// Calls body(y0, y1, worker) for bands of rows. The bands are the same for every number of
  /// threads unless `per_thread`: then each thread gets one, for stages that carry work from row to
  /// row.
  template <typename Body>
  void for_rows(Body&& body, bool per_thread = false) {
    const int bands = per_thread ? std::min(pool->threads(), height) : (height + kBand - 1) / kBand;
    pool->run(bands, [&](int band, int worker) {
      const int y0 = per_thread ? static_cast<int>(1LL * height * band / bands) : band * kBand;
      const int y1 = per_thread ? static_cast<int>(1LL * height * (band + 1) / bands)
                                : std::min(y0 + kBand, height);
      body(y0, y1, workers[worker]);
    });
  }

  /// As for_rows() `per_thread`, with two bands for each thread of several, which are about the
  /// same work: work(y) tells that of a row.
  template <typename Work, typename Body>
  void for_rows_of_work(Work&& work, Body&& body) {
    const int bands = pool->threads() == 1 ? 1 : std::min(2 * pool->threads(), height);
    std::int64_t total = 0;
    for (int y = 0; y < height; ++y) total += work(y);
    const auto first_row = [&](int band) {
      int y = 0;
      for (std::int64_t done = 0; y < height && done * bands < total * band; ++y) done += work(y);
      return y;
    };
    pool->run(bands, [&](int band, int worker) {
      const int y0 = first_row(band);
      const int y1 = band + 1 == bands ? height : first_row(band + 1);
      if (y0 < y1) body(y0, y1, workers[worker]);
    });
  }

  /// Calls body(side, y0, y1, worker) for the bands of both views, as for_rows() does for one.
  template <typename Body>
  void for_rows_of_both(Body&& body) {
    const int bands = (height + kBand - 1) / kBand;
    pool->run(2 * bands, [&](int item, int worker) {
      const int y0 = item % bands * kBand;
      body(item / bands, y0, std::min(y0 + kBand, height), workers[worker]);
    });
  }

  /// Calls body(x0, x1, worker) for blocks of the columns 0 .. columns - 1.
  template <typename Body>
  void for_columns(int columns, Body&& body) {
    pool->run((columns + kColumns - 1) / kColumns, [&](int block, int worker) {
      const int x0 = block * kColumns;
      body(x0, std::min(x0 + kColumns, columns), workers[worker]);
    });
  }
};

}  // namespace mtstereo

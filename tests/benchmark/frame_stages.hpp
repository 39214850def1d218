// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/buffer.hpp"
#include "base/settings.hpp"
#include "outcome.hpp"
#include "stages/nodes/node_extrapolation.hpp"
#include "stages/nodes/node_levels.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/nodes/outlier_removal.hpp"
#include "stages/pixels/census_matching.hpp"
#include "stages/pixels/pixel_matching.hpp"
#include "stages/prepare/census.hpp"
#include "stages/prepare/cost_volume.hpp"
#include "stages/prepare/max_tree.hpp"
#include "stages/prepare/median_filter.hpp"
#include "stages/prepare/preprocess.hpp"
#include "stages/refine/confidence.hpp"
#include "stages/refine/disparity_refinement.hpp"
#include "stages/refine/map_smoothing.hpp"
#include "stages/refine/rim_trimming.hpp"
#include "stages/refine/speckle_removal.hpp"

namespace mtstereo::bench {

/// The stages of one frame, each to be run alone and again and again, on one thread and in the
/// matcher's order and bands. What the stages give in the end is the matcher's result.
class FrameStages {
 public:
  /// Runs all stages once. Both images must outlive it. Throws std::runtime_error where the result
  /// is not that of a Matcher with these parameters.
  FrameStages(const Parameters& parameters, const Pair& pair);
  FrameStages(const FrameStages&) = delete;
  FrameStages& operator=(const FrameStages&) = delete;

  /// The stages that these parameters turn on, in the order of the method.
  static std::vector<std::string> names(const Parameters& parameters);

  /// Puts back what the stage begins with: run() changes it.
  void prepare(const std::string& name);
  void run(const std::string& name);
  /// Throws std::runtime_error where the maps are not what the stage left there at first.
  void require_result(const std::string& name) const;

 private:
  struct Level {
    NodeLevel left;
    NodeLevel right;
    SearchIntervals intervals;
    NodeMatches matches;
  };
  /// The maps that a step leaves its result in, which the next one begins with.
  enum class Maps { kMatched, kEnlarged, kRefined };
  struct Step {
    std::string name;
    void (FrameStages::*run)();
    Maps result = Maps::kMatched;
  };

  static std::vector<Step> steps_of(const Settings& settings);
  std::size_t index_of(const std::string& name) const;
  Maps maps_before(std::size_t step) const;
  Outcome outcome(Maps maps) const;
  CensusMatchingOptions census_options() const;
  template <typename Body>
  void for_rows(Body&& body) const;
  void size_views();
  void size_maps();
  void size_frame();

  void halve();
  void preprocess();
  void build_trees();
  void compute_costs();
  void select_levels();
  void match_levels();
  void draw();
  void remove_outliers();
  void extrapolate();
  void transform();
  void match_by_census();
  void match_by_costs();
  void remove_speckles();
  void rate_confidence();
  void trim_rims();
  bool rates_only_ends() const;
  void keep_node_ends();
  void fill_gaps();
  void smooth();
  void enlarge();
  void transform_frame();
  void refine();

  const Level& leaves() const { return levels_[settings_.node_levels.count - 1]; }

  Settings settings_;
  GrayView frame_left_, frame_right_;
  GrayView left_, right_;  ///< what is matched: the frame or its halves
  int width_, height_;     ///< of what is matched
  std::vector<Step> steps_;
  std::vector<cv::Mat> ratio_before_;  ///< each step
  std::vector<Outcome> before_;        ///< each step; one more: behind the last

  std::array<PreprocessedView, 2> views_;
  std::array<MaxTrees, 2> trees_;
  std::vector<Level> levels_;
  SmoothingKernel kernel_;
  CostVolume volume_;
  VoteMap votes_;
  LeafDisparities ends_;
  std::array<CensusImage, 2> census_;
  Image<std::int32_t> map_;
  Image<std::uint8_t> ratio_, confidence_, rim_marks_;
  SupportMap support_;
  SpeckleRuns speckles_;
  Image<std::int32_t> smoothed_, enlarged_map_, refined_map_;
  Image<std::uint8_t> enlarged_confidence_;
  std::array<Image<std::uint8_t>, 2> halves_;
  std::array<CensusImage, 2> frame_census_;

  MedianScratch median_scratch_;
  SobelScratch sobel_scratch_;
  Image<std::uint8_t> census_rows_scratch_;
  Buffer<std::uint8_t> marks_;
  Buffer<std::int32_t> intervals_scratch_, columns_;
  CostScratch cost_scratch_;
  MatchScratch match_scratch_;
  CensusMatchingScratch census_scratch_;
  PixelMatchingScratch pixel_scratch_;
  SupportScratch support_scratch_;
  RimScratch rim_scratch_;
  SmoothingScratch smoothing_scratch_;
  Image<std::uint8_t> frame_rows_scratch_;
  RefinementScratch refinement_scratch_;
};

}  // namespace mtstereo::bench

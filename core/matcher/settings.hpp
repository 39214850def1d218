// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "mtstereo/alignment.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"
#include "parameters/choices.hpp"
#include "stages/nodes/node_matching.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/path_matching.hpp"
#include "stages/pixels/search_range.hpp"
#include "stages/pixels/smoothness.hpp"
#include "stages/refine/holding.hpp"
#include "stages/refine/reliability_table.hpp"

namespace mtstereo {

/// The parameters of one frame as typed values, derived from Parameters once, before the frame
/// starts, and the correction of its views. The parameter table states the meaning of each field.
/// Lengths in px count pixels of the matched resolution unless stated otherwise.
struct Settings {
 private:
  using P = Parameter;
  Parameters set_;  // for the values below

 public:
  explicit Settings(const Parameters& parameters);

  Mode mode = set_.mode();
  /// For each frame; a ResolutionChoice calls match_at().
  bool chooses_resolution = choice<Resolution>(set_) == Resolution::kAuto;
  Resolution resolution;  ///< of the frame, never Resolution::kAuto
  Cost cost = choice<Cost>(set_);
  int threads = set_.integer(P::kThreads);             ///< 0: one per processor
  int min_disparity = set_.integer(P::kMinDisparity);  ///< the smallest one [px of the views]
  int view_disparities;                                ///< D, from there on [px of the views]
  int disparities;                                     ///< D [px]
  bool noise_filter = set_.get(P::kNoiseFilter) != 0;

  // nodes
  int gray_levels = set_.integer(P::kGrayLevels);           ///< q
  int min_node_width = set_.integer(P::kMinNodeWidth);      ///< omega_alpha [px]
  double max_node_width = set_.get(P::kMaxNodeWidth);       ///< omega_beta, fraction of the width
  Parameters::Levels node_levels = set_.node_levels();      ///< S
  int max_neighbors = set_.integer(P::kMaxNeighbors);       ///< omega_gamma [rows]
  int cost_kernel_size = set_.integer(P::kCostKernelSize);  ///< omega_cv [px]
  CostVolumeResolution cost_volume = choice<CostVolumeResolution>(set_);
  float intensity_weight = static_cast<float>(set_.get(P::kIntensityWeight));  ///< alpha, 0 .. 1
  float node_confidence;                                 ///< omega_Pi, as a share
  int outlier_radius = set_.integer(P::kOutlierRadius);  ///< [px], 0 = no outlier removal
  OutlierRemoval outlier_removal = choice<OutlierRemoval>(set_);

  // pixels
  int census_scales = set_.integer(P::kCensusScales);
  SearchRangeOptions search_range;
  CensusCostOptions census_cost;
  SmoothnessOptions smoothness;  ///< [bits]
  SelectionOptions selection;

  // refinement
  int speckle_size = set_.integer(P::kSpeckleSize);      ///< [px]
  int min_confidence = set_.integer(P::kMinConfidence);  ///< 0 .. 255
  bool thin_objects = set_.get(P::kThinObjects) != 0;    ///< keep them, and fill no gap over them
  int node_end_width = set_.integer(P::kNodeEndWidth);   ///< [px]
  int max_gap = set_.integer(P::kMaxGap);                ///< [px]
  int smoothing_radius = set_.integer(P::kSmoothingRadius);  ///< [px]

  Temporal temporal = choice<Temporal>(set_);

  /// What is done to the input views; no parameter sets it.
  ViewCorrection correction;

  /// Sets the resolution of the frame, and what depends on it.
  void match_at(Resolution resolution);
  /// Whether the views are matched at half resolution.
  bool half() const { return resolution != Resolution::kFull; }
  /// Whether the disparities are then refined at full resolution.
  bool refined() const { return resolution == Resolution::kHalfRefined; }
  /// Whether all pixels are matched along paths, without nodes, and the rest is inferred. With
  /// nodes, the modes dense and full run the steps of semi-dense.
  bool by_paths() const { return cost == Cost::kCensus; }
  /// Whether the map has inferred disparities other than filled gaps.
  bool infers() const { return mode == Mode::kDense || mode == Mode::kFull; }
  /// Whether matched disparities are compared with the planes of flat areas. At half the resolution
  /// the planes of mode semi-dense do not improve the confidence.
  bool checks_planes() const {
    return mode == Mode::kDense || (mode == Mode::kSemiDense && !half());
  }
  /// Pixels per pixel of the view in which flat areas are found.
  int flat_scale() const { return infers() ? 2 : 4; }
  /// Whether every pixel gets a disparity.
  bool keeps_all() const { return by_paths() && mode == Mode::kFull; }
  /// Whether min_confidence applies to the complete map, and not to the matched one.
  bool keeps_likely_only() const { return by_paths() && mode != Mode::kFull; }
  /// Whether min_confidence applies to inferred disparities as to matched ones.
  bool keeps_inferred() const { return by_paths() && mode == Mode::kDense; }
  /// Whether areas of fewer pixels than speckle_size are removed.
  bool removes_speckles() const { return speckle_size > 1; }
  /// Whether outliers are removed from the pixels as well; with nodes.
  bool removes_pixel_outliers() const {
    return outlier_radius > 0 && outlier_removal == OutlierRemoval::kNodesAndPixels;
  }
  /// Whether pixels of the complete map are removed.
  bool rejects_unlikely() const { return keeps_likely_only() && least_reliability() > 0; }
  /// The least confidence of a pixel of the complete map that is kept.
  int least_reliability() const {
    return keeps_inferred() ? min_confidence : std::max(min_confidence, kMostInferred + 1);
  }
  /// Whether the views are averaged over time where they are still.
  bool filters() const { return temporal == Temporal::kFilter; }
  /// Whether the last map of the stream decides what confidence a pixel of the next one needs.
  bool holds() const { return temporal != Temporal::kOff && rejects_unlikely(); }
  /// Whether the motion of the camera is found.
  bool follows() const { return by_paths() && (filters() || holds()); }
  /// The least confidence of pixels, by what the last map knows of them. `noise` is that of the
  /// noisier view [gray values].
  LeastConfidence least_confidence(float noise) const;
  /// The kind of the complete map, for its reliability.
  RatedMap rated_map() const {
    if (half()) return infers() ? RatedMap::kHalfComplete : RatedMap::kHalfMatched;
    return infers() ? RatedMap::kComplete : RatedMap::kMatched;
  }
  /// Whether the sharpness of the views is a clue for the reliability. Only the tables of these
  /// kinds of maps have it: the others keep about as few errors on soft views without it.
  bool rates_detail() const { return !infers(); }
  /// The options of the paths for the views at 1 / 2^level of the matched resolution.
  PathMatchingOptions path_matching(int level) const;
  /// Whether the smallest disparity differs from 0.
  bool shifted() const { return min_disparity != 0; }
  /// What a disparity of 0 px of the matched views stands for [px of these views].
  float matched_offset() const {
    return static_cast<float>(min_disparity) / static_cast<float>(half() ? 2 : 1);
  }
  /// Whether the rows of the right view are resampled, and whether a view is blurred.
  bool aligned() const { return !(correction.rows == RowField()); }
  bool blurred() const { return correction.left_blur > 0 || correction.right_blur > 0; }
  /// Number of pixels around each end of a leaf that start guided pixel matching; 0: the whole
  /// leaf.
  int drawn_end_width() const { return mode == Mode::kSparse ? node_end_width : 0; }
};

}  // namespace mtstereo

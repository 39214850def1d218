// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/parameters.hpp"
#include "stages/pixels/census_cost.hpp"
#include "stages/pixels/disparity_selection.hpp"
#include "stages/pixels/scanline_optimization.hpp"
#include "stages/pixels/search_range.hpp"

namespace mtstereo {

/// The parameters of one frame as plain numbers: taken from Parameters once, at the frame's start.
/// Each field's meaning stands in the parameter table.
struct Settings {
  explicit Settings(const Parameters& p)
      : mode(p.mode()),
        half(p.text(Parameter::kResolution) != "full"),
        refined(p.text(Parameter::kResolution) == "half-refined"),
        max_disparity(p.integer(Parameter::kMaxDisparity)),
        disparities(half ? (max_disparity + 1) / 2 : max_disparity),
        gray_levels(p.integer(Parameter::kGrayLevels)),
        min_node_width(p.integer(Parameter::kMinNodeWidth)),
        max_node_width(p.get(Parameter::kMaxNodeWidth)),
        node_levels(p.node_levels()),
        max_neighbors(p.integer(Parameter::kMaxNeighbors)),
        node_census(p.text(Parameter::kNodeCost) == "census"),
        median_in_costs(p.text(Parameter::kMedianFilter) == "trees-and-costs"),
        cost_kernel_size(p.integer(Parameter::kCostKernelSize)),
        cost_shift(p.text(Parameter::kCostVolume) == "half" ? 1 : 0),
        intensity_weight(static_cast<float>(p.get(Parameter::kIntensityWeight))),
        node_confidence(static_cast<float>(p.get(Parameter::kNodeConfidence) / 100)),
        outlier_radius(p.integer(Parameter::kOutlierRadius)),
        pixel_outliers(p.text(Parameter::kOutlierRemoval) == "nodes-and-pixels"),
        census(p.text(Parameter::kPixelCost) == "census"),
        search_range{p.get(Parameter::kPixelSearchRange) / 100,
                     static_cast<BetweenNodes>(p.integer(Parameter::kBetweenNodes)), disparities},
        census_cost{disparities, p.integer(Parameter::kCensusKernelSize),
                    p.integer(Parameter::kRangePenalty)},
        smoothness{p.integer(Parameter::kSmallStepPenalty),
                   p.integer(Parameter::kLargeStepPenalty)},
        selection{disparities, p.get(Parameter::kPixelConfidence) / 100,
                  p.text(Parameter::kRunnerUp) == "expected",
                  p.integer(Parameter::kLeftRightTolerance), p.get(Parameter::kSubpixel) != 0},
        speckle_size(p.integer(Parameter::kSpeckleSize)),
        min_confidence(p.integer(Parameter::kMinConfidence)),
        rim_trim(p.integer(Parameter::kRimTrim)),
        node_end_width(p.integer(Parameter::kNodeEndWidth)),
        max_gap(p.integer(Parameter::kMaxGap)),
        smoothing_radius(p.integer(Parameter::kSmoothingRadius)) {}

  Mode mode;
  bool half;                       ///< the views are matched at half resolution
  bool refined;                    ///< and the disparities refined at full resolution
  int max_disparity;               ///< D [px of the views]
  int disparities;                 ///< D [px of the resolution that is matched]
  int gray_levels;                 ///< q
  int min_node_width;              ///< omega_alpha [px]
  double max_node_width;           ///< omega_beta, share of the image's width
  Parameters::Levels node_levels;  ///< S
  int max_neighbors;               ///< omega_gamma [rows]
  bool node_census;                ///< nodes are compared by the census transform
  bool median_in_costs;            ///< the cost volume is made of the median-filtered images
  int cost_kernel_size;            ///< omega_cv [px]
  int cost_shift;                  ///< 1: volume at half resolution, 0: at full
  float intensity_weight;          ///< alpha, 0 .. 1
  float node_confidence;           ///< omega_Pi of the nodes, as a share
  int outlier_radius;              ///< [px]
  bool pixel_outliers;             ///< outliers are removed from the pixels' disparities too
  bool census;                     ///< guided pixel matching takes the census cost
  SearchRangeOptions search_range;
  CensusCostOptions census_cost;
  SmoothnessOptions smoothness;  ///< [bits]
  SelectionOptions selection;
  int speckle_size;      ///< [px]
  int min_confidence;    ///< 0 .. 255
  int rim_trim;          ///< [px]
  int node_end_width;    ///< [px]
  int max_gap;           ///< [px]
  int smoothing_radius;  ///< [px]

  bool needs_census() const { return node_census || census; }
  bool needs_volume() const { return !node_census || !census; }
};

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// The parameters of one frame as plain numbers: taken from Parameters once, at the frame's start.
/// Each field's meaning stands in the parameter table.
struct Settings {
  explicit Settings(const Parameters& p)
      : mode(p.mode()),
        disparities(p.integer(Parameter::kMaxDisparity)),
        gray_levels(p.integer(Parameter::kGrayLevels)),
        min_node_width(p.integer(Parameter::kMinNodeWidth)),
        max_node_width(p.get(Parameter::kMaxNodeWidth)),
        node_levels(p.node_levels()),
        max_neighbors(p.integer(Parameter::kMaxNeighbors)),
        cost_kernel_size(p.integer(Parameter::kCostKernelSize)),
        cost_shift(p.text(Parameter::kCostVolume) == "half" ? 1 : 0),
        intensity_weight(static_cast<float>(p.get(Parameter::kIntensityWeight))),
        node_confidence(static_cast<float>(p.get(Parameter::kNodeConfidence) / 100)),
        outlier_radius(p.integer(Parameter::kOutlierRadius)),
        pixel_search_range(p.get(Parameter::kPixelSearchRange) / 100),
        pixel_confidence(p.get(Parameter::kPixelConfidence) / 100),
        subpixel(p.get(Parameter::kSubpixel) != 0) {}

  Mode mode;
  int disparities;                 ///< D [px]
  int gray_levels;                 ///< q
  int min_node_width;              ///< omega_alpha [px]
  double max_node_width;           ///< omega_beta, share of the image's width
  Parameters::Levels node_levels;  ///< S
  int max_neighbors;               ///< omega_gamma [rows]
  int cost_kernel_size;            ///< omega_cv [px]
  int cost_shift;                  ///< 1: volume at half resolution, 0: at full
  float intensity_weight;          ///< alpha, 0 .. 1
  float node_confidence;           ///< omega_Pi of the nodes, as a share
  int outlier_radius;              ///< [px]
  double pixel_search_range;       ///< omega_omega, as a share
  double pixel_confidence;         ///< omega_Pi of the pixels, as a share
  bool subpixel;
};

}  // namespace mtstereo

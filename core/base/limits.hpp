// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <tuple>

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// The largest values of parameters that determine the size of arrays and the width of integers.
/// The maxima of the parameter table and the array sizes of the stages both use them, so that
/// neither can change without the other. kLargestMaxDisparity and kLargestImageSide are public.

/// Largest absolute value of Parameter::kMinDisparity [px].
inline constexpr int kLargestMinDisparity = 1024;

/// Largest Parameter::kGrayLevels (q): levels fit 8 bits.
inline constexpr int kLargestGrayLevels = 256;

/// Largest level of Parameter::kNodeLevels (S), and the largest number of levels.
inline constexpr int kLargestNodeLevel = 63;
inline constexpr int kMostNodeLevels =
    static_cast<int>(std::tuple_size_v<decltype(Parameters::Levels::level)>);

/// Largest Parameter::kMaxNeighbors (omega_gamma) [rows].
inline constexpr int kLargestNeighbors = 100;

/// Largest Parameter::kCostKernelSize (omega_cv) [px].
inline constexpr int kLargestCostKernel = 41;

/// Largest Parameter::kOutlierRadius [px].
inline constexpr int kLargestOutlierRadius = 31;

/// Largest Parameter::kCensusKernelSize [px].
inline constexpr int kLargestCensusKernel = 5;

/// Largest Parameter::kRangePenalty [bits].
inline constexpr int kLargestRangePenalty = 32;

/// Largest Parameter::kSmallStepPenalty and Parameter::kLargeStepPenalty [bits].
inline constexpr int kLargestStepPenalty = 50;

/// Largest Parameter::kNodeEndWidth [px].
inline constexpr int kLargestNodeEnd = 31;

/// Largest Parameter::kSmoothingRadius [px].
inline constexpr int kLargestSmoothingRadius = 31;

}  // namespace mtstereo

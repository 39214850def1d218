// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string_view>

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// One enum for each parameter that is a choice of words. Its values are the indices of the words,
/// and ChoiceOf binds it to the parameter and the words; the parameter table is checked against
/// ChoiceOf at compile time. Preset and Mode are public.

/// At what resolution the views are matched.
enum class Resolution { kFull, kHalfRefined, kHalf };

/// What nodes and pixels are compared by.
enum class Cost { kCensus, kGradient };

/// Resolution of the smoothed cost volume.
enum class CostVolumeResolution { kHalf, kFull };

/// Where outliers are removed.
enum class OutlierRemoval { kNodes, kNodesAndPixels };

/// What is expected of a pixel between two nodes.
enum class BetweenNodes { kNone, kSpan, kAll };

/// Where the second-best disparity is searched.
enum class RunnerUp { kAny, kExpected };

template <typename Enum>
struct ChoiceOf;

template <>
struct ChoiceOf<Preset> {
  static constexpr Parameter kParameter = Parameter::kPreset;
  static constexpr std::array<std::string_view, kPresets> kWords = {"default", "fast", "paper"};
};

template <>
struct ChoiceOf<Mode> {
  static constexpr Parameter kParameter = Parameter::kMode;
  static constexpr std::array<std::string_view, kModes> kWords = {"sparse", "semi-dense", "dense"};
};

template <>
struct ChoiceOf<Resolution> {
  static constexpr Parameter kParameter = Parameter::kResolution;
  static constexpr std::array<std::string_view, 3> kWords = {"full", "half-refined", "half"};
};

template <>
struct ChoiceOf<Cost> {
  static constexpr Parameter kParameter = Parameter::kCost;
  static constexpr std::array<std::string_view, 2> kWords = {"census", "gradient"};
};

template <>
struct ChoiceOf<CostVolumeResolution> {
  static constexpr Parameter kParameter = Parameter::kCostVolume;
  static constexpr std::array<std::string_view, 2> kWords = {"half", "full"};
};

template <>
struct ChoiceOf<OutlierRemoval> {
  static constexpr Parameter kParameter = Parameter::kOutlierRemoval;
  static constexpr std::array<std::string_view, 2> kWords = {"nodes", "nodes-and-pixels"};
};

template <>
struct ChoiceOf<BetweenNodes> {
  static constexpr Parameter kParameter = Parameter::kBetweenNodes;
  static constexpr std::array<std::string_view, 3> kWords = {"none", "span", "all"};
};

template <>
struct ChoiceOf<RunnerUp> {
  static constexpr Parameter kParameter = Parameter::kRunnerUp;
  static constexpr std::array<std::string_view, 2> kWords = {"any", "expected"};
};

/// The value of a choice in force.
template <typename Enum>
Enum choice(const Parameters& parameters) {
  return static_cast<Enum>(parameters.integer(ChoiceOf<Enum>::kParameter));
}

}  // namespace mtstereo

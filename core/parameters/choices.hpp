// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "mtstereo/parameters.hpp"

namespace mtstereo {

/// One enum for each parameter whose value is one of several words. The enum values are the indices
/// of the words. ChoiceOf binds the enum to the parameter and the words. Preset and Mode are
/// public.

/// Resolution at which the views are matched. kAuto: full or half-refined, chosen for each frame.
enum class Resolution { kFull, kHalfRefined, kHalf, kAuto };

/// Matching cost of nodes and pixels.
enum class Cost { kCensus, kGradient };

/// Resolution of the smoothed cost volume.
enum class CostVolumeResolution { kHalf, kFull };

/// Stages after which outliers are removed.
enum class OutlierRemoval { kNodes, kNodesAndPixels };

/// Disparities among which the second-best one is searched.
enum class RunnerUp { kAny, kExpected };

/// What the pairs of a stream so far decide.
enum class Temporal { kOff, kHold, kFilter };

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
  static constexpr std::array<std::string_view, kModes> kWords = {"sparse", "semi-dense", "dense",
                                                                  "full"};
};

template <>
struct ChoiceOf<Resolution> {
  static constexpr Parameter kParameter = Parameter::kResolution;
  static constexpr std::array<std::string_view, 4> kWords = {"full", "half-refined", "half",
                                                             "auto"};
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
struct ChoiceOf<RunnerUp> {
  static constexpr Parameter kParameter = Parameter::kRunnerUp;
  static constexpr std::array<std::string_view, 2> kWords = {"any", "expected"};
};

template <>
struct ChoiceOf<Temporal> {
  static constexpr Parameter kParameter = Parameter::kTemporal;
  static constexpr std::array<std::string_view, 3> kWords = {"off", "hold", "filter"};
};

/// The enums of all choices.
using Choices = std::tuple<Preset, Mode, Resolution, Cost, CostVolumeResolution, OutlierRemoval,
                           RunnerUp, Temporal>;

/// The effective value of a choice.
template <typename Enum>
Enum choice(const Parameters& parameters) {
  return static_cast<Enum>(parameters.integer(ChoiceOf<Enum>::kParameter));
}

}  // namespace mtstereo

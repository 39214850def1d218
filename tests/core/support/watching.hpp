// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "matcher/frame_matcher.hpp"
#include "support/matching.hpp"
#include "support/plane.hpp"

namespace mtstereo::test {

/// The disparity map after a step; empty if no step has written one yet.
inline DisparityView map_after(const Step& step, const FrameMemory& memory) {
  static constexpr std::string_view kBefore[] = {
      "time-filter",   "row-alignment",    "sharpness",      "view-shift",
      "halving",       "block-borders",    "contrast",       "noise-filter",
      "census",        "preprocessing",    "max-trees",      "cost-volume",
      "node-matching", "reduced-matching", "search-windows", "gray-balance"};
  if (std::count(std::begin(kBefore), std::end(kBefore), step.name) > 0) return {};
  return memory.result.disparity->view();
}

/// The map after each step that ran, if there is one, and the result.
using StepMaps = std::vector<std::pair<std::string, DisparityPlane>>;

inline StepMaps maps_after_steps(FrameMatcher& matcher, const GrayPlane& left,
                                 const GrayPlane& right) {
  StepMaps maps;
  const auto copy = [&](const Step& step, const FrameMemory& memory) {
    const DisparityView map = map_after(step, memory);
    if (map.width > 0) maps.emplace_back(step.name, copy_of(map));
  };
  const FrameResult result = matcher.compute(left.view(), right.view(), copy);
  maps.emplace_back("result", copy_of(result.disparity));
  return maps;
}

inline StepMaps maps_after_steps(const Parameters& parameters, const GrayPlane& left,
                                 const GrayPlane& right) {
  FrameMatcher matcher{Settings(parameters)};
  return maps_after_steps(matcher, left, right);
}

/// The names of the steps that run with these parameters.
inline std::vector<std::string> names_of_steps(const Parameters& parameters) {
  const Settings settings(parameters);
  std::vector<std::string> names;
  for_each_step(settings, [&](const Step& step) { names.emplace_back(step.name); });
  return names;
}

}  // namespace mtstereo::test

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>

#include "matcher/step.hpp"

namespace mtstereo {

/// The steps of the method, in the order in which they run: the views, one of the two matchers,
/// after the matching along paths the result, and the size of the map. The order is fixed; settings
/// select the matcher and disable steps. Everything that depends on the order of the method reads
/// these lists: the matcher, the benchmark, the images of docs/ and the tests.
using StepList = std::span<const Step>;
extern const StepList kViewSteps, kPathSteps, kNodeSteps, kResultSteps, kSizeSteps;

/// The lists that run with these settings; the last one may be empty.
inline std::array<StepList, 4> lists_of(const Settings& settings) {
  if (settings.by_paths()) return {kViewSteps, kPathSteps, kResultSteps, kSizeSteps};
  return {kViewSteps, kNodeSteps, kSizeSteps, {}};
}

/// Calls body(step) for the steps that run with these settings.
template <typename Body>
void for_each_step(const Settings& settings, Body&& body) {
  for (const StepList& list : lists_of(settings)) {
    for (const Step& step : list) {
      if (step.runs(settings)) body(step);
    }
  }
}

}  // namespace mtstereo

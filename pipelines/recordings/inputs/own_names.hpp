// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string_view>

namespace mtstereo::run {

/// The report of a run in its folder of results, and the tasks in the folder of a plan. A folder
/// with one of them is not a recording.
inline constexpr const char* kRunFile = "run.json";
inline constexpr const char* kPlanFile = "plan.json";

/// The results beside kRunFile, without extensions. They are not views, also if the folder of the
/// results is that of the recording.
inline constexpr std::array<std::string_view, 7> kResultNames{
    "disparity", "depth", "color", "confidence", "clouds", "rectified-left", "rectified-right"};

}  // namespace mtstereo::run

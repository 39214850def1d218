// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace mtstereo::run {

/// The report of a run in its folder of results, and the tasks in the folder of a plan. A folder
/// with one of them is not a recording.
inline constexpr const char* kRunFile = "run.json";
inline constexpr const char* kPlanFile = "plan.json";

}  // namespace mtstereo::run

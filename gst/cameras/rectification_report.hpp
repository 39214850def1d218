// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <string>
#include <vector>

#include "cameras/rectification_plan.hpp"

namespace mtstereo::plugin {

/// Logs what the rectified pair can measure and what is unusual about it, and posts as warnings
/// what the user must know. `posted`: the warnings of the last call, which are not posted again.
void report_rectification(GstElement* element, GstDebugCategory* category,
                          const RectificationPlan& plan, std::vector<std::string>& posted);

}  // namespace mtstereo::plugin

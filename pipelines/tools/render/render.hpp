// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/settings.hpp"

namespace mtstereo::render {

/// The first invalid setting with its value and range as a sentence; empty if all are valid.
std::string check(const Settings& settings);

/// The settings with the scene's focal length and baseline in place of zeros.
Settings complete(const Scene& scene, Settings settings);

/// Renders the scene at a time [s]. The result depends only on the arguments, not on the number of
/// threads. Throws std::invalid_argument with the sentence of check().
StereoFrame render(const Scene& scene, double time, const Settings& settings);

/// Only the left or the right image of render(), for clips whose cameras are not triggered
/// together. The noise is that of the same time and view in render().
cv::Mat render_view(const Scene& scene, double time, const Settings& settings, bool right);

/// A rectified pair in the format of Middlebury's calib.txt; `disparities` is the search range
/// [px], which covers all disparities of the ground truth.
std::string calibration_text(const Rectification& rectification, int disparities);

}  // namespace mtstereo::render

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// Sets Work::geometry, from the calibration of the recording and the size of a view. Throws
/// UserError if the views cannot be rectified by it. For views that are rectified, a calibration
/// without a usable geometry is a remark, or a UserError if a product is in meters.
void find_geometry(Work& work);

/// The farthest points of clouds, unless --far is given [m]: where the disparity, after the
/// principal offset, is 4 px, so that one px more or less is about a quarter of the distance.
double default_far(double focal_length, double baseline);

/// What the cameras can measure in the range of disparities of the work, as rig_text() states it;
/// empty without a geometry.
std::string measures_text(const Work& work);

}  // namespace mtstereo::run

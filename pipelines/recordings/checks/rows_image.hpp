// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// Both views of a pair from the middle of a recording, side by side and rectified if a calibration
/// does that, before rows are corrected. Points that were found in both are connected by lines,
/// which are level if the rows agree. Empty if the pair cannot be decoded. Throws UserError.
cv::Mat draw_rows(const Work& work);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>

#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Finds Source::unused_bits of images by some of both views, the same for both unless one view has
/// 8 bits, and adds a remark if there are any, or if the values have a narrow range. Cameras of 10
/// or 12 bits store such images; as 16 bits they are nearly black.
void find_unused_bits(Recording& recording);

/// Adds a remark to two videos, or one with both views, of gray with 16 bits if they use few of the
/// values. `first`: the first frame of the left one in 8 bits; only a flat one makes it read again.
void note_narrow_video(Recording& recording, const cv::Mat& first);

}  // namespace mtstereo::run

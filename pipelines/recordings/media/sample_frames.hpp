// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "mtstereo/image.hpp"
#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// The first frame of a source in 8-bit gray. Throws UserError if there is none.
cv::Mat first_frame(const Source& source);

/// Some frames of a source in 8-bit gray, from its start to its end; of a video that cannot be
/// sought only the first one. Throws UserError if there is none.
std::vector<cv::Mat> sample_frames(const Source& source, int count);

/// An image in 8-bit gray as the library takes it; valid as long as the image.
inline GrayView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

/// An image of 16 bits whose values use all of them; any other image as it is.
cv::Mat without_unused_bits(const cv::Mat& image, int unused_bits);

}  // namespace mtstereo::run

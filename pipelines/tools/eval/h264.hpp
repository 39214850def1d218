// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace mtstereo::eval {

/// The reason why through_h264() cannot work on this machine, and what to install; none if it can.
std::optional<std::string> h264_obstacle();

/// An 8-bit gray image (CV_8UC1) after H.264 compression with this quantizer, 1 .. 50: the last of
/// three equal frames of a stream, so that it is predicted from others. The result depends on the
/// arguments and on the version of the encoder only. Throws UserError if a part is missing or the
/// encoder rejects the image.
cv::Mat through_h264(const cv::Mat& image, int quantizer);

}  // namespace mtstereo::eval

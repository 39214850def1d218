// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mtstereo::images {

/// The functions of OpenCV that the module provides.
struct Codecs {
  cv::Mat (*read)(const std::string& file, int flags);
  cv::Mat (*decode)(cv::InputArray bytes, int flags);
  bool (*encode)(const std::string& suffix, cv::InputArray image, std::vector<unsigned char>& bytes,
                 const std::vector<int>& options);
};

/// The name of the module's only symbol, a `Codecs`.
constexpr const char* kCodecs = "mtstereo_image_codecs";

}  // namespace mtstereo::images

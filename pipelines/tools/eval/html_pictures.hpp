// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "tools/eval/datasets.hpp"

namespace mtstereo::eval {

/// The largest width of a picture in the HTML report [px].
inline constexpr int kHtmlPictureWidth = 256;

/// The pictures of a result, as data URIs that a page contains; empty if they were not requested.
struct HtmlPictures {
  std::string left;
  std::string truth;       ///< as color_disparity()
  std::string disparity;   ///< the same
  std::string error;       ///< as color_error()
  std::string confidence;  ///< black = none, white = 255
};

/// The pictures of a disparity map (CV_32FC1 [px], NaN = none) and its confidence (CV_8UC1). Wide
/// pictures are scaled down.
HtmlPictures html_pictures(const LoadedPair& images, const cv::Mat& disparity,
                           const cv::Mat& confidence, int max_disparity);

/// A picture (CV_8UC1 or CV_8UC3) as a data URI, "data:image/jpeg;base64,...".
std::string data_uri(const cv::Mat& picture);

}  // namespace mtstereo::eval

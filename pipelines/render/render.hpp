// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "render/scene.hpp"

namespace mtstereo::render {

/// The stereo camera and its sensor. Both views have the same focal length and principal point (the
/// image center), and the right camera is shifted along x only: the pair is rectified.
struct Settings {
  int width = 640;         ///< [px]
  int height = 360;        ///< [px]
  double focal = 0;        ///< [px]; 0 = the scene's fraction of the width
  double baseline = 0;     ///< [m]; 0 = the scene's default
  double noise = 1.0;      ///< standard deviation of the sensor noise [gray values]
  double exposure = 1.0;   ///< brightness of the right image relative to the left
  std::uint32_t seed = 1;  ///< seed of the noise
  int samples = 2;         ///< anti-aliasing: samples x samples rays per pixel
  int threads = 0;         ///< 0 = one per processor
  bool color = false;      ///< three channels (blue, green, red) instead of gray
};

/// The first invalid setting with its value and range as a sentence; empty if all are valid.
std::string check(const Settings& settings);

/// The settings with the scene's focal length and baseline in place of zeros.
Settings complete(const Scene& scene, Settings settings);

/// The images and the ground truth of a scene at one time.
struct StereoFrame {
  cv::Mat left;      ///< CV_8UC1, or CV_8UC3 with Settings::color
  cv::Mat right;     ///< the same
  cv::Mat truth;     ///< CV_32FC1: disparity of the left view at the pixel's center [px], infinity
                     ///< where the ray hits nothing (the sky)
  cv::Mat occluded;  ///< CV_8UC1: 255 where the point is hidden from the right camera
};

/// Renders the scene at a time [s]. The result depends only on the arguments, not on the number of
/// threads. Throws std::invalid_argument with the sentence of check().
StereoFrame render(const Scene& scene, double time, const Settings& settings);

/// The camera of the settings in the format of Middlebury's calib.txt; `disparities` is the search
/// range [px], which covers all disparities of the ground truth.
std::string calibration_text(const Settings& completed, int disparities);

}  // namespace mtstereo::render

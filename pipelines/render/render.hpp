// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "render/scene.hpp"

namespace mtstereo::render {

/// The stereo camera and its sensor. Both views share focal length and principal point (the
/// middle of the image), and the right camera is moved along x only: the pair is rectified.
struct Settings {
  int width = 640;         ///< [px]
  int height = 360;        ///< [px]
  double focal = 0;        ///< [px]; 0 = the scene's share of the width
  double baseline = 0;     ///< [m]; 0 = the scene's
  double noise = 1.0;      ///< standard deviation of the sensor's noise [gray values]
  double exposure = 1.0;   ///< brightness of the right image relative to the left
  std::uint32_t seed = 1;  ///< of the noise
  int samples = 2;         ///< samples x samples rays a pixel against aliasing
  int threads = 0;         ///< 0 = as many as there are processors
  bool color = false;      ///< three channels (blue, green, red) instead of gray
};

/// What is wrong with the settings, naming the value and the range; empty when nothing is.
std::string check(const Settings& settings);

/// The settings with the scene's focal length and baseline where none was given.
Settings complete(const Scene& scene, Settings settings);

/// One moment of a scene.
struct StereoFrame {
  cv::Mat left;      ///< CV_8UC1, or CV_8UC3 with Settings::color
  cv::Mat right;     ///< the same
  cv::Mat truth;     ///< CV_32FC1: disparity of the left view at the pixel's center [px], infinity
                     ///< where the ray meets nothing (the sky)
  cv::Mat occluded;  ///< CV_8UC1: 255 where the right camera does not see what the left one sees
};

/// Renders the scene at a time [s]. The result depends on the arguments only, not on the number of
/// threads. Throws std::invalid_argument with check()'s sentence.
StereoFrame render(const Scene& scene, double time, const Settings& settings);

/// The settings' camera as Middlebury's calib.txt describes it; `disparities` is the search range
/// [px] that holds every disparity of the ground truth.
std::string calibration_text(const Settings& completed, int disparities);

}  // namespace mtstereo::render

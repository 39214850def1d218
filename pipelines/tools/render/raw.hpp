// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mtstereo/geometry/calibration.hpp"
#include "tools/render/rig.hpp"
#include "tools/render/scene.hpp"
#include "tools/render/settings.hpp"

namespace mtstereo::render {

/// Two raw cameras: lenses with distortion, and any rotation and translation between them. The left
/// one is at the place of the scene's left camera.
struct RawRig {
  /// Throws std::invalid_argument, naming the camera and the setting, if the calibration is invalid
  /// or a lens cannot be inverted.
  explicit RawRig(const StereoCalibration& calibration);

  StereoCalibration calibration;  ///< what the cameras were made from
  Camera left;                    ///< the left camera
  Camera right;                   ///< the right camera
};

/// The cameras of render() as a calibration, with the errors of Settings::rig and with the
/// rectification of rectification_of(). The settings are those of complete().
StereoCalibration calibration_of(const Settings& settings);

/// Both raw views.
struct RawFrame {
  cv::Mat left;   ///< CV_8UC1, or CV_8UC3 with Settings::color
  cv::Mat right;  ///< the same, with its own size
};

/// Renders the raw views of the scene at a time [s]. Size, focal length, baseline and rig of the
/// settings are not used. Throws std::invalid_argument as render() does.
RawFrame render_raw(const Scene& scene, double time, const Settings& settings, const RawRig& rig);

/// The ground truth of a rectified pair.
struct Truth {
  cv::Mat disparity;  ///< CV_32FC1: disparity of the left view at the pixel's center [px], infinity
                      ///< where the ray hits nothing
  cv::Mat depth;      ///< CV_32FC1: along the axis of the rectified left camera [m], or infinity
  cv::Mat occluded;   ///< CV_8UC1: 255 where the point is hidden from the right camera
};

/// The exact ground truth of a rectified pair, at any rectification of the cameras.
Truth render_truth(const Scene& scene, double time, const Settings& settings,
                   const Rectification& rectification);

/// The pair that two ideal cameras would see whose views need no rectification, with its truth.
StereoFrame render_rectified(const Scene& scene, double time, const Settings& settings,
                             const Rectification& rectification);

/// The names for built_in_rig().
const std::vector<std::string>& rig_names();

/// A built-in pair of raw cameras with the size and the baseline of the completed settings.
/// `wide`: barrel distortion and 70 degrees across. `fisheye`: equidistant, 120 degrees across. In
/// both, focal lengths and principal points differ, and the right camera is turned by 1 to 2
/// degrees. Throws std::invalid_argument for any other name.
StereoCalibration built_in_rig(std::string_view name, const Settings& settings);

}  // namespace mtstereo::render

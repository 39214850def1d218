// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace mtstereo::render {

/// The error of the right camera in a rig that is out of line. The camera's position is exact. The
/// defaults are a rectified pair.
struct Rig {
  double roll = 0;         ///< clockwise, seen from behind the camera [degrees]
  double pitch = 0;        ///< downwards [degrees]
  double yaw = 0;          ///< to the right [degrees]
  double focal_ratio = 1;  ///< focal length of the right camera relative to the left
  double row_offset = 0;   ///< the right image is lower by this [px]

  /// Whether the pair is rectified.
  bool aligned() const {
    return roll == 0 && pitch == 0 && yaw == 0 && focal_ratio == 1 && row_offset == 0;
  }
};

/// The stereo camera and its sensors. Both views have the same focal length and principal point
/// (the image center), and the right camera is shifted along x only: the pair is rectified, unless
/// `rig` has errors.
struct Settings {
  int width = 640;        ///< [px]
  int height = 360;       ///< [px]
  double focal = 0;       ///< [px]; 0 = the scene's fraction of the width
  double baseline = 0;    ///< [m]; 0 = the scene's default
  double noise = 1.0;     ///< standard deviation of the constant (read) noise [gray values]
  double shot_noise = 0;  ///< variance of the shot noise per gray value of the signal [gray values]
  double light = 1;       ///< light (aperture, exposure time) of both views; values above 255 clip
  double gain = 1;        ///< amplification of signal and noise in both views; clips too
  double exposure = 1.0;  ///< brightness of the right image relative to the left
  double vignette = 0;    ///< fraction of the light that is lost in the corners
  double blur = 0;        ///< standard deviation of the lens's blur, a Gaussian, in the center [px]
  double rim_blur = 0;    ///< what it gains up to the corners [px]
  bool mosaic = false;    ///< one color per pixel, and the processing of a camera that has this
  int jpeg = 0;           ///< quality of JPEG compression, 1 to 100; 0 = no compression
  Rig rig;                ///< errors of the right camera
  std::uint32_t seed = 1;  ///< seed of the noise
  int samples = 2;         ///< anti-aliasing: samples x samples rays per pixel
  int threads = 0;         ///< 0 = one per processor
  bool color = false;      ///< three channels (blue, green, red) instead of gray
};

/// The images and the ground truth of a scene at one time. Truth and occlusion are those of the
/// rectified pair: errors of the rig change only the right image, and right_pixel() states how.
struct StereoFrame {
  cv::Mat left;      ///< CV_8UC1, or CV_8UC3 with Settings::color
  cv::Mat right;     ///< the same
  cv::Mat truth;     ///< CV_32FC1: disparity of the left view at the pixel's center [px], infinity
                     ///< where the ray hits nothing (the sky)
  cv::Mat occluded;  ///< CV_8UC1: 255 where the point is hidden from the right camera
};

}  // namespace mtstereo::render

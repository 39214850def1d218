// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace mtstereo::eval {

/// The true disparity of the left image.
struct GroundTruth {
  cv::Mat disparity;  ///< CV_32FC1 [px], NaN = unknown
  cv::Mat visible;    ///< CV_8UC1, nonzero = visible in both views; empty if unknown
  /// px of these maps per px of the original ones, for images that were enlarged: all errors are
  /// measured in px of the original
  double scale = 1;
};

/// A camera of the TrimBot2020 gardens, read from its *_cam.txt.
struct Camera {
  double focal_length = 0;  ///< horizontal [px]
  double principal_x = 0;   ///< column of the principal point [px]
  cv::Vec3d center;         ///< optical center, in the unit of the depth map
};

/// The meaning of the values in a *_dmap.bin.
enum class DmapMeaning {
  kAuto,       ///< depth if the *_cam.txt of both cameras exist, else disparity
  kDepth,      ///< distance along the optical axis, in the unit of the cameras' positions
  kDisparity,  ///< disparity [px]
};

/// Values from this on in a *_dmap.bin mean that the ray hit nothing (the sky).
inline constexpr float kDmapNothingHit = 100000;

/// Disparity from a PFM. Values that are not finite are unknown. Negative values are unknown too,
/// unless no value is positive: then the map has the opposite sign and is negated.
cv::Mat read_pfm_disparity(const std::filesystem::path& file);

/// Disparity from a PNG, 0 = unknown: px = value / 256 in 16 bit (as KITTI stores it), px = value
/// in 8 bit.
cv::Mat read_png_disparity(const std::filesystem::path& file);

/// Disparity from an RGB image of Sintel, 0 = unknown: px = 4 red + green / 64 + blue / 16384.
cv::Mat read_sintel_disparity(const std::filesystem::path& file);

/// Disparity from a PNG with 16-bit depths, 0 and 65535 = unknown: px = product / value.
cv::Mat read_png_depth(const std::filesystem::path& file, double product);

/// The values of a *_dmap.bin, which has no header: big-endian 32-bit floats, column by column.
/// Values that are not finite, not positive or at least kDmapNothingHit are unknown (NaN).
cv::Mat read_dmap(const std::filesystem::path& file, cv::Size size);

/// A camera from the numbers fx fy cx cy qw qx qy qz tx ty tz, world to camera.
Camera read_camera(const std::filesystem::path& file);

/// disparity = f * baseline / depth + (left - right principal point); negative results are unknown.
/// Throws UserError if the cameras have the same optical center.
cv::Mat depth_to_disparity(const cv::Mat& depth, const Camera& left, const Camera& right);

/// Reads an image of any depth and number of channels as 8-bit gray (BT.601 luma; alpha ignored,
/// 16 bit scaled to 8).
cv::Mat read_gray(const std::filesystem::path& file);

/// A mask as in Middlebury: 255 (visible in both views) stays 255, all other values become 0.
cv::Mat read_visible_mask(const std::filesystem::path& file);

/// Throws UserError, naming the file, unless its map has the size of the image. The message ends
/// with the advice.
void require_size(const std::filesystem::path& file, const cv::Mat& map, cv::Size image,
                  const std::string& advice = {});

// All of these throw UserError, naming the file, if the file cannot be used.

}  // namespace mtstereo::eval

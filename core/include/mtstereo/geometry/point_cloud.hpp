// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mtstereo/export.hpp"
#include "mtstereo/geometry/depth.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/result.hpp"

// From a disparity map to points, and to files of points.

namespace mtstereo {

/// A point of the scene in the axes of the rectified left camera: x to the right, y downwards, z
/// forward.
struct CloudPoint {
  float x = 0;                  ///< [m]
  float y = 0;                  ///< [m]
  float z = 0;                  ///< [m]
  std::uint8_t red = 0;         ///< of the left view; gray views have three equal values
  std::uint8_t green = 0;       ///< of the left view
  std::uint8_t blue = 0;        ///< of the left view
  std::uint8_t confidence = 0;  ///< 0 .. 255; 255 without a confidence map
  /// True if all values are equal.
  friend bool operator==(const CloudPoint&, const CloudPoint&) = default;
};

/// The images that a cloud is made of; all have the same size.
struct CloudInput {
  ImageView<const std::uint16_t> disparity;  ///< the map, 0 = no disparity
  /// The left view; may have no data: points are white. Its width counts pixels, its stride bytes.
  ImageView<const std::uint8_t> color{};
  int color_channels = 1;                      ///< 1 (gray) or 3 (red, green, blue), interleaved
  ImageView<const std::uint8_t> confidence{};  ///< may have no data
};

/// Which points a cloud has.
struct CloudOptions {
  double near = 0;                                       ///< nearer points are left out [m]
  double far = std::numeric_limits<double>::infinity();  ///< farther points are left out [m]
  int min_confidence = 0;                                ///< less certain points are left out
  int step = 1;  ///< every n-th pixel of every n-th row, from the first one
};

/// Computes the points of all pixels with a disparity whose depth is finite and in the range, row
/// by row. `points` is replaced; a vector that is reused allocates only while it grows. Fails with
/// kInvalidImage, kSizeMismatch, kInvalidCalibration or kInvalidParameter.
MTSTEREO_API Status make_cloud(const CloudInput& input, const DepthGeometry& geometry,
                               const CloudOptions& options,
                               std::vector<CloudPoint>& points) noexcept;

/// A format of a file of points. Both are binary and little-endian.
enum class CloudFormat {
  kPly,  ///< x, y, z, red, green, blue, confidence
  kPcd,  ///< x, y, z, rgb (PCL's packed float), confidence
};

/// Writes points to a file. The header states the unit and the axes. The file is written aside and
/// renamed, so that a reader never finds half of it and an existing file is kept if writing fails.
/// Fails with kSystem, and a message that names the file and the reason. Of what exists under the
/// name, only an empty file and one of this function are replaced.
MTSTEREO_API Status write_cloud(const std::vector<CloudPoint>& points, CloudFormat format,
                                const std::string& path) noexcept;

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <string>
#include <vector>

#include "cloud/left_frames.hpp"
#include "mtstereo/geometry/point_cloud.hpp"

namespace mtstereo::plugin {

/// Turns frames into points, and writes them to a file.
class CloudWriter {
 public:
  /// Computes the points of a disparity map. `left`: nullptr without a left view. Posts an error of
  /// `element` and returns false if a frame does not fit.
  bool make(gpointer element, GstBuffer* map, const GstVideoInfo& info, const LeftFrame* left,
            const DepthGeometry& geometry, const CloudOptions& options);
  /// Writes them. Posts an error of `element` and returns false on failure.
  bool write(gpointer element, CloudFormat format, const std::string& path) const;
  std::size_t points() const { return points_.size(); }
  /// Frees the memory.
  void clear();

 private:
  ImageView<const std::uint16_t> values(ImageView<std::uint16_t> image);

  std::vector<CloudPoint> points_;
  std::vector<std::uint16_t> values_;  ///< of maps that the library cannot read in place
};

}  // namespace mtstereo::plugin

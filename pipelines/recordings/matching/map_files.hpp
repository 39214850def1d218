// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <limits>
#include <optional>

#include "mtstereo/geometry/depth.hpp"
#include "recordings/matching/piece.hpp"
#include "recordings/media/gst_objects.hpp"
#include "shared/geometry_properties.hpp"

// Files of one pair each, and the figures of a map.

namespace mtstereo::run {

/// The share of pixels with a disparity, and their median.
void measure_map(GstSample* map, FrameFigures& figures);

/// The share of the pixels with a disparity that have at least this one [0 .. 1].
double share_from(GstSample* map, double disparity);

/// The disparity [px] that a share of the known disparities of a map does not exceed: of those with
/// at least this confidence, if the map has one. 0 without any.
double disparity_below(GstSample* map, double share, int least_confidence = 0);

/// The share of the matched disparities that are wrong by the odds that their confidence states, as
/// it does with cost=census [0 .. 1]. None for a map without any.
std::optional<double> stated_errors(GstSample* map);

/// What turns the disparities of maps into depths: from their caps, or from the calibration of a
/// recording whose views are rectified.
class MapGeometry {
 public:
  explicit MapGeometry(const Recording& recording);
  /// Throws UserError if it is not known.
  DepthGeometry of(GstSample* map);

 private:
  plugin::GeometryProperties properties_;
  plugin::GeometrySource source_;
};

/// Depths outside of them are left out [m].
struct DepthLimits {
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
};

/// Writes a frame (gray with 8 or 16 bits, or BGR) as PNG. Throws UserError.
void write_png(GstSample* frame, const std::filesystem::path& file);

/// Writes the disparities of a map as floating-point numbers [px]; infinity = none. Throws
/// UserError.
void write_disparity_pfm(GstSample* map, const std::filesystem::path& file);

/// Writes the depths of a disparity map in a range as floating-point numbers [m]; infinity = none.
/// Throws UserError.
void write_depth_pfm(GstSample* map, const DepthGeometry& geometry, DepthLimits limits,
                     const std::filesystem::path& file);

/// Writes the points of a map in a range of depths, with the colors of its left view (RGB), as PLY.
/// Throws UserError.
void write_points(GstSample* map, GstSample* view, const DepthGeometry& geometry,
                  DepthLimits limits, const std::filesystem::path& file);

}  // namespace mtstereo::run

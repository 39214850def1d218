// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>
#include <string>

#include "mtstereo/geometry/calibration.hpp"
#include "mtstereo/geometry/rectification.hpp"

// The geometry of a rectified pair in caps. mtrectify sets the fields, mtstereo copies those of the
// left stream to its output, and the elements downstream of it read them. The names are part of the
// public interface.

namespace mtstereo::plugin {

inline constexpr const char* kFocalLengthField = "focal-length";          ///< double [px]
inline constexpr const char* kBaselineField = "baseline";                 ///< double [m]
inline constexpr const char* kPrincipalOffsetField = "principal-offset";  ///< double [px]
inline constexpr const char* kPrincipalXField = "principal-x";            ///< double [px]
inline constexpr const char* kPrincipalYField = "principal-y";            ///< double [px]
/// Array of four integers: x, y, width, height of the largest rectangle without a border [px].
inline constexpr const char* kValidRegionField = "valid-region";

/// Of a rectified view only, not of a map: "left" or "right".
inline constexpr const char* kCameraField = "camera";

/// The fields in that order but for the camera, for copying them.
inline constexpr const char* kGeometryFields[] = {
    kFocalLengthField, kBaselineField,   kPrincipalOffsetField,
    kPrincipalXField,  kPrincipalYField, kValidRegionField,
};

/// The geometry of a rectified pair.
struct StereoGeometry {
  double focal_length = 0;      ///< [px]
  double baseline = 0;          ///< [m]
  double principal_offset = 0;  ///< to add to a disparity before it becomes a depth [px]
  double principal_x = 0;       ///< of the left view [px]
  double principal_y = 0;       ///< of the left view [px]
  std::optional<PixelRectangle> valid_region;  ///< of the view that has the caps
};

/// The geometry in the fields of caps; std::nullopt without a focal length and a baseline, or if
/// one of them is not positive and finite. An absent principal offset is 0, an absent principal
/// point is the center of the image.
std::optional<StereoGeometry> read_geometry(const GstStructure* fields);

/// True if both views belong to one rectified pair: focal length, baseline and principal offset are
/// equal but for rounding.
bool same_rectification(const StereoGeometry& first, const StereoGeometry& second);

/// If the valid region exceeds a frame of this size, so that the geometry is that of a larger one:
/// both sizes as text. Otherwise "".
std::string larger_frame(const StereoGeometry& geometry, int width, int height);

/// Sets the fields.
void write_geometry(GstStructure* fields, const StereoGeometry& geometry);

/// Copies the fields that `from` has and removes the others from `to`.
void copy_geometry_fields(const GstStructure* from, GstStructure* to);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <optional>

// The unit of a disparity map. The caps have the same fields, but some elements and applications
// drop them. It is a custom meta of the buffer, so that applications read it with GStreamer alone.

namespace mtstereo::plugin {

/// The name of the meta for gst_buffer_get_custom_meta(). It is part of the public interface, as
/// are the names of the fields of its structure, which are those of the caps.
inline constexpr const char* kDisparityMeta = "MtStereoDisparityMeta";
inline constexpr const char* kScaleField = "disparity-scale";
inline constexpr const char* kMaxDisparityField = "max-disparity";
inline constexpr const char* kMinDisparityField = "min-disparity";
inline constexpr const char* kOffsetField = "disparity-offset";

/// The unit and the range of a disparity map: disparity [px] = value / scale + offset.
struct DisparityUnit {
  int scale = 0;          ///< [steps per px], 1 .. 65535
  int max_disparity = 0;  ///< [px], more than min_disparity and offset
  int min_disparity = 0;  ///< [px]
  int offset = 0;         ///< [px]
  bool operator==(const DisparityUnit&) const = default;
};

/// Registers the meta with GStreamer; further calls have no effect. False if another type of meta
/// has the name. Any thread.
bool register_disparity_meta();

/// Attaches the unit to a writable disparity map; replaces an existing one.
void set_disparity_unit(GstBuffer* disparity, const DisparityUnit& unit);

/// The unit in the fields of caps or of a meta: the smallest disparity and the offset are 0 if they
/// are absent. std::nullopt without a scale and a range, or if a value is not valid.
std::optional<DisparityUnit> read_disparity_unit(const GstStructure* fields);

/// The unit of a disparity map; std::nullopt if it has none, or one that is not valid.
std::optional<DisparityUnit> disparity_unit_of(GstBuffer* disparity);

}  // namespace mtstereo::plugin

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

/// The unit and the range of a disparity map.
struct DisparityUnit {
  int scale = 0;          ///< [steps per px], 1 .. 65535
  int max_disparity = 0;  ///< [px], at least 1
  bool operator==(const DisparityUnit&) const = default;
};

/// Registers the meta with GStreamer; further calls have no effect. False if another type of meta
/// has the name. Any thread.
bool register_disparity_meta();

/// Attaches the unit to a writable disparity map; replaces an existing one.
void set_disparity_unit(GstBuffer* disparity, const DisparityUnit& unit);

/// The unit of a disparity map; std::nullopt if it has none, or one that is not valid.
std::optional<DisparityUnit> disparity_unit_of(GstBuffer* disparity);

}  // namespace mtstereo::plugin

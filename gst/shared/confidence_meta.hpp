// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <string>

#include "shared/ownership.hpp"

// The confidence map of a disparity map. It is a custom meta of the buffer, so that applications
// read it with GStreamer alone.

namespace mtstereo::plugin {

/// The name of the meta for gst_buffer_get_custom_meta(). It is part of the public interface.
inline constexpr const char* kConfidenceMeta = "MtStereoConfidenceMeta";
/// The field of its structure: a GstSample with a GRAY8 frame and its caps.
inline constexpr const char* kConfidenceField = "confidence";

/// Registers the meta with GStreamer; further calls have no effect. False if another type of meta
/// has the name. Any thread.
bool register_confidence_meta();

/// Attaches a confidence map to a writable disparity map; replaces an existing one.
void set_confidence(GstBuffer* disparity, GstSample* confidence);

/// The confidence map of a disparity map, or NULL if it has none. The buffer owns it.
GstSample* confidence_of(GstBuffer* disparity);

/// Why a confidence map does not match a disparity map; "" if it does. Sets the video info of the
/// confidence map.
std::string confidence_problem(GstSample* confidence, const GstVideoInfo& disparity,
                               GstVideoInfo& info);

}  // namespace mtstereo::plugin

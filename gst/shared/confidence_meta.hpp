// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include "shared/ownership.hpp"

// The confidence map that a disparity map carries: a custom meta, so that a program reads it with
// GStreamer alone.

namespace mtstereo::plugin {

/// The meta's name for gst_buffer_get_custom_meta().
inline constexpr const char* kConfidenceMeta = "MtStereoConfidenceMeta";
/// The field of its structure: a GstSample, a GRAY8 frame with its caps.
inline constexpr const char* kConfidenceField = "confidence";

/// Makes the meta known to GStreamer; more calls do nothing. False where it cannot be. Any thread.
bool register_confidence_meta();

/// True for a meta that tells of a frame's memory or of what its pixels mean: colors, confidence.
/// It is not true of another frame that is made of this one.
bool belongs_to_pixels(const GstMetaInfo& info);

/// Gives a writable disparity map its confidence map, in place of one that it may have.
void set_confidence(GstBuffer* disparity, GstSample* confidence);

/// The confidence map of a disparity map, NULL where it has none. It stays the buffer's.
GstSample* confidence_of(GstBuffer* disparity);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <optional>

namespace mtstereo::run {

/// The last segment that went through a pad; none before the first one.
std::optional<GstSegment> segment_on(GstPad* pad);

/// Moves the time of a frame to where a sink would show it: clipped to the segment, as the base
/// class of the decoders does. False if it is outside.
bool clip(const GstSegment& segment, GstClockTime duration, GstClockTime& time);

}  // namespace mtstereo::run

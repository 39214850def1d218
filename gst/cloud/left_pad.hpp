// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include "cloud/left_frames.hpp"
#include "shared/caps.hpp"

namespace mtstereo::plugin {

/// The name of the pad.
inline constexpr const char* kLeftPad = "sink_left";

/// Caps of the left view, as text.
inline constexpr const char* kLeftCaps =
    "video/x-raw, format = (string) { RGB, GRAY8 }, " MTSTEREO_SIZE_CAPS;

/// The stream on the pad of the left view.
struct LeftStream {
  LeftFrames frames;  ///< any thread

  // Used by the streaming thread of the pad.
  GstVideoInfo info{};
  bool has_caps = false;
  GstSegment segment{};
};

/// Adds the pad to a new element of a class with a template of this name. `stream` lives as long as
/// the element.
GstPad* add_left_pad(GstElement* element, LeftStream& stream);

}  // namespace mtstereo::plugin

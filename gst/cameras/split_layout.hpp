// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <string>

#include "shared/ownership.hpp"

// Sizes, formats and caps of whole frames and their halves.

namespace mtstereo::plugin {

/// How both views are in a frame. The values are the property's.
enum class SplitLayout : int { kSideBySide, kTopBottom };

/// The formats whose frames can be split without a copy, as text for caps: a pixel is at a whole
/// byte, in memory of rows.
std::string split_formats();

/// Why frames cannot be split, as a sentence with a remedy; "" if they can.
std::string split_problem(const GstVideoInfo& whole, SplitLayout layout);

/// What the stream says of its views if that is not what is split, as a sentence with a remedy; ""
/// if it says the same, or nothing. A stream may be wrong about itself.
std::string layout_contradiction(const GstVideoInfo& whole, SplitLayout layout, bool swap);

/// The caps of one half. `caps` may be anything that a query has; structures of sizes that cannot
/// be split are removed.
CapsPointer half_caps(const GstCaps* caps, SplitLayout layout);

/// The caps of whole frames for those of one half.
CapsPointer whole_caps(const GstCaps* half, SplitLayout layout);

/// The position of a half in the frame [px].
struct HalfPosition {
  int x = 0;
  int y = 0;
};
HalfPosition second_half(const GstVideoInfo& whole, SplitLayout layout);

}  // namespace mtstereo::plugin

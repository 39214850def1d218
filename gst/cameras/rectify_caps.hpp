// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "cameras/rectification_plan.hpp"
#include "shared/ownership.hpp"

// The caps of the pads of an mtrectify.

namespace mtstereo::plugin {

/// The packed formats of 8 bits per channel that are rectified in color, and GRAY8, as text.
inline constexpr const char* kColorFormats =
    "{ GRAY8, RGB, BGR, RGBx, BGRx, xRGB, xBGR, RGBA, BGRA, ARGB, ABGR }";

/// The caps of the source pad for those of the sink pad.
CapsPointer rectified_caps(const GstCaps* sink, const RectifySettings& settings);

/// The caps of the sink pad for those of the source pad. `preferred`: the size of the calibration.
CapsPointer unrectified_caps(const GstCaps* source, const RectifySettings& settings,
                             const std::optional<FrameSize>& preferred);

/// True if frames with these caps can be rectified in color.
bool has_color_format(const GstCaps* caps);

/// The first structure of `caps` with the size that is nearest to this one, all else fixed too.
CapsPointer fixed_caps(CapsPointer caps, FrameSize size);

/// The size in fixed caps.
FrameSize size_in(const GstCaps* caps);

/// Sets the geometry and the camera of the rectified view in fixed caps. `region`: the rectangle
/// without a border.
void write_plan(GstCaps* caps, const RectificationPlan& plan, PixelRectangle region);

}  // namespace mtstereo::plugin

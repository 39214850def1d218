// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/gstvideofilter.h>

#include "shared/caps.hpp"
#include "shared/frame_views.hpp"
#include "shared/ownership.hpp"

// The common part of the elements downstream of mtstereo: each one is a GstVideoFilter whose input
// is a disparity map.

namespace mtstereo::plugin {

/// Caps of a disparity map, as text: the output of mtstereo, with or without its own fields.
inline constexpr const char* kDisparityCaps =
    "video/x-raw, format = (string) GRAY16_LE, " MTSTEREO_SIZE_CAPS;

/// Caps of an image that is computed from such a map. `formats`: "RGB" or "{ RGB, BGR }".
#define MTSTEREO_IMAGE_CAPS(formats) \
  "video/x-raw, format = (string) " formats ", " MTSTEREO_SIZE_CAPS

/// The caps of the other pad if the filter turns a map into an image: size and framerate are kept,
/// the format is one of `other`, and the fields that define the meaning of a pixel are removed.
CapsPointer image_caps(const GstCaps* caps, const char* other);

/// Posts the error of a frame that cannot be mapped. `source`: where it comes from.
GstFlowReturn refuse_frame(GstVideoFilter* filter, const char* source, const MappedFrame& frame);

/// The transform() of a filter, instead of that of GstVideoFilter. The latter trusts a frame whose
/// meta contradicts its caps or its memory, and outputs an uninitialized frame if it cannot map
/// one; here both are stream errors. Calls transform_frame() of the class.
GstFlowReturn transform_checked(GstBaseTransform* transform, GstBuffer* in, GstBuffer* out);

}  // namespace mtstereo::plugin

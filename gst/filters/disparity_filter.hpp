// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/gstvideofilter.h>

#include "shared/ownership.hpp"

// What the filters behind mtstereo have in common: each is a GstVideoFilter that takes its
// disparity maps.

namespace mtstereo::plugin {

/// Caps of a disparity map, as text: what mtstereo gives, with or without its own fields.
inline constexpr const char* kDisparityCaps =
    "video/x-raw, format = (string) GRAY16_LE, width = (int) [ 1, max ], "
    "height = (int) [ 1, max ], framerate = (fraction) [ 0/1, max ]";

/// Caps of a picture of such a map. `formats`: "RGB" or "{ RGB, BGR }".
#define MTSTEREO_PICTURE_CAPS(formats)                      \
  "video/x-raw, format = (string) " formats                 \
  ", width = (int) [ 1, max ], height = (int) [ 1, max ], " \
  "framerate = (fraction) [ 0/1, max ]"

/// Adds a pad that is always there and takes or gives these caps.
void add_pad_template(GstElementClass* element_class, const char* name, GstPadDirection direction,
                      const char* caps);

/// The caps of the other pad where the filter makes a picture of the map: size and time stay, the
/// format is one of `other`, and what tells the meaning of a pixel is gone.
CapsPointer picture_caps(const GstCaps* caps, const char* other);

/// `caps` as far as the filter of a caps query lets them, in its order. NULL: there is none.
CapsPointer filtered_caps(CapsPointer caps, GstCaps* filter);

/// A transform() in place of GstVideoFilter's. That one trusts a frame whose meta contradicts its
/// caps or its memory, and passes on a frame without contents where it cannot map one: here both
/// are an error of the stream. Calls transform_frame(), from which no exception leaves.
GstFlowReturn transform_checked(GstBaseTransform* transform, GstBuffer* in, GstBuffer* out);

}  // namespace mtstereo::plugin

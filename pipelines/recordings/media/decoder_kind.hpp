// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::run {

/// Whether an element decodes video. The one for JPEG is a decoder of images.
bool is_video_decoder(GstElement* element);

/// Whether an element is a decoder of libav.
bool is_libav_decoder(GstElement* element);

/// Whether an element is the decoder of JPEG that does not report what its library reports.
bool is_jpeg_decoder(GstElement* element);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::run {

/// Whether an element decodes video. The one for JPEG is a decoder of images.
bool is_video_decoder(GstElement* element);

/// Whether an element is a decoder of libav.
bool is_libav_decoder(GstElement* element);

/// Sets a decoder so that pixels of which GStreamer has no format are an error. That of FFV1
/// crashes if it decodes them into buffers of GStreamer.
void keep_from_crashing(GstElement* decoder);

/// Whether an element is the decoder of JPEG that does not report what its library reports.
bool is_jpeg_decoder(GstElement* element);

}  // namespace mtstereo::run

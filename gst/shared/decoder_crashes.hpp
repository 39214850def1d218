// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// Sets an element so that pixels of which GStreamer has no format are an error. The decoder of
/// FFV1 crashes if it decodes them into buffers of GStreamer. Other elements stay as they are.
void keep_from_crashing(GstElement* element);

}  // namespace mtstereo::plugin

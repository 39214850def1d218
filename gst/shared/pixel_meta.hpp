// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

// What the custom metas of this plugin have in common: they describe the pixels of their buffer.

namespace mtstereo::plugin {

/// Registers a custom meta that elements which move, rotate or scale pixels do not copy. True also
/// if an application has registered a custom meta of this name. Any thread.
bool register_pixel_meta(const char* name, GstCustomMetaTransformFunction transform);

/// True if a transform of a buffer keeps the size and the position of each pixel: a copy of the
/// whole buffer, or a change of the format.
bool keeps_pixels(GQuark type, gpointer data);

}  // namespace mtstereo::plugin

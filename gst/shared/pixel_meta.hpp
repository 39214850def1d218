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

/// True for a meta that describes the memory of a frame or the meaning of its pixels (colors,
/// confidence, unit, border). Such a meta is invalid for another frame that is computed from this
/// one.
bool belongs_to_pixels(const GstMetaInfo& info);

}  // namespace mtstereo::plugin

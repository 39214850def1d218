// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// True for a meta that describes the memory of a frame or the meaning of its pixels (colors,
/// confidence, unit, border). Such a meta is invalid for another frame that is computed from this
/// one.
bool belongs_to_pixels(const GstMetaInfo& info);

}  // namespace mtstereo::plugin

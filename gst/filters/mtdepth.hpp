// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtdepth`, which turns a disparity map into a depth map.
GType gst_mtstereo_depth_get_type();

}  // namespace mtstereo::plugin

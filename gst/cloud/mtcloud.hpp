// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtcloud`, which writes disparity maps as files of points.
GType gst_mtstereo_cloud_get_type();

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtrectify`, which rectifies the video of one of two calibrated cameras.
GType gst_mtstereo_rectify_get_type();

}  // namespace mtstereo::plugin

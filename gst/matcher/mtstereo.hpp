// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtstereo`, which computes the disparity of two rectified streams.
GType gst_mtstereo_get_type();

}  // namespace mtstereo::plugin

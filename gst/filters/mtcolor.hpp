// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtcolor`, which turns a disparity map into a color image.
GType gst_mtstereo_color_get_type();

}  // namespace mtstereo::plugin

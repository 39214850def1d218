// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

/// The element `mtstereo`: two rectified streams in, disparity out.
GType mtstereo_element_get_type();

GST_DEBUG_CATEGORY_EXTERN(mtstereo_debug);

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

/// The element `mtconfidence`: disparity maps with their confidence in; the disparities that are
/// sure enough out, or the confidence as a picture.
GType mtconfidence_element_get_type();

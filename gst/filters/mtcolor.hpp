// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

/// The element `mtcolor`: a disparity map in, a color picture of it out.
GType mtcolor_element_get_type();

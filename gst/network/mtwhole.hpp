// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtwhole`, which drops encoded pictures that may be truncated.
GType gst_mtstereo_whole_get_type();

}  // namespace mtstereo::plugin

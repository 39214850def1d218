// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtsplit`, which splits the frames of a stereo camera into both views.
GType gst_mtstereo_split_get_type();

}  // namespace mtstereo::plugin

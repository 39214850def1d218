// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

namespace mtstereo::plugin {

/// The type of the element `mtconfidence`, which removes disparities of low confidence from a map
/// or outputs the confidence.
GType gst_mtstereo_confidence_get_type();

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include "mtstereo/geometry/depth.hpp"

namespace mtstereo::plugin {

/// The name of the element message of mtdepth. It is part of the public interface, as are the names
/// of its fields.
inline constexpr const char* kDepthMessage = "mtstereo-depth";

/// The typical error of a disparity [px]: the mean error of mode semi-dense on real pairs, see
/// docs/evaluation.md.
inline constexpr double kTypicalError = 0.3;

/// Posts which depths the element writes, and how uncertain the farthest ones are, as an element
/// message and as an information.
void report_depths(gpointer element, const DepthGeometry& geometry, const DepthOptions& options);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Attaches a confidence map to a disparity map whose pixels and times are set. False if there is
/// not enough memory; an error was posted then. Runs in the task of the source pad.
bool attach_confidence(ElementState& state, GstBuffer* output);

}  // namespace mtstereo::plugin

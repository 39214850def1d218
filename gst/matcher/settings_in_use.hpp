// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Applies the property values to the matcher if they, or the size of the left stream, have changed
/// since the last call. Runs in the task of the source pad, and at the start.
///
/// Values that do not fit each other, the frame size or downstream are not applied: if the last
/// ones fit, the properties return to these, and a warning is posted. Otherwise there is nothing to
/// match with: an error is posted, and false is returned.
bool apply_settings(ElementState& state);

}  // namespace mtstereo::plugin

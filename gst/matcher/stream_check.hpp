// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Checks that the streams whose caps are adopted can be matched. False if not; an error was posted
/// then. Warns if the caps state two rectifications. Runs in the task of the source pad.
bool check_streams(ElementState& state);

}  // namespace mtstereo::plugin

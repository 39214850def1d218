// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Matches a pair and pushes its disparity map. The caller keeps the buffers. Runs in the task of
/// the source pad.
GstFlowReturn match_pair(ElementState& state, GstBuffer* left, GstBuffer* right);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Adds the sink pads. A frame that arrives is dropped or refused there if it has no partner, and
/// replaces an older one if the property `newest-pair` asks for it, so that upstream is not
/// blocked.
void add_sink_pads(ElementState& state);

/// The state of the element that has a pad.
ElementState& state_of(gpointer element);

}  // namespace mtstereo::plugin

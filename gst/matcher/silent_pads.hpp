// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// What the watchdog of an element asks and calls: it reports a pad that is not linked, or on which
/// no frame arrives, while frames wait on the other pad. In live pipelines frames have a deadline,
/// so nothing is reported there, but that no frame has arrived on either pad since the start. Also
/// nothing is reported in PAUSED after preroll. A pipeline that does not start, because downstream
/// blocks the first map, is reported too.
Watchdog::Functions watch_pads(ElementState& state);

}  // namespace mtstereo::plugin

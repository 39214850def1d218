// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

// The way of the frames through the element: pairing, engine, output. All run in the task of the
// source pad.

namespace mtstereo::plugin {

/// Pairs the heads of the two streams, or drops one of them.
GstFlowReturn aggregate(ElementState& state, bool timeout);

/// The time until which a frame without a partner waits [running time]. The base class calls it
/// with its own lock held and adds the latency.
GstClockTime next_deadline(ElementState& state);

}  // namespace mtstereo::plugin

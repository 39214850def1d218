// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Handles an event of a sink pad and passes it to the base class where that needs it. Takes the
/// event. Runs in the task of the source pad for serialized events, as the base class calls it.
bool handle_sink_event(ElementState& state, GstAggregatorPad* pad, GstEvent* event);

/// Prepares for an event that has arrived on a sink pad and is queued after its frames. Any thread.
void before_sink_event(ElementState& state, GstAggregatorPad* pad, GstEvent* event);

/// Handles an event of the source pad and passes it upstream. Takes the event. QoS events are not
/// passed on if every pair must be matched, because sources would drop frames of one side only. Any
/// thread.
bool handle_source_event(ElementState& state, GstEvent* event);

}  // namespace mtstereo::plugin

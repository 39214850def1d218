// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

// All of it runs in the task of the source pad, except where a comment says otherwise.

/// The answer to a caps query on a sink pad: the accepted caps, best first. Any thread.
CapsPointer sink_caps(const ElementState& state, Side side, GstCaps* filter);
/// Accepts new caps of a stream. False if they are not supported; an error was posted then.
bool take_sink_caps(ElementState& state, Side side, const GstCaps* caps);
/// Negotiates the caps of the source pad. False on failure; an error was posted then, except if the
/// pad is flushing.
bool negotiate_output(ElementState& state);

}  // namespace mtstereo::plugin

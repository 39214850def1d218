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
/// The caps of the disparity map, from the left stream and the active settings.
CapsPointer output_caps(const ElementState& state);
/// Negotiates the caps of the source pad. False on failure; an error was posted then, except if the
/// pad is flushing.
bool negotiate_output(ElementState& state);
/// Copies the current property values and applies them to the matcher, together with the size of
/// the left stream. False if they are invalid; an error was posted then.
bool apply_settings(ElementState& state);
/// Sets the latency of the base class to the longest wait of a frame for its partner. Any thread;
/// call it without locks.
void update_pairing_latency(ElementState& state);

}  // namespace mtstereo::plugin

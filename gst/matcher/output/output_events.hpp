// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

// All but watch_output() run in the task of the source pad.

namespace mtstereo::plugin {

/// Ends the output: one stream has ended and all its frames are matched or dropped, so no further
/// pair is possible. The base class would wait for the other stream, possibly forever.
void end_output(ElementState& state, guint32 seqnum);

/// Signals that a span of time has no disparity. Send it only if no map can follow soon: a sink
/// waits until the time of a gap.
void send_gap(ElementState& state, GstClockTime pts, GstClockTime duration);

/// Makes the segment of the left stream arrive once downstream, also if it was sent before the
/// first buffer: the base class sends it again with that. Call it once.
void watch_output(ElementState& state);

}  // namespace mtstereo::plugin

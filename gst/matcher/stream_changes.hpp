// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include "matcher/element_state.hpp"

// The caps and the segment of a stream arrive while older frames of it may still wait for their
// partners. They take effect with the first frame that they belong to. All run in the task of the
// source pad, without locks, except where a comment says otherwise.

namespace mtstereo::plugin {

/// New caps have arrived. They take effect at once if no older frame waits.
void take_stream_info(ElementState& state, Side side, StreamInfo info);
/// The caps of a frame that is matched now.
void adopt_caps(ElementState& state, Side side, const std::shared_ptr<const StreamInfo>& info);

/// A new segment has arrived. That of the left stream takes effect at once if no older frame waits.
void take_stream_segment(ElementState& state, Side side, const GstSegment& segment, guint32 seqnum);
/// The segment of a left frame that is matched, or replaced by a gap, now: that of the output.
void adopt_segment(ElementState& state, const std::shared_ptr<const StreamSegment>& segment);

/// Sets the latency of the base class to the longest wait of a frame for its partner. Any thread.
void update_pairing_latency(ElementState& state);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include "matcher/element_state.hpp"

// The caps and the segment of a stream arrive while older frames of it may still wait for their
// partners. They take effect with the first frame that they belong to. All run in the task of the
// source pad, without locks.

namespace mtstereo::plugin {

/// New caps have arrived. They take effect at once if no older frame waits.
void take_stream_info(ElementState& state, Side side, StreamInfo info);
/// The caps of a frame that is matched now.
void adopt_caps(ElementState& state, Side side, const std::shared_ptr<const StreamInfo>& info);

/// A new segment has arrived. That of the left stream takes effect at once if no older frame waits.
void take_stream_segment(ElementState& state, Side side, const GstSegment& segment, guint32 seqnum);
/// The segment of a left frame that is matched, or replaced by a gap, now: that of the output.
void adopt_segment(ElementState& state, const std::shared_ptr<const StreamSegment>& segment);

/// True in a live pipeline with the property `newest-pair`: pairs for which there is a newer one
/// are skipped. Takes the lock of the aggregator. Any thread.
bool only_newest(const ElementState& state);

/// Drops all frames that wait, and what is known of the streams' times.
void clear_streams(ElementState& state);
/// Drops the frames of one side that wait. Any thread.
void clear_stream(ElementState& state, Side side);

/// The other stream has ended: drops the frames of this side that wait, and ends its source with
/// the next one. Downstream may block the end of the output for long; a source must not wait for
/// that.
void refuse_frames(ElementState& state, Side side);

/// Lets frames of this pad replace older ones while a pair is matched, if the property
/// `newest-pair` asks for it: upstream is not blocked then.
void watch_pad(ElementState& state, Side side);

}  // namespace mtstereo::plugin

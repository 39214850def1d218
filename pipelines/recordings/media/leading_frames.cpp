// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/leading_frames.hpp"

#include "recordings/media/segments.hpp"

namespace mtstereo::run {

bool LeadingFrames::has(GstPad* pad, const GstBuffer* frame) {
  const std::optional<GstSegment> segment = segment_on(pad);
  if (!segment || segment->format != GST_FORMAT_TIME) return false;
  const GstClockTime time = GST_BUFFER_PTS(frame);
  const bool timed = GST_CLOCK_TIME_IS_VALID(time);
  const std::lock_guard lock(mutex_);
  if (ended_) return false;
  if (!GST_BUFFER_FLAG_IS_SET(frame, GST_BUFFER_FLAG_DELTA_UNIT)) {
    ended_ = keyframe_ || !timed;
    keyframe_ = time;
    return false;
  }
  if (!keyframe_) return false;
  const bool leads = timed ? time < *keyframe_ && *keyframe_ <= segment->start
                           : matroska_ && !GST_BUFFER_DTS_IS_VALID(frame);
  ended_ = !leads;
  return leads;
}

void LeadingFrames::flush() {
  const std::lock_guard lock(mutex_);
  keyframe_.reset();
  ended_ = false;
}

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/media/segments.hpp"

namespace mtstereo::run {

std::optional<GstSegment> segment_on(GstPad* pad) {
  g_autoptr(GstEvent) event = gst_pad_get_sticky_event(pad, GST_EVENT_SEGMENT, 0);
  if (event == nullptr) return std::nullopt;
  const GstSegment* segment = nullptr;
  gst_event_parse_segment(event, &segment);
  return *segment;
}

bool clip(const GstSegment& segment, GstClockTime duration, GstClockTime& time) {
  constexpr GstClockTime kUnknown = 40 * GST_MSECOND;  // that of GstVideoDecoder
  const GstClockTime length = GST_CLOCK_TIME_IS_VALID(duration) ? duration : kUnknown;
  guint64 start = 0, stop = 0;
  if (gst_segment_clip(&segment, GST_FORMAT_TIME, time, time + length, &start, &stop) == FALSE) {
    return false;
  }
  time = start;
  return true;
}

}  // namespace mtstereo::run

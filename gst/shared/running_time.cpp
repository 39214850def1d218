// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/running_time.hpp"

namespace mtstereo::plugin {

std::optional<Nanoseconds> to_running_time(const GstSegment& segment, GstClockTime position) {
  if (segment.format != GST_FORMAT_TIME || !GST_CLOCK_TIME_IS_VALID(position)) return std::nullopt;
  guint64 time = 0;
  const int sign = gst_segment_to_running_time_full(&segment, GST_FORMAT_TIME, position, &time);
  if (sign == 0) return std::nullopt;
  return sign * bounded(time);
}

}  // namespace mtstereo::plugin

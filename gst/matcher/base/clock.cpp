// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/base/clock.hpp"

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

std::optional<Nanoseconds> PipelineClock::now() const {
  const ObjectLock lock(element_);
  GstClock* clock = GST_ELEMENT_CLOCK(element_);
  if (!playing_ || clock == nullptr) return std::nullopt;
  return GST_CLOCK_DIFF(GST_ELEMENT_CAST(element_)->base_time, gst_clock_get_time(clock));
}

}  // namespace mtstereo::plugin

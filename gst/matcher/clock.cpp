// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/clock.hpp"

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

std::optional<Nanoseconds> running_time_now(const ElementState& state) {
  const ObjectLock lock(state.element);
  GstClock* clock = GST_ELEMENT_CLOCK(state.element);
  if (!state.playing || clock == nullptr) return std::nullopt;
  return GST_CLOCK_DIFF(GST_ELEMENT_CAST(state.element)->base_time, gst_clock_get_time(clock));
}

bool is_live(const ElementState& state) {
  return GST_CLOCK_TIME_IS_VALID(gst_aggregator_get_latency(state.element));
}

}  // namespace mtstereo::plugin

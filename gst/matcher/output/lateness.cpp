// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/lateness.hpp"

#include <algorithm>

namespace mtstereo::plugin {

void Lateness::sink_reported(Nanoseconds time, Nanoseconds jitter) {
  // A sink that does not synchronize measures nothing: it reports 0, or its last measured value
  // again if synchronization was switched off.
  if (jitter == 0) return;
  synchronizes_ = jitter != last_jitter_;
  last_jitter_ = jitter;
  if (synchronizes_) learn_delay(time, jitter);
}

void Lateness::learn_delay(Nanoseconds time, Nanoseconds jitter) {
  const std::size_t known = std::min(sent_, kHistory);
  const auto end = history_.begin() + static_cast<std::ptrdiff_t>(known);
  const auto map =
      std::find_if(history_.begin(), end, [&](const Sent& sent) { return sent.time == time; });
  if (map == end) return;
  const Nanoseconds arrival = bounded(bounded(time + latency_) + jitter);
  const Nanoseconds delay = std::clamp<Nanoseconds>(arrival - map->now, 0, kLongestDelay);
  // A map that is early may have waited in a queue until its predecessor was shown, so it can only
  // show that the delay is shorter.
  if (delay > delay_ && jitter > 0) delay_ = delay;
  if (delay < delay_) delay_ += (delay - delay_) / 4;
}

void Lateness::sent(Nanoseconds time, Nanoseconds now) {
  history_[sent_++ % kHistory] = {time, now};
}

std::optional<Nanoseconds> Lateness::predict(Nanoseconds time, Nanoseconds now,
                                             Nanoseconds matching_time) const {
  if (!synchronizes_ || sent_ == 0) return std::nullopt;
  const Nanoseconds last = history_[(sent_ - 1) % kHistory].time;
  if (time - last > kLongestPause + 2 * matching_time) return std::nullopt;
  return now + matching_time + delay_ - bounded(time + latency_);
}

void Lateness::restart() {
  synchronizes_ = false;
  sent_ = 0;
}

}  // namespace mtstereo::plugin

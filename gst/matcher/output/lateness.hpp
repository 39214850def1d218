// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "matcher/pairing/tolerance.hpp"

namespace mtstereo::plugin {

/// Predicts how late a disparity map would be at the sink, by the clock. All times are in ns;
/// running times are those of the pipeline.
///
/// The lateness that a sink reports (QoS event) is that of an earlier map. With a queue between the
/// element and the sink, the next pair is already being matched when the report arrives. So the
/// reports only show that the sink synchronizes, and how long a map takes from the element to it.
class Lateness {
 public:
  /// A pair is matched although it is late if the last one that was matched is older than this plus
  /// twice the matching time. Sinks show a late frame after one second without any.
  static constexpr Nanoseconds kLongestPause = 1'000'000'000;
  /// Longest time from the element to the sink that is taken into account.
  static constexpr Nanoseconds kLongestDelay = 1'000'000'000;

  /// The pipeline has a new latency: sinks show a frame at its running time plus this.
  void set_latency(Nanoseconds latency) { latency_ = latency; }
  /// A sink reports that the map of the running time `time` was late by `jitter`; negative: early.
  void sink_reported(Nanoseconds time, Nanoseconds jitter);
  /// The map of the running time `time` is sent downstream at the running time `now`.
  void sent(Nanoseconds time, Nanoseconds now);
  /// The lateness of the map of the running time `time` if it is sent after `matching_time` from
  /// `now`. Positive: it would be too late, and need not be matched. std::nullopt: no sink is known
  /// to synchronize, or a map is due for the reason given at kLongestPause.
  std::optional<Nanoseconds> predict(Nanoseconds time, Nanoseconds now,
                                     Nanoseconds matching_time) const;
  /// After a flush and at a new segment: running times start over, and the sink may have changed.
  void restart();

  /// The time from the element to the sink, as far as maps that were late showed it.
  Nanoseconds delay() const { return delay_; }

 private:
  struct Sent {
    Nanoseconds time = 0, now = 0;
  };
  static constexpr std::size_t kHistory = 32;  // reports of older maps are not used [maps]

  void learn_delay(Nanoseconds time, Nanoseconds jitter);

  Nanoseconds latency_ = 0;
  Nanoseconds delay_ = 0;
  bool synchronizes_ = false;
  Nanoseconds last_jitter_ = 0;
  std::array<Sent, kHistory> history_{};
  std::size_t sent_ = 0;  // number of maps since the restart
};

}  // namespace mtstereo::plugin

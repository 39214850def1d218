// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "matcher/base/sides.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

/// What is known of both streams at one time.
struct StreamsObservation {
  std::array<bool, 2> waiting{};  ///< frames of this side wait for the other side
  std::array<bool, 2> ended{};    ///< the stream is at its end
  std::uint64_t progress = 0;     ///< changes whenever frames are consumed
  bool busy = false;              ///< the element matches a pair, or downstream blocks it
  bool starting = false;          ///< downstream holds the first map until other sinks have data
  bool empty = false;             ///< in PLAYING, neither stream has had a frame nor its end
};

/// Detects a stream that is silent while frames of the other stream wait for it. It is asked at
/// regular times.
class SilenceDetector {
 public:
  /// The streams at the wall clock time `now` [ns]. Returns a side that has been silent for at
  /// least `timeout`; each silence is returned once.
  std::optional<Side> silent(const StreamsObservation& streams, Nanoseconds now,
                             Nanoseconds timeout);

 private:
  std::optional<Side> side_;  // the silent side
  Nanoseconds since_ = 0;
  std::uint64_t progress_ = 0;
  bool reported_ = false;
};

/// Detects a state that lasts for long. It is asked at regular times.
class LongWait {
 public:
  /// The state at the wall clock time `now` [ns]. True once it has lasted for `timeout`.
  bool due(bool waits, Nanoseconds now, Nanoseconds timeout);

 private:
  std::optional<Nanoseconds> since_;
  bool reported_ = false;
};

}  // namespace mtstereo::plugin

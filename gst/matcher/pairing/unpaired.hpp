// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "shared/times.hpp"

namespace mtstereo::plugin {

/// The frame that waits for its partner at the head of its stream, and since when. If a frame is
/// late because the matcher was busy, another thread may be about to deliver its partner: the frame
/// is kept for at least kGrace from the time at which it was first seen without a partner.
class WaitingFrame {
 public:
  static constexpr Nanoseconds kGrace = 15'000'000;  ///< [ns]

  /// A frame with the running time `time` has no partner at the time `now`. Returns its deadline
  /// minus `latency`, which the caller adds.
  Nanoseconds deadline(bool left, Nanoseconds time, Nanoseconds now, Nanoseconds latency);

 private:
  bool left_ = false;
  std::optional<Nanoseconds> time_;
  Nanoseconds since_ = 0;
};

/// Decides when to warn that frames have no partners: once `kRun` consecutive frames had none, and
/// after that at most once per `kInterval`.
class UnpairedWarning {
 public:
  static constexpr int kRun = 30;                           ///< [frames]
  static constexpr Nanoseconds kInterval = 10'000'000'000;  ///< [ns], wall clock

  /// A frame without a partner was dropped at the wall clock time `now`. True: warn now.
  bool dropped(Nanoseconds now);
  /// Two frames were paired.
  void paired() { run_ = 0; }
  /// Number of consecutive frames without a partner.
  int run() const { return run_; }
  /// Whether a warning was due.
  bool warned() const { return last_.has_value(); }

 private:
  int run_ = 0;
  std::optional<Nanoseconds> last_;
};

}  // namespace mtstereo::plugin

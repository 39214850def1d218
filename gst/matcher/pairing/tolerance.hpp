// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>

#include "mtstereo/matcher.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

inline constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

inline Side other_side(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

/// The tolerance if the frame duration is known neither from the caps nor from the buffers [ns].
inline constexpr Nanoseconds kFallbackTolerance = 20'000'000;

/// The frame duration of each side [ns], if known.
struct FrameDurations {
  std::optional<Nanoseconds> left;
  std::optional<Nanoseconds> right;

  /// The shorter of the known durations.
  std::optional<Nanoseconds> shorter() const;
};

/// The tolerance that applies: `set` if it is not negative, otherwise half of the shorter frame
/// duration of the caps, otherwise of the buffers, otherwise kFallbackTolerance. The shorter
/// duration ensures that a frame of a slow stream is not paired with a neighbor of its partner in a
/// fast stream.
Nanoseconds effective_tolerance(Nanoseconds set, const FrameDurations& caps,
                                const FrameDurations& buffers);

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
  void reset() { *this = UnpairedWarning(); }

 private:
  int run_ = 0;
  std::optional<Nanoseconds> last_;
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace mtstereo::plugin {

/// A running time or a span of it [ns]. Signed: a frame may begin before its segment does.
using Nanoseconds = std::int64_t;

/// The tolerance where neither the caps nor the buffers tell how long a frame lasts [ns].
inline constexpr Nanoseconds kFallbackTolerance = 20'000'000;

/// What to do with the frames at the head of the two streams.
enum class PairingAction {
  kPair,           ///< they were taken at the same time: match them
  kDropLeft,       ///< the right stream is past the left frame: no partner can come for it
  kDropRight,      ///< the left stream is past the right frame
  kMixedStamping,  ///< one frame has a time stamp and the other has none: an error
};

/// What decided, for the statistics and the messages.
struct PairingDecision {
  PairingAction action = PairingAction::kPair;
  Nanoseconds difference = 0;  ///< right minus left; 0 where there are no time stamps
};

/// Decides about two frames from their running times; std::nullopt is a frame without a time stamp.
/// Two frames without one pair in order. Frames at most `tolerance` apart pair; of others the older
/// one is dropped, as both streams only go forward.
PairingDecision decide_pairing(std::optional<Nanoseconds> left, std::optional<Nanoseconds> right,
                               Nanoseconds tolerance);

/// How long a frame of each side lasts [ns], as far as it is known.
struct FrameDurations {
  std::optional<Nanoseconds> left;
  std::optional<Nanoseconds> right;

  /// The shorter one of those that are known.
  std::optional<Nanoseconds> shorter() const;
};

/// The tolerance in force: `set` if it is not negative, else half of the shorter frame duration of
/// the caps, else of the buffers, else kFallbackTolerance. The shorter one, so that a slow stream
/// is never paired with the neighbor of its partner in a fast one.
Nanoseconds tolerance_in_force(Nanoseconds set, const FrameDurations& caps,
                               const FrameDurations& buffers);

/// The frame that waits alone at the head of its stream, and since when. A frame that is late
/// because the matcher was busy is not to be dropped in the moment in which its partner is about to
/// be handed over by another thread: it gets kGrace from when it was first seen alone.
class LonelyFrame {
 public:
  static constexpr Nanoseconds kGrace = 15'000'000;  ///< [ns]

  /// A frame of the running time `time` is alone at the moment `now`. Gives the time until which
  /// its partner is waited for, less `latency`, which the caller adds.
  Nanoseconds deadline(bool left, Nanoseconds time, Nanoseconds now, Nanoseconds latency);

 private:
  bool left_ = false;
  std::optional<Nanoseconds> time_;
  Nanoseconds since_ = 0;
};

/// Finds out when the user has to be told that the streams do not meet: at the first time that
/// `kRun` frames in a row had no partner, and at most once every `kInterval` after that.
class UnpairedAlarm {
 public:
  static constexpr int kRun = 30;                           ///< [frames]
  static constexpr Nanoseconds kInterval = 10'000'000'000;  ///< [ns] of the wall clock

  /// A frame was dropped for want of a partner at wall clock time `now`. True: tell the user.
  bool dropped(Nanoseconds now);
  /// Two frames were paired.
  void paired() { run_ = 0; }
  /// How many frames in a row had no partner.
  int run() const { return run_; }
  void reset() { *this = UnpairedAlarm(); }

 private:
  int run_ = 0;
  std::optional<Nanoseconds> last_;
};

}  // namespace mtstereo::plugin

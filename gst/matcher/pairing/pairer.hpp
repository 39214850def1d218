// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "matcher/pairing/frame_queue.hpp"
#include "matcher/pairing/pair_finder.hpp"
#include "matcher/pairing/pair_times.hpp"
#include "matcher/pairing/tolerance.hpp"

namespace mtstereo::plugin {

/// Why the pairer is called.
enum class Trigger {
  kFrames,    ///< both streams have a frame, or have ended
  kDeadline,  ///< the oldest frame waits no longer
};

/// What decides which frames are a pair.
struct PairingRules {
  SyncMode mode = SyncMode::kRunningTime;
  Nanoseconds tolerance = -1;  ///< the property; -1: see effective_tolerance()
  FrameDurations durations;    ///< from the framerates of the caps
  bool live = false;           ///< frames have a deadline
};

/// What is done next with the frames at the heads of the queues.
struct PairingAction {
  enum class Kind {
    kWait,    ///< for a frame
    kEnd,     ///< no pair can follow
    kPair,    ///< the frames `left` and `right` are a pair
    kDrop,    ///< `left` or `right` has no partner
    kGap,     ///< `left` is a gap
    kPassed,  ///< a gap of the right stream has been passed
    kNoTime,  ///< error: a frame has no time, the other one has
  };
  Kind kind = Kind::kWait;
  Side side = Side::kLeft;  ///< of the frame that is dropped or has no time
  QueuedFrame left{};
  QueuedFrame right{};
  bool at_deadline = false;    ///< it is dropped because its partner has not arrived
  bool wrong_time = false;     ///< it is dropped because of its time stamp
  bool expected = false;       ///< it is dropped where a frame without a partner is normal
  Nanoseconds difference = 0;  ///< of the two frames, right minus left
  Nanoseconds tolerance = 0;
  PairDoubt doubt = PairDoubt::kNone;

  QueuedFrame& frame() { return side == Side::kLeft ? left : right; }
};

using FrameQueues = std::array<FrameQueue, 2>;

/// Decides what is done with the frames of two queues, and takes them out. It remembers what it has
/// learned of the times of the streams.
class Pairer {
 public:
  explicit Pairer(FrameQueues& queues) : queues_(queues) {}

  PairingAction next(const PairingRules& rules, Trigger trigger);
  /// Forgets the streams.
  void clear();

  const PairFinder& finder() const { return finder_; }
  /// The mode of the last decision.
  SyncMode mode() const { return rules_.mode; }
  /// The mode of the last pair.
  std::optional<SyncMode> working_mode() const { return working_mode_; }
  /// How often it has begun to learn. What was learned before no longer holds.
  int restarts() const { return restarts_; }

 private:
  FrameQueue& queue(Side side) { return queues_[index_of(side)]; }
  PairingAction take(PairingAction::Kind kind, Side side, std::size_t index = 0);
  Nanoseconds tolerance() const;
  std::optional<PairingAction> pass_gap();
  std::optional<PairingAction> drop_in_gap();
  std::optional<PairingAction> drop_outdated();
  PairingAction without_frame(Side side);
  void begin_segments();
  std::optional<PairingAction> drop_unreferenced(Side side);
  WaitingFrames waiting_frames(Side side, const PairTimes& found);
  PairingAction with_both();
  PairingAction pair();
  PairingAction carry_out(const PairDecision& decision, const PairTimes& found);
  void restart();

  FrameQueues& queues_;
  PairingRules rules_;  // of the current call
  Trigger trigger_ = Trigger::kFrames;

  PairFinder finder_;
  PairClock clock_;
  int restarts_ = 0;
  std::array<std::shared_ptr<const StreamSegment>, 2> paired_segments_;  // of the last frames
  SyncMode paired_mode_ = SyncMode::kRunningTime;
  std::optional<SyncMode> working_mode_;
  // The running time of the first live frame without a reference time stamp since the last pair.
  std::optional<Nanoseconds> unreferenced_since_;
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "matcher/base/sides.hpp"
#include "matcher/pairing/stream_offset.hpp"
#include "mtstereo/matcher.hpp"

namespace mtstereo::plugin {

/// The frames of one stream that wait at its head.
struct WaitingFrames {
  std::span<const Nanoseconds> times;  ///< in the order of arrival
  Nanoseconds period = 0;              ///< frame duration; 0: not known
  bool complete = false;               ///< no further frame is worth waiting for
  bool skipping = false;  ///< frames are left out on purpose: their steps state no frame duration
};

/// What is to be done with the frames at the heads of the two streams.
enum class PairAction {
  kPair,  ///< the first frames of both streams are a pair
  kDrop,  ///< a frame has no partner, or a wrong time stamp
  kWait,  ///< decide again after the next frame of a stream
};

struct PairDecision {
  PairAction action = PairAction::kWait;
  Side side = Side::kLeft;     ///< of the frame to drop, or of the stream to wait for
  std::size_t index = 0;       ///< of the frame to drop
  bool wrong_time = false;     ///< it is dropped because of its time stamp
  Nanoseconds difference = 0;  ///< of the first frames, right minus left
};

/// Why the pairs may be wrong although their times fit.
enum class PairDoubt {
  kNone,
  kOffset,  ///< the streams are apart by so large a part of a frame that the partner may be another
  kSlip,    ///< the streams have drifted apart, and the partner is now another frame
};

/// Decides when to report a doubt: each kind at most once per `kInterval`.
class DoubtWarning {
 public:
  static constexpr Nanoseconds kInterval = 60'000'000'000;  ///< [ns], wall clock

  /// A doubt came up at the wall clock time `now`. True: report it.
  bool due(PairDoubt doubt, Nanoseconds now);

 private:
  std::array<std::optional<Nanoseconds>, 3> last_;
};

/// Finds the pairs of two streams by the times of their frames. Frames whose times agree with the
/// offset of the streams are a pair at once. Otherwise it looks ahead by a few frames: to learn the
/// offset, to find out which of two frames is the nearer one, and to distinguish a frame with a
/// wrong time stamp from lost frames. Its decisions depend only on the times, not on when frames
/// arrive, as long as no stream is complete early.
class PairFinder {
 public:
  /// Streams are out of step by at most this part of a frame without doubt.
  static constexpr double kSafeOffset = 0.2;

  /// The next step for two streams with at least one frame each. Pairs are at most `tolerance`
  /// apart. A stream that is waited for must be complete or longer at the next call.
  PairDecision next(const WaitingFrames& left, const WaitingFrames& right, Nanoseconds tolerance);

  /// The caller has dropped a frame with this time; not for wrong times.
  void dropped(Side side, Nanoseconds time);
  /// The caller has taken a pair.
  void paired(Nanoseconds left, Nanoseconds right);
  /// Forgets the streams.
  void reset() { *this = PairFinder(); }

  /// A doubt that has come up since the last call, before the pairs that it concerns.
  PairDoubt new_doubt();
  const StreamOffset& offset() const { return offset_; }
  /// The duration of a frame of the faster stream in use [ns]; 0: not known.
  Nanoseconds period() const { return period_; }

 private:
  struct Stream {
    std::optional<Nanoseconds> last;      // time of the last frame that was taken or dropped
    std::array<Nanoseconds, 32> steps{};  // the last differences of successive frames
    std::size_t count = 0;                // of all steps so far
    Nanoseconds period(std::span<const Nanoseconds> waiting) const;
    void passed(Nanoseconds time);
  };
  /// The frames that are in order, and whether more are worth waiting for.
  struct Ordered {
    std::span<const Nanoseconds> times;
    bool complete;
  };

  Stream& stream(Side side) { return streams_[static_cast<std::size_t>(side)]; }
  std::optional<PairDecision> check_order(Side side, const WaitingFrames& frames);
  std::optional<PairDecision> check_first(Side side, const WaitingFrames& frames);
  bool suspicious(Side side, Nanoseconds time, Nanoseconds distance);
  void update_periods(const WaitingFrames& left, const WaitingFrames& right, Nanoseconds tolerance);
  std::optional<PairDecision> learn(const Ordered& left, const Ordered& right);
  Nanoseconds slack(Nanoseconds tolerance) const;
  PairDecision decide(const Ordered& left, const Ordered& right, Nanoseconds tolerance);
  PairDecision drop_older(Side older, const Ordered& left, const Ordered& right,
                          Nanoseconds difference);
  void update_doubt();

  std::array<Stream, 2> streams_;
  StreamOffset offset_;
  Nanoseconds period_ = 0;    // of the faster stream, or what the tolerance suggests
  bool same_rate_ = true;     // both streams have the same period: their offset means something
  int misses_ = 0;            // frames without a partner since the last pair
  bool last_paired_ = false;  // the last frames of both streams were a pair
  bool doubtful_ = false;
  PairDoubt new_doubt_ = PairDoubt::kNone;
};

}  // namespace mtstereo::plugin

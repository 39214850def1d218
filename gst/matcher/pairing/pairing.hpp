// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "matcher/pairing/pairer.hpp"
#include "matcher/pairing/unpaired.hpp"

namespace mtstereo::plugin {

/// The part of the property `stats` on pairing.
struct PairingStatistics {
  std::array<guint64, 2> dropped{};  ///< frames without a partner, by side
  guint64 wrong_times = 0;           ///< of these, frames with a wrong time stamp
  DifferenceStatistics difference;   ///< of the times of the pairs
};

/// What happens to a frame that arrives on a pad.
enum class Arrival {
  kTaken,
  kDropped,  ///< it has no partner
  kRefused,  ///< no pair can follow: its source is to end
};

/// The frames of both streams that wait, and which of them are pairs: the first station of a frame.
/// It knows the pads, but neither the element nor the matcher. One lock guards all of it; no other
/// lock is taken while it is held, except those of the pads.
class Pairing {
 public:
  // --- Any thread.

  void set_mode(SyncMode mode);
  /// The property sync-tolerance; see effective_tolerance().
  void set_tolerance(Nanoseconds tolerance);
  /// The frame duration that the caps of the matched frames state.
  void set_duration(Side side, std::optional<Nanoseconds> duration);

  /// How long a frame of a live stream waits for its partner, and how long it can at most.
  struct Wait {
    Nanoseconds wait = 0;
    Nanoseconds room = 0;
  };
  Wait wait() const;

  /// The next segments of both streams follow this seek.
  void note_seek(guint32 seqnum, bool flushing);

  /// A frame arrives on a pad and is not in its queue yet. With `newest` it may replace older
  /// frames, so that its source is not blocked.
  Arrival arrive(Side side, GstBuffer* buffer, bool newest);
  /// No pair can follow, until a flush: drops the frames of this side that wait, and refuses new
  /// ones of both sides.
  void refuse(Side side);
  /// A flush: drops the frames of one side that wait, without counting them.
  void clear(Side side);

  PairingStatistics statistics() const;
  /// True if frames of this side wait outside of the pad.
  bool holds(Side side) const;
  bool holds_any() const { return holds(Side::kLeft) || holds(Side::kRight); }

  // --- In the task of the source pad, or while it does not run.

  /// Sets a pad, before any other call.
  void set_pad(Side side, GstAggregatorPad* pad) { queues_[index_of(side)].pad = pad; }
  GstAggregatorPad* pad(Side side) const { return queues_[index_of(side)].pad; }
  Side side_of(const GstAggregatorPad* pad) const {
    return pad == this->pad(Side::kLeft) ? Side::kLeft : Side::kRight;
  }

  /// New caps, or a new segment, of the frames that follow. True if no older frame waits.
  bool begin(Side side, const std::shared_ptr<const StreamInfo>& info);
  bool begin(Side side, const std::shared_ptr<const StreamSegment>& segment);
  /// A segment that has arrived, with what is known about the seek that it follows.
  std::shared_ptr<const StreamSegment> describe(Side side, const GstSegment& segment,
                                                guint32 seqnum) const;

  /// The latency that the base class adds to deadlines; 0 if the streams are not live.
  void set_latency(GstClockTime latency);
  PairingAction next(Trigger trigger);
  /// The time until which a frame without a partner waits [running time].
  std::optional<Nanoseconds> deadline(Nanoseconds now);
  /// True if the pad has a frame that is not held here, or has ended.
  bool has_news(Side side) const;

  const Pairer& pairer() const { return pairer_; }

  /// The start of the element: forgets what was learned and counted.
  void start();
  /// The end: drops the frames that wait, and forgets the streams.
  void stop();

 private:
  FrameQueue& queue(Side side) { return queues_[index_of(side)]; }
  bool drop_in_gap(Side side, GstBuffer* buffer);
  void make_room(Side side);

  mutable std::mutex mutex_;  // guards the members below
  FrameQueues queues_;
  PairingRules rules_;
  Pairer pairer_{queues_};
  WaitingFrame waiting_frame_;
  Nanoseconds latency_ = 0;
  SeekHistory seeks_;
  guint64 flushing_seeks_ = 0;  // sent upstream so far
  PairingStatistics statistics_;
  bool ended_ = false;  // no pair can follow; until a flush
};

}  // namespace mtstereo::plugin

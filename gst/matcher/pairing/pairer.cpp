// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pairer.hpp"

#include <utility>

#include "matcher/pairing/pair_axis.hpp"

namespace mtstereo::plugin {
namespace {

using Kind = PairingAction::Kind;

std::optional<Nanoseconds> duration_of(const QueuedFrame& frame) {
  if (!GST_BUFFER_DURATION_IS_VALID(frame.buffer.get())) return std::nullopt;
  return bounded(GST_BUFFER_DURATION(frame.buffer.get()));
}

/// The longest duration of the frames that wait: a seek may clip the first one.
std::optional<Nanoseconds> longest_duration(const FrameQueue& queue) {
  std::optional<Nanoseconds> longest;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto duration = duration_of(queue[i]);
    if (duration && (!longest || *duration > *longest)) longest = duration;
  }
  return longest;
}

/// True if a trick mode lets the elements upstream leave out frames.
bool skips_frames(const QueuedFrame& frame) {
  constexpr int kModes = GST_SEGMENT_FLAG_TRICKMODE | GST_SEGMENT_FLAG_TRICKMODE_KEY_UNITS |
                         GST_SEGMENT_FLAG_TRICKMODE_FORWARD_PREDICTED;
  return frame.segment && (frame.segment->segment.flags & kModes) != 0;
}

/// How long frames of live streams may lack a reference time stamp: RTP has none until the first
/// report of the sender, which comes after some seconds [ns of running time].
constexpr Nanoseconds kReferenceWait = 10'000'000'000;

}  // namespace

PairingAction Pairer::next(const PairingRules& rules, Trigger trigger) {
  rules_ = rules;
  trigger_ = trigger;
  for (FrameQueue& queue : queues_) queue.look();
  if (auto action = pass_gap()) return std::move(*action);
  if (auto action = drop_in_gap()) return std::move(*action);
  for (const Side side : kSides) {
    if (queue(side).empty()) return without_frame(side);
  }
  if (auto action = drop_outdated()) return std::move(*action);
  begin_segments();
  return with_both();
}

void Pairer::restart() {
  finder_.reset();
  clock_.reset();
  unreferenced_since_.reset();
  ++restarts_;
}

void Pairer::clear() {
  paired_segments_ = {};
  working_mode_.reset();
  restart();
}

PairingAction Pairer::take(Kind kind, Side side, std::size_t index) {
  PairingAction action;
  action.kind = kind;
  action.side = side;
  action.frame() = queue(side).take(index);
  return action;
}

Nanoseconds Pairer::tolerance() const {
  FrameDurations buffers;
  for (const Side side : kSides) {
    const FrameQueue& frames = queues_[index_of(side)];
    if (!frames.empty()) buffers.of(side) = longest_duration(frames);
  }
  return effective_tolerance(rules_.tolerance, rules_.durations, buffers);
}

/// Passes a gap at the head of a stream: frames of the other stream in its time have no partners.
std::optional<PairingAction> Pairer::pass_gap() {
  for (const Side side : kSides) {
    if (queue(side).empty() || !queue(side).front().is_gap()) continue;
    PairingAction action = take(side == Side::kLeft ? Kind::kGap : Kind::kPassed, side);
    const auto end = action.frame().end_time();
    if (end) queue(side).passed = PassedTime{*end, action.frame().segment};
    return action;
  }
  return std::nullopt;
}

/// Drops a frame whose partner would be in a gap of the other stream.
std::optional<PairingAction> Pairer::drop_in_gap() {
  if (rules_.mode != SyncMode::kRunningTime) return std::nullopt;
  for (const Side side : kSides) {
    if (queue(side).empty()) continue;
    if (!is_in_gap(queue(side).front(), side, queue(other_side(side)), tolerance())) continue;
    PairingAction action = take(Kind::kDrop, side);
    action.expected = true;
    return action;
  }
  return std::nullopt;
}

/// Drops a frame from before a seek that the other stream has carried out.
std::optional<PairingAction> Pairer::drop_outdated() {
  const auto& left = queue(Side::kLeft).front().segment;
  const auto& right = queue(Side::kRight).front().segment;
  if (!left || !right) return std::nullopt;
  const bool left_outdated = is_outdated(*left, *right);
  if (!left_outdated && !is_outdated(*right, *left)) return std::nullopt;
  PairingAction action = take(Kind::kDrop, left_outdated ? Side::kLeft : Side::kRight);
  action.expected = true;
  return action;
}

/// No frame of this side is here.
PairingAction Pairer::without_frame(Side side) {
  const Side full = other_side(side);
  const bool alone = queue(full).empty();
  if (queue(side).ended() || (alone && queue(full).ended())) {
    if (alone) return PairingAction{.kind = Kind::kEnd};
    PairingAction action = take(Kind::kDrop, full);
    action.expected = true;
    return action;
  }
  if (trigger_ != Trigger::kDeadline || alone) return PairingAction{};
  PairingAction action = take(Kind::kDrop, full);
  action.at_deadline = true;
  return action;
}

/// The result of a segment does not depend on earlier ones, nor on other modes.
void Pairer::begin_segments() {
  bool changed = std::exchange(paired_mode_, rules_.mode) != rules_.mode;
  for (const Side side : kSides) {
    auto& last = paired_segments_[index_of(side)];
    const auto& segment = queue(side).front().segment;
    changed = changed || last != segment;
    last = segment;
  }
  if (changed) restart();
}

/// Drops the first frame of this side, which has no reference time stamp, if its stream is live
/// and may get one later.
std::optional<PairingAction> Pairer::drop_unreferenced(Side side) {
  const bool taken_back = working_mode_ && *working_mode_ != rules_.mode;
  const auto time = queue(side).front().running_time();
  if (rules_.mode != SyncMode::kReferenceTimestamp || !rules_.live || taken_back || !time)
    return std::nullopt;
  if (!unreferenced_since_) unreferenced_since_ = time;
  if (*time - *unreferenced_since_ > kReferenceWait) return std::nullopt;
  PairingAction action = take(Kind::kDrop, side);
  action.expected = true;
  return action;
}

PairingAction Pairer::pair() {
  working_mode_ = rules_.mode;
  unreferenced_since_.reset();
  PairingAction action = take(Kind::kPair, Side::kLeft);
  action.right = queue(Side::kRight).take();
  return action;
}

WaitingFrames Pairer::waiting_frames(Side side, const PairTimes& found) {
  const FrameQueue& frames = queue(side);
  const auto& duration = rules_.durations.of(side);
  const auto period = duration ? duration : longest_duration(frames);
  const bool full = frames.size() >= FrameQueue::kCapacity;
  const bool complete =
      found.complete[index_of(side)] || trigger_ == Trigger::kDeadline || full || frames.ended();
  return {found.times[index_of(side)], period.value_or(0), complete, skips_frames(frames.front())};
}

PairingAction Pairer::with_both() {
  const PairTimes found = clock_.times(queue(Side::kLeft), queue(Side::kRight), rules_.mode);
  const bool left = !found.times[0].empty();
  const bool right = !found.times[1].empty();
  const bool needed = rules_.mode == SyncMode::kReferenceTimestamp;
  if (!left && !right && !needed) return pair();
  if (!left || !right) {
    const Side side = left ? Side::kRight : Side::kLeft;
    if (auto action = drop_unreferenced(side)) return std::move(*action);
    return PairingAction{.kind = Kind::kNoTime, .side = side};
  }
  const WaitingFrames lefts = waiting_frames(Side::kLeft, found);
  const WaitingFrames rights = waiting_frames(Side::kRight, found);
  const Nanoseconds allowed = tolerance();
  const PairDecision decision = finder_.next(lefts, rights, allowed);
  PairingAction action = carry_out(decision, found);
  action.tolerance = allowed;
  action.difference = decision.difference;
  action.doubt = finder_.new_doubt();
  return action;
}

PairingAction Pairer::carry_out(const PairDecision& decision, const PairTimes& found) {
  if (decision.action == PairAction::kPair) {
    finder_.paired(found.times[0].front(), found.times[1].front());
    return pair();
  }
  const auto index = index_of(decision.side);
  if (decision.action == PairAction::kDrop) {
    if (!decision.wrong_time) {
      finder_.dropped(decision.side, found.times[index][decision.index]);
    }
    PairingAction action = take(Kind::kDrop, decision.side, decision.index);
    action.wrong_time = decision.wrong_time;
    action.at_deadline = trigger_ == Trigger::kDeadline;
    return action;
  }
  // Both streams get room: one thread may feed both.
  queue(decision.side).hold();
  FrameQueue& rest = queue(other_side(decision.side));
  if (rest.size() < FrameQueue::kCapacity) rest.hold();
  return PairingAction{};
}

}  // namespace mtstereo::plugin

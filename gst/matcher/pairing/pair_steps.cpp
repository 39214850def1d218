// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pair_steps.hpp"

#include <utility>

#include "matcher/pairing/pair_axis.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

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

bool has_ended(const ElementState& state, Side side) {
  return gst_aggregator_pad_is_eos(state.input(side).pad) != FALSE;
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

/// The steps of two streams. Holds the lock of the queues.
class Stepper {
 public:
  Stepper(ElementState& state, Occasion occasion)
      : state_(state),
        occasion_(occasion),
        deadline_(occasion == Occasion::kDeadline),
        lock_(state.queue_mutex) {
    for (const Side side : kSides) queue(side).look(pad(side));
    const ObjectLock object_lock(state.element);
    mode_ = state.settings.sync_mode;
    set_tolerance_ = state.settings.sync_tolerance;
    durations_ = state.caps_durations;
  }

  Step next() {
    if (auto step = pass_gap()) return std::move(*step);
    if (auto step = drop_in_gap()) return std::move(*step);
    for (const Side side : kSides) {
      if (queue(side).empty()) return without_frame(side);
    }
    if (auto step = drop_outdated()) return std::move(*step);
    begin_segments();
    return with_both();
  }

 private:
  FrameQueue& queue(Side side) { return state_.queue(side); }
  GstAggregatorPad* pad(Side side) const { return state_.input(side).pad; }

  Step take(StepKind kind, Side side, std::size_t index = 0) {
    Step step;
    step.kind = kind;
    step.side = side;
    step.frame() = queue(side).take(pad(side), index);
    return step;
  }

  Nanoseconds tolerance() const {
    FrameDurations buffers;
    if (!state_.queues[0].empty()) buffers.left = longest_duration(state_.queues[0]);
    if (!state_.queues[1].empty()) buffers.right = longest_duration(state_.queues[1]);
    return effective_tolerance(set_tolerance_, durations_, buffers);
  }

  /// Passes a gap at the head of a stream: frames of the other stream in its time have no partners.
  std::optional<Step> pass_gap() {
    for (const Side side : kSides) {
      if (queue(side).empty() || !queue(side).front().is_gap()) continue;
      Step step = take(side == Side::kLeft ? StepKind::kGap : StepKind::kPassed, side);
      const auto end = step.frame().end_time();
      if (end) queue(side).passed = PassedTime{*end, step.frame().segment};
      return step;
    }
    return std::nullopt;
  }

  /// Drops a frame whose partner would be in a gap of the other stream.
  std::optional<Step> drop_in_gap() {
    if (mode_ != SyncMode::kRunningTime) return std::nullopt;
    for (const Side side : kSides) {
      if (queue(side).empty()) continue;
      if (!is_in_gap(queue(side).front(), side, queue(other_side(side)), tolerance())) continue;
      Step step = take(StepKind::kDrop, side);
      step.without_message = true;
      return step;
    }
    return std::nullopt;
  }

  /// Drops a frame from before a seek that the other stream has carried out.
  std::optional<Step> drop_outdated() {
    const auto& left = queue(Side::kLeft).front().segment;
    const auto& right = queue(Side::kRight).front().segment;
    if (!left || !right) return std::nullopt;
    const bool left_outdated = is_outdated(*left, *right);
    if (!left_outdated && !is_outdated(*right, *left)) return std::nullopt;
    Step step = take(StepKind::kDrop, left_outdated ? Side::kLeft : Side::kRight);
    step.without_message = true;
    return step;
  }

  /// No frame of this side is here.
  Step without_frame(Side side) {
    const Side full = other_side(side);
    const bool alone = queue(full).empty();
    if (has_ended(state_, side) || (alone && has_ended(state_, full))) {
      if (occasion_ == Occasion::kEnd) return Step{};
      if (alone) return Step{.kind = StepKind::kEnd};
      Step step = take(StepKind::kDrop, full);
      step.without_message = true;
      return step;
    }
    if (!deadline_ || alone) return Step{};
    Step step = take(StepKind::kDrop, full);
    step.at_deadline = true;
    return step;
  }

  /// The result of a segment does not depend on earlier ones, nor on other modes.
  void begin_segments() {
    bool changed = std::exchange(state_.paired_mode, mode_) != mode_;
    for (const Side side : kSides) {
      auto& last = state_.paired_segments[static_cast<std::size_t>(side)];
      const auto& segment = queue(side).front().segment;
      changed = changed || last != segment;
      last = segment;
    }
    if (changed) state_.restart_pairing();
  }

  /// Drops the first frame of this side, which has no reference time stamp, if its stream is live
  /// and may get one later.
  std::optional<Step> drop_unreferenced(Side side) {
    const bool live = state_.known_latency > 0;
    const bool taken_back = state_.working_mode && *state_.working_mode != mode_;
    const auto time = queue(side).front().running_time();
    if (mode_ != SyncMode::kReferenceTimestamp || !live || taken_back || !time) return std::nullopt;
    if (!state_.unreferenced_since) state_.unreferenced_since = time;
    if (*time - *state_.unreferenced_since > kReferenceWait) return std::nullopt;
    Step step = take(StepKind::kDrop, side);
    step.without_message = true;
    return step;
  }

  Step pair() {
    state_.working_mode = mode_;
    state_.unreferenced_since.reset();
    Step step = take(StepKind::kPair, Side::kLeft);
    step.right = queue(Side::kRight).take(pad(Side::kRight), 0);
    return step;
  }

  Step with_both() {
    const PairTimes found = state_.clock.times(queue(Side::kLeft), queue(Side::kRight), mode_);
    const bool left = !found.times[0].empty();
    const bool right = !found.times[1].empty();
    const bool needed = mode_ == SyncMode::kReferenceTimestamp;
    if (!left && !right && !needed) return pair();
    if (!left || !right) {
      const Side side = left ? Side::kRight : Side::kLeft;
      if (auto step = drop_unreferenced(side)) return std::move(*step);
      return Step{.kind = StepKind::kNoTime, .side = side};
    }
    std::array<WaitingFrames, 2> waiting;
    for (const Side side : kSides) {
      const auto index = static_cast<std::size_t>(side);
      const auto& duration = side == Side::kLeft ? durations_.left : durations_.right;
      const auto period = duration ? duration : longest_duration(queue(side));
      const bool full = queue(side).size() >= FrameQueue::kCapacity;
      waiting[index] = {found.times[index], period.value_or(0),
                        found.complete[index] || deadline_ || full || has_ended(state_, side),
                        skips_frames(queue(side).front())};
    }
    const Nanoseconds allowed = tolerance();
    const PairStep decision = state_.finder.next(waiting[0], waiting[1], allowed);
    Step step = carry_out(decision, found);
    step.tolerance = allowed;
    step.difference = decision.difference;
    step.doubt = state_.finder.new_doubt();
    return step;
  }

  Step carry_out(const PairStep& decision, const PairTimes& found) {
    if (decision.action == PairAction::kPair) {
      state_.finder.paired(found.times[0].front(), found.times[1].front());
      return pair();
    }
    const auto index = static_cast<std::size_t>(decision.side);
    if (decision.action == PairAction::kDrop) {
      if (!decision.wrong_time) {
        state_.finder.dropped(decision.side, found.times[index][decision.index]);
      }
      Step step = take(StepKind::kDrop, decision.side, decision.index);
      step.wrong_time = decision.wrong_time;
      step.at_deadline = deadline_;
      return step;
    }
    // Both streams get room: one thread may feed both.
    queue(decision.side).hold(pad(decision.side));
    FrameQueue& rest = queue(other_side(decision.side));
    if (rest.size() < FrameQueue::kCapacity) rest.hold(pad(other_side(decision.side)));
    return Step{};
  }

  ElementState& state_;
  const Occasion occasion_;
  const bool deadline_;
  std::lock_guard<std::mutex> lock_;
  SyncMode mode_ = SyncMode::kRunningTime;
  gint64 set_tolerance_ = -1;
  FrameDurations durations_;
};

}  // namespace

Step next_step(ElementState& state, Occasion occasion) { return Stepper(state, occasion).next(); }

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/aggregation.hpp"

#include <utility>

#include "matcher/clock.hpp"
#include "matcher/matching.hpp"
#include "matcher/output_events.hpp"
#include "matcher/pairing_reports.hpp"
#include "matcher/streams.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

/// Why steps are taken now.
enum class Occasion {
  kFrames,    // both streams have a frame, or have ended
  kDeadline,  // the oldest frame waits no longer
  kEnd,       // one stream has just ended; the rest of the other one is left to the next occasion
};

/// What is done next.
enum class StepKind {
  kWait,    // for a frame
  kEnd,     // no pair can follow
  kPair,    // the frames `left` and `right` are a pair
  kDrop,    // `left` or `right` has no partner
  kGap,     // `left` is a gap
  kPassed,  // a gap of the right stream has been passed
  kNoTime,  // error: a frame has no time, the other one has
};

struct Step {
  StepKind kind = StepKind::kWait;
  Side side = Side::kLeft;  // of the frame that is dropped or has no time
  QueuedFrame left{};
  QueuedFrame right{};
  bool at_deadline = false;      // it is dropped because its partner has not arrived
  bool wrong_time = false;       // it is dropped because of its time stamp
  bool without_message = false;  // it is dropped where a frame without a partner is normal
  Nanoseconds difference = 0;    // of the two frames, right minus left
  Nanoseconds tolerance = 0;
  PairDoubt doubt = PairDoubt::kNone;

  QueuedFrame& frame() { return side == Side::kLeft ? left : right; }
};

std::optional<Nanoseconds> duration_of(const QueuedFrame& frame) {
  if (!GST_BUFFER_DURATION_IS_VALID(frame.buffer.get())) return std::nullopt;
  return static_cast<Nanoseconds>(GST_BUFFER_DURATION(frame.buffer.get()));
}

bool has_ended(const ElementState& state, Side side) {
  return gst_aggregator_pad_is_eos(state.input(side).pad) != FALSE;
}

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
    if (!state_.queues[0].empty()) buffers.left = duration_of(state_.queues[0].front());
    if (!state_.queues[1].empty()) buffers.right = duration_of(state_.queues[1].front());
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
      const auto time = queue(side).front().running_time();
      if (!time || !queue(other_side(side)).has_passed(*time + tolerance())) continue;
      Step step = take(StepKind::kDrop, side);
      step.without_message = true;
      return step;
    }
    return std::nullopt;
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

  /// The result of a segment does not depend on earlier ones.
  void begin_segments() {
    for (const Side side : kSides) {
      auto& last = state_.paired_segments[static_cast<std::size_t>(side)];
      if (last == queue(side).front().segment) continue;
      last = queue(side).front().segment;
      state_.finder.reset();
      state_.clock.reset();
    }
    if (mode_ == state_.paired_mode) return;
    state_.paired_mode = mode_;
    state_.finder.reset();
    state_.clock.reset();
  }

  Step pair() {
    state_.working_mode = mode_;
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
      return Step{.kind = StepKind::kNoTime, .side = left ? Side::kRight : Side::kLeft};
    }
    std::array<WaitingFrames, 2> waiting;
    for (const Side side : kSides) {
      const auto index = static_cast<std::size_t>(side);
      const auto& duration = side == Side::kLeft ? durations_.left : durations_.right;
      const auto period = duration ? duration : duration_of(queue(side).front());
      const bool full = queue(side).size() >= FrameQueue::kCapacity;
      waiting[index] = {found.times[index], period.value_or(0),
                        found.complete[index] || deadline_ || full || has_ended(state_, side)};
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

/// Advances the output by the right stream if no left frame arrives.
void send_gap_for_right(ElementState& state, const QueuedFrame& right) {
  const auto time = right.running_time();
  if (!time || *time < 0) return;
  GstClockTime position = GST_CLOCK_TIME_NONE;
  {
    const ObjectLock lock(state.element);
    const GstSegment& segment = GST_AGGREGATOR_PAD(state.source_pad())->segment;
    if (segment.format == GST_FORMAT_TIME) {
      position = gst_segment_position_from_running_time(&segment, GST_FORMAT_TIME,
                                                        static_cast<guint64>(*time));
    }
  }
  send_gap(state, position, GST_BUFFER_DURATION(right.buffer.get()));
}

void send_gap_for_left(ElementState& state, const QueuedFrame& left) {
  adopt_segment(state, left.segment);
  send_gap(state, GST_BUFFER_PTS(left.buffer.get()), GST_BUFFER_DURATION(left.buffer.get()));
}

/// Counts and reports a dropped frame.
void after_drop(ElementState& state, Step& step) {
  const QueuedFrame& frame = step.frame();
  GST_DEBUG_OBJECT(state.input(step.side).pad, "%s, dropping %" GST_PTR_FORMAT,
                   step.wrong_time ? "wrong time stamp" : "no partner",
                   static_cast<void*>(frame.buffer.get()));
  {
    const ObjectLock lock(state.element);
    ++state.statistics.dropped[static_cast<std::size_t>(step.side)];
    if (step.wrong_time) ++state.statistics.wrong_times;
  }
  if (step.wrong_time || step.without_message) return;
  if (step.at_deadline) {
    if (step.side == Side::kLeft) {
      send_gap_for_left(state, frame);
    } else {
      send_gap_for_right(state, frame);
    }
    report_lateness(state, other_side(step.side));
    return;
  }
  report_difference(state, step.difference, step.tolerance);
}

/// Counts a pair that is not matched because a newer one has arrived.
void skip(ElementState& state) {
  const ObjectLock lock(state.element);
  ++state.statistics.skipped;
}

GstFlowReturn match(ElementState& state, const Step& pair) {
  state.unpaired_warning.paired();
  adopt_caps(state, Side::kLeft, pair.left.info);
  adopt_caps(state, Side::kRight, pair.right.info);
  adopt_segment(state, pair.left.segment);
  return match_pair(state, pair.left.buffer.get(), pair.right.buffer.get());
}

/// Reports a frame without a time. GST_FLOW_OK if the pairs go on: a change of `sync-mode` that
/// does not fit the streams is taken back.
GstFlowReturn report_missing_time(ElementState& state, const Step& step) {
  if (state.paired_mode != SyncMode::kReferenceTimestamp) {
    return refuse_mixed_stamping(state, step.side == Side::kRight);
  }
  const auto before = state.working_mode;
  if (!before || *before == state.paired_mode) return refuse_missing_reference(state, step.side);
  {
    const ObjectLock lock(state.element);
    if (state.settings.sync_mode == state.paired_mode) state.settings.sync_mode = *before;
  }
  warn_of_missing_reference(state, step.side);
  return GST_FLOW_OK;
}

/// In a live pipeline with the property `newest-pair`, pairs for which there is a newer one are
/// skipped.
bool only_newest(const ElementState& state) {
  return state.newest_pair && GST_CLOCK_TIME_IS_VALID(gst_aggregator_get_latency(state.element));
}

void publish(ElementState& state) {
  std::array<bool, 2> held{};
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    held = {state.queues[0].held() > 0, state.queues[1].held() > 0};
  }
  const ObjectLock lock(state.element);
  state.watchdog_input.held = held;
  state.statistics.difference = state.finder.offset().line().statistics();
}

/// Takes all steps that are possible now.
GstFlowReturn step_through(ElementState& state, Occasion occasion) {
  const bool newest = only_newest(state);
  std::optional<Step> pair;
  for (;;) {
    Step step = Stepper(state, occasion).next();
    if (occasion == Occasion::kDeadline) occasion = Occasion::kFrames;  // it is that of one frame
    report_doubt(state, step.doubt);
    const bool more = step.kind != StepKind::kWait && step.kind != StepKind::kEnd;
    if (step.kind == StepKind::kPair) {
      if (pair) skip(state);
      pair = std::move(step);
      if (newest) continue;
    }
    if (pair && (!newest || !more)) {
      const GstFlowReturn flow = match(state, *std::exchange(pair, std::nullopt));
      if (flow != GST_FLOW_OK) return flow;
      continue;
    }
    switch (step.kind) {
      case StepKind::kWait:
        return GST_AGGREGATOR_FLOW_NEED_DATA;
      case StepKind::kEnd:
        return GST_FLOW_EOS;
      case StepKind::kNoTime:
        if (const GstFlowReturn flow = report_missing_time(state, step); flow != GST_FLOW_OK) {
          return flow;
        }
        break;
      case StepKind::kDrop:
        after_drop(state, step);
        break;
      case StepKind::kGap:
        send_gap_for_left(state, step.left);
        break;
      default:
        break;
    }
  }
}

}  // namespace

GstFlowReturn aggregate(ElementState& state, bool timeout) {
  {
    const ObjectLock lock(state.element);
    if (state.failed) return GST_FLOW_ERROR;
  }
  if (state.pending_flow != GST_FLOW_OK) return state.pending_flow;
  const GstClockTime latency = gst_aggregator_get_latency(state.element);
  state.known_latency = GST_CLOCK_TIME_IS_VALID(latency) ? latency : 0;
  const GstFlowReturn flow = step_through(state, timeout ? Occasion::kDeadline : Occasion::kFrames);
  publish(state);
  return flow;
}

bool finish_stream(ElementState& state, Side side) {
  const GstFlowReturn flow = step_through(state, Occasion::kEnd);
  publish(state);
  if (flow == GST_FLOW_ERROR || flow == GST_FLOW_NOT_NEGOTIATED) state.pending_flow = flow;
  const std::lock_guard<std::mutex> lock(state.queue_mutex);
  return state.queue(side).empty();
}

GstClockTime next_deadline(ElementState& state) {
  std::optional<Nanoseconds> time;
  bool left = true;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    for (const Side side : kSides) {
      FrameQueue& queue = state.queue(side);
      queue.look(state.input(side).pad);
      if (queue.empty()) continue;
      const auto begin = queue.front().running_time();
      if (!begin) return GST_CLOCK_TIME_NONE;
      if (time && *time <= *begin) continue;
      time = begin;
      left = side == Side::kLeft;
    }
  }
  const auto now = running_time_now(state);
  if (!time || !now) return GST_CLOCK_TIME_NONE;
  const Nanoseconds deadline = state.waiting_frame.deadline(
      left, *time, *now, static_cast<Nanoseconds>(state.known_latency));
  return deadline > 0 ? static_cast<GstClockTime>(deadline) : 0;
}

}  // namespace mtstereo::plugin

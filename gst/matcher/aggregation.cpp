// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/aggregation.hpp"

#include <utility>

#include "matcher/clock.hpp"
#include "matcher/engine/matching.hpp"
#include "matcher/output/output_events.hpp"
#include "matcher/pairing/pair_steps.hpp"
#include "matcher/pairing_reports.hpp"
#include "matcher/streams.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

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
  GST_LOG_OBJECT(state.input(step.side).pad, "%s, dropping %" GST_PTR_FORMAT,
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
  log_offset(state);
  adopt_caps(state, Side::kLeft, pair.left.info);
  adopt_caps(state, Side::kRight, pair.right.info);
  adopt_segment(state, pair.left.segment);
  return match_pair(state, pair.left.buffer.get(), pair.right.buffer.get());
}

/// Reports a frame without a time. GST_FLOW_OK if pairing continues: a change of `sync-mode` that
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

/// True if frames wait that are no longer in the pads, so that the base class does not know of
/// them.
bool holds_frames(ElementState& state) {
  const std::lock_guard<std::mutex> lock(state.queue_mutex);
  return state.queues[0].held() > 0 || state.queues[1].held() > 0;
}

/// A flush or the end of the element is under way: the base class sends no buffer any more.
bool is_stopping(const ElementState& state) {
  GstPad* const pad = state.source_pad();
  return GST_PAD_IS_FLUSHING(pad) || !gst_pad_is_active(pad);
}

/// Does what a step other than a pair asks for. A value ends the call of aggregate() with it.
std::optional<GstFlowReturn> carry_out(ElementState& state, Step& step) {
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
  return std::nullopt;
}

/// Takes the steps that are possible now, up to the next map if the base class knows of all frames
/// that wait.
GstFlowReturn step_through(ElementState& state, Occasion occasion) {
  const bool newest = only_newest(state);
  std::optional<Step> pair;
  for (;;) {
    Step step = next_step(state, occasion);
    if (occasion == Occasion::kDeadline) occasion = Occasion::kFrames;  // it is that of one frame
    report_doubt(state, step.doubt);
    const bool last = step.kind == StepKind::kWait || step.kind == StepKind::kEnd;
    if (step.kind == StepKind::kPair) {
      if (pair) skip(state);
      pair = std::move(step);
      if (newest) continue;  // a newer one may follow
    } else if (!pair || !last) {
      if (const auto flow = carry_out(state, step)) return *flow;
      continue;
    }
    const GstFlowReturn flow = match(state, *std::exchange(pair, std::nullopt));
    if (flow != GST_FLOW_OK || !holds_frames(state)) return flow;
    if (is_stopping(state)) return GST_FLOW_FLUSHING;
  }
}

}  // namespace

GstFlowReturn aggregate(ElementState& state, bool timeout) {
  if (has_failed(state)) return GST_FLOW_ERROR;
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
  const Nanoseconds deadline =
      state.waiting_frame.deadline(left, *time, *now, bounded(state.known_latency));
  return deadline > 0 ? static_cast<GstClockTime>(deadline) : 0;
}

}  // namespace mtstereo::plugin

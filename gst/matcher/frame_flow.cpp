// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_flow.hpp"

#include <optional>
#include <utility>

#include "matcher/settings_in_use.hpp"
#include "matcher/stream_changes.hpp"
#include "matcher/stream_check.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

using Kind = PairingAction::Kind;

void send_gap_for_left(ElementState& state, const QueuedFrame& left) {
  adopt_segment(state, left.segment);
  state.output.events.send_gap(GST_BUFFER_PTS(left.buffer.get()),
                               GST_BUFFER_DURATION(left.buffer.get()));
}

/// Advances the output by the right stream if no left frame arrives.
void send_gap_for_right(ElementState& state, const QueuedFrame& right) {
  const auto time = right.running_time();
  if (time) state.output.events.send_gap_at(*time, GST_BUFFER_DURATION(right.buffer.get()));
}

LateFrame late_frame(const ElementState& state, Side side, const QueuedFrame& frame) {
  LateFrame late{.side = side};
  const auto now = state.clock.now();
  const auto time = frame.running_time();
  const GstClockTime latency = gst_aggregator_get_latency(state.element);
  if (now && time && GST_CLOCK_TIME_IS_VALID(latency)) {
    late.lateness = *now - *time - bounded(latency);
  }
  late.partner_linked = gst_pad_is_linked(GST_PAD_CAST(state.pairing.pad(other_side(side))));
  return late;
}

/// Reports a dropped frame.
void after_drop(ElementState& state, PairingAction& action) {
  const QueuedFrame& frame = action.frame();
  GST_LOG_OBJECT(state.pairing.pad(action.side), "%s, dropping %" GST_PTR_FORMAT,
                 action.wrong_time ? "wrong time stamp" : "no partner",
                 static_cast<void*>(frame.buffer.get()));
  state.pairing_reports.dropped(action.side);
  if (action.wrong_time) state.pairing_reports.wrong_time(action.side);
  if (action.wrong_time || action.expected) return;
  if (!action.at_deadline) {
    state.pairing_reports.unpaired(action.difference, action.tolerance);
    return;
  }
  if (action.side == Side::kLeft) {
    send_gap_for_left(state, frame);
  } else {
    send_gap_for_right(state, frame);
  }
  state.pairing_reports.late(late_frame(state, action.side, frame));
}

/// Reports a frame without a time. GST_FLOW_OK if pairing continues: a change of `sync-mode` that
/// does not fit the streams is taken back.
GstFlowReturn report_missing_time(ElementState& state, Side side) {
  const SyncMode mode = state.pairing.pairer().mode();
  if (mode != SyncMode::kReferenceTimestamp) {
    state.pairing_reports.refuse_mixed_stamping(side == Side::kRight);
    return GST_FLOW_ERROR;
  }
  const auto before = state.pairing.pairer().working_mode();
  if (!before || *before == mode) {
    state.pairing_reports.refuse_missing_reference(side);
    return GST_FLOW_ERROR;
  }
  {
    const ObjectLock lock(state.element);
    if (state.flow.sync_mode == mode) state.flow.sync_mode = *before;
    state.pairing.set_mode(state.flow.sync_mode);
  }
  state.pairing_reports.warn_of_missing_reference(side);
  return GST_FLOW_OK;
}

/// The caps of the left stream have changed since the base class has called, or settings have
/// changed since the last pair, some of which are part of the caps.
bool renegotiate(ElementState& state) {
  if (gst_pad_check_reconfigure(state.output.pad()) && !gst_aggregator_negotiate(state.element)) {
    return false;
  }
  const DisparityUnit last = state.engine.settings().unit();
  if (!apply_settings(state)) return false;
  if (state.engine.settings().unit() == last && gst_pad_has_current_caps(state.output.pad())) {
    return true;
  }
  return gst_aggregator_negotiate(state.element);
}

void refuse_memory(ElementState& state) {
  state.messages.error(GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_NO_SPACE_LEFT,
                       "There is not enough memory for a disparity map of " +
                           std::to_string(state.output.info().size) + " bytes.");
}

/// A pair is matched this long after the running time of its map.
void report_lateness(ElementState& state, Nanoseconds lateness) {
  const GstClockTime latency = gst_aggregator_get_latency(state.element);
  const MatchStatistics matched = state.engine.statistics();
  if (!GST_CLOCK_TIME_IS_VALID(latency) || matched.pairs == 0) return;
  const double mean = matched.total_ms / static_cast<double>(matched.pairs);  // [ms]
  state.pairing_reports.late_pair(lateness - bounded(latency),
                                  static_cast<Nanoseconds>(mean * 1e6));
}

/// The sources end with an error that names them only.
void warn_of_unlinked_output(ElementState& state) {
  if (gst_pad_is_linked(state.output.pad())) return;  // the fault is further downstream
  state.messages.warning(
      "There is no use for the maps: the pad src is not linked. Link it, for example by "
      "\"! mtcolor ! videoconvert ! autovideosink\".");
}

/// A pair passes the engine and the output.
GstFlowReturn match(ElementState& state, GstBuffer* left, GstBuffer* right) {
  const OutputTimes times = state.output.times(left);
  if (const auto now = state.clock.now(); now && GST_CLOCK_TIME_IS_VALID(times.running)) {
    state.pairing_reports.matches(bounded(times.running), *now);
    report_lateness(state, *now - bounded(times.running));
  }
  if (GST_CLOCK_TIME_IS_VALID(times.stream)) {
    gst_object_sync_values(GST_OBJECT_CAST(state.element), times.stream);
  }
  if (!check_streams(state)) return GST_FLOW_ERROR;
  if (!renegotiate(state)) {
    // A flush in the meantime is not a failure; the base class handles it.
    return GST_PAD_IS_FLUSHING(state.output.pad()) ? GST_FLOW_FLUSHING : GST_FLOW_ERROR;
  }
  // No gap is sent: a sink would wait until the time of the gap, and more pairs would be late.
  if (state.flow_settings().qos &&
      state.output.punctuality.skip_if_late(left, times, state.engine.statistics().pairs)) {
    return GST_FLOW_OK;
  }
  const gint64 start = g_get_monotonic_time();
  gst_aggregator_selected_samples(state.element, GST_BUFFER_PTS(left), GST_CLOCK_TIME_NONE,
                                  GST_BUFFER_DURATION(left), nullptr);
  BufferPointer map;
  GstFlowReturn flow = state.output.make_map(left, right, map);
  if (flow == GST_FLOW_ERROR) refuse_memory(state);
  if (flow != GST_FLOW_OK) return flow;
  flow = state.engine.match(left, right, map.get(), state.output.info());
  if (flow != GST_FLOW_OK) return flow;
  flow = state.output.send(std::move(map), times,
                           static_cast<double>(g_get_monotonic_time() - start) / 1000);
  if (flow == GST_FLOW_NOT_LINKED) warn_of_unlinked_output(state);
  return flow;
}

GstFlowReturn match(ElementState& state, const PairingAction& pair) {
  state.pairing_reports.paired();
  for (const auto& [side, frame] :
       {std::pair{Side::kLeft, &pair.left}, {Side::kRight, &pair.right}}) {
    state.pairing_reports.frame(
        side, GST_BUFFER_FLAG_IS_SET(frame->buffer.get(), GST_BUFFER_FLAG_CORRUPTED));
  }
  adopt_caps(state, Side::kLeft, pair.left.info);
  adopt_caps(state, Side::kRight, pair.right.info);
  adopt_segment(state, pair.left.segment);
  return match(state, pair.left.buffer.get(), pair.right.buffer.get());
}

/// No pair can follow. Downstream may block the end of the output for long, which a source must not
/// wait for: it ends with its next frame.
GstFlowReturn end(ElementState& state) {
  state.pairing_reports.ended();
  for (const Side side : kSides) state.pairing.refuse(side);
  if (state.end_seqnum) state.output.events.end(*state.end_seqnum);
  return GST_FLOW_EOS;
}

/// Does what an action other than a pair asks for. A value ends the call of aggregate() with it.
std::optional<GstFlowReturn> carry_out(ElementState& state, PairingAction& action) {
  switch (action.kind) {
    case Kind::kWait:
      return GST_AGGREGATOR_FLOW_NEED_DATA;
    case Kind::kEnd:
      return end(state);
    case Kind::kNoTime:
      if (const GstFlowReturn flow = report_missing_time(state, action.side); flow != GST_FLOW_OK) {
        return flow;
      }
      break;
    case Kind::kDrop:
      after_drop(state, action);
      break;
    case Kind::kGap:
      send_gap_for_left(state, action.left);
      break;
    default:
      break;
  }
  return std::nullopt;
}

/// Does what is possible now, up to the next map if the base class knows of all frames that wait.
GstFlowReturn step_through(ElementState& state, Trigger trigger) {
  const bool newest = state.flow_settings().newest_pair && state.clock.is_live();
  std::optional<PairingAction> pair;
  for (;;) {
    PairingAction action = state.pairing.next(trigger);
    if (trigger == Trigger::kDeadline) trigger = Trigger::kFrames;  // it is that of one frame
    state.pairing_reports.doubt(action.doubt);
    const bool last = action.kind == Kind::kWait || action.kind == Kind::kEnd;
    if (action.kind == Kind::kPair) {
      if (pair) state.output.punctuality.skip();  // a newer one has arrived
      pair = std::move(action);
      if (newest) continue;  // a newer one may follow
    } else if (!pair || !last) {
      if (const auto flow = carry_out(state, action)) return *flow;
      continue;
    }
    const GstFlowReturn flow = match(state, *std::exchange(pair, std::nullopt));
    // Frames that are no longer in the pads wait unknown to the base class.
    if (flow != GST_FLOW_OK || !state.pairing.holds_any()) return flow;
    if (state.output.is_stopping()) return GST_FLOW_FLUSHING;
  }
}

}  // namespace

GstFlowReturn aggregate(ElementState& state, bool timeout) {
  if (state.messages.failed()) return GST_FLOW_ERROR;
  if (state.pending_flow != GST_FLOW_OK) return state.pending_flow;
  state.pairing.set_latency(gst_aggregator_get_latency(state.element));
  return step_through(state, timeout ? Trigger::kDeadline : Trigger::kFrames);
}

GstClockTime next_deadline(ElementState& state) {
  const auto now = state.clock.now();
  if (!now) return GST_CLOCK_TIME_NONE;
  const auto deadline = state.pairing.deadline(*now);
  if (!deadline) return GST_CLOCK_TIME_NONE;
  return *deadline > 0 ? static_cast<GstClockTime>(*deadline) : 0;
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/aggregation.hpp"

#include <cstdio>

#include "matcher/clock.hpp"
#include "matcher/matching.hpp"
#include "matcher/output_events.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

BufferPointer peek(const Input& input) {
  return BufferPointer(gst_aggregator_pad_peek_buffer(input.pad));
}

bool is_gap(GstBuffer* buffer) { return GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_GAP); }

/// The running time of a frame in the segment of its pad; std::nullopt without a time stamp. It is
/// negative for a frame that begins before the segment.
std::optional<Nanoseconds> running_time(const Input& input, GstBuffer* buffer) {
  if (!GST_BUFFER_PTS_IS_VALID(buffer)) return std::nullopt;
  const ObjectLock lock(input.pad);
  if (input.pad->segment.format != GST_FORMAT_TIME) return std::nullopt;
  guint64 time = 0;
  const int sign = gst_segment_to_running_time_full(&input.pad->segment, GST_FORMAT_TIME,
                                                    GST_BUFFER_PTS(buffer), &time);
  if (sign == 0) return std::nullopt;
  return sign * static_cast<Nanoseconds>(time);
}

std::optional<Nanoseconds> duration_of(GstBuffer* buffer) {
  if (!GST_BUFFER_DURATION_IS_VALID(buffer)) return std::nullopt;
  return static_cast<Nanoseconds>(GST_BUFFER_DURATION(buffer));
}

std::string milliseconds(Nanoseconds time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(time) / 1e6);
  return text;
}

/// Advances the output by the right stream if no left frame arrives.
void send_gap_for_right(ElementState& state, GstBuffer* right) {
  const auto time = running_time(state.input(Side::kRight), right);
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
  send_gap(state, position, GST_BUFFER_DURATION(right));
}

/// Drops the head of a pad because it has no partner.
void drop(ElementState& state, Side side, GstBuffer* buffer) {
  const Input& input = state.input(side);
  GST_DEBUG_OBJECT(input.pad, "no partner, dropping %" GST_PTR_FORMAT, static_cast<void*>(buffer));
  gst_aggregator_pad_drop_buffer(input.pad);
  const ObjectLock lock(state.element);
  ++state.statistics.dropped[static_cast<std::size_t>(side)];
}

void warn_of_difference(ElementState& state, const PairingDecision& decision,
                        Nanoseconds tolerance) {
  if (!state.unpaired_warning.dropped(g_get_monotonic_time() * 1000)) return;
  post_warning(
      state,
      "The last " + std::to_string(state.unpaired_warning.run()) +
          " frames had no partner within the tolerance of " + milliseconds(tolerance) +
          ". If the cameras are not triggered together, increase sync-tolerance; if the skew "
          "between the streams is constant, set the property offset of a pad "
          "(sink_right::offset).",
      "the right frame is " + milliseconds(decision.difference) +
          " after the left frame (negative: before), tolerance " + milliseconds(tolerance) + "; " +
          state.streams_text());
}

void warn_of_silence(ElementState& state, Side silent) {
  if (!state.unpaired_warning.dropped(g_get_monotonic_time() * 1000)) return;
  post_warning(state,
               "The last " + std::to_string(state.unpaired_warning.run()) +
                   " frames had no partner, because no frame arrived in time on " +
                   pad_name(silent) +
                   ". If that stream is only delayed, increase the property latency.",
               state.streams_text());
}

/// Drops a frame whose partner has not arrived by the deadline of a live stream.
void drop_at_deadline(ElementState& state, Side side, GstBuffer* buffer) {
  drop(state, side, buffer);
  if (side == Side::kLeft) {
    send_gap(state, GST_BUFFER_PTS(buffer), GST_BUFFER_DURATION(buffer));
    warn_of_silence(state, Side::kRight);
  } else {
    send_gap_for_right(state, buffer);
    warn_of_silence(state, Side::kLeft);
  }
}

/// Drops gap buffers, which have no image. False if neither head is one.
bool take_gaps(ElementState& state, GstBuffer* left, GstBuffer* right) {
  bool taken = false;
  if (left != nullptr && is_gap(left)) {
    gst_aggregator_pad_drop_buffer(state.input(Side::kLeft).pad);
    send_gap(state, GST_BUFFER_PTS(left), GST_BUFFER_DURATION(left));
    taken = true;
  }
  if (right != nullptr && is_gap(right)) {
    gst_aggregator_pad_drop_buffer(state.input(Side::kRight).pad);
    taken = true;
  }
  return taken;
}

bool ended(const Input& input, GstBuffer* head) {
  return head == nullptr && gst_aggregator_pad_is_eos(input.pad);
}

/// One stream has ended: the frame at the head of the other one has no partner.
GstFlowReturn end(ElementState& state, GstBuffer* left, GstBuffer* right) {
  if (left != nullptr) drop(state, Side::kLeft, left);
  if (right != nullptr) drop(state, Side::kRight, right);
  return GST_FLOW_EOS;
}

GstFlowReturn refuse_mixed_stamping(ElementState& state, bool left_has_time) {
  post_error(state, GST_STREAM_ERROR, GST_STREAM_ERROR_FAILED,
             std::string("The frames of ") + (left_has_time ? "sink_left" : "sink_right") +
                 " have time stamps and those of " + (left_has_time ? "sink_right" : "sink_left") +
                 " have none, so they cannot be paired. Provide time stamps on both streams (for "
                 "example by appsrc do-timestamp=true) or on neither.",
             state.streams_text());
  return GST_FLOW_ERROR;
}

GstFlowReturn pair_heads(ElementState& state, GstBuffer* left, GstBuffer* right) {
  const auto left_time = running_time(state.input(Side::kLeft), left);
  const auto right_time = running_time(state.input(Side::kRight), right);
  Nanoseconds tolerance = 0;
  {
    const ObjectLock lock(state.element);
    tolerance = effective_tolerance(state.settings.sync_tolerance, state.caps_durations,
                                    {duration_of(left), duration_of(right)});
  }
  const PairingDecision decision = decide_pairing(left_time, right_time, tolerance);
  switch (decision.action) {
    case PairingAction::kMixedStamping:
      return refuse_mixed_stamping(state, left_time.has_value());
    case PairingAction::kDropLeft:
      drop(state, Side::kLeft, left);
      warn_of_difference(state, decision, tolerance);
      return GST_AGGREGATOR_FLOW_NEED_DATA;
    case PairingAction::kDropRight:
      drop(state, Side::kRight, right);
      warn_of_difference(state, decision, tolerance);
      return GST_AGGREGATOR_FLOW_NEED_DATA;
    case PairingAction::kPair:
      break;
  }
  state.unpaired_warning.paired();
  const GstFlowReturn flow = match_pair(state, left, right);
  gst_aggregator_pad_drop_buffer(state.input(Side::kLeft).pad);
  gst_aggregator_pad_drop_buffer(state.input(Side::kRight).pad);
  return flow;
}

}  // namespace

GstFlowReturn aggregate(ElementState& state, bool timeout) {
  {
    const ObjectLock lock(state.element);
    if (state.failed) return GST_FLOW_ERROR;
  }
  const GstClockTime latency = gst_aggregator_get_latency(state.element);
  state.known_latency = GST_CLOCK_TIME_IS_VALID(latency) ? latency : 0;
  const BufferPointer left = peek(state.input(Side::kLeft));
  const BufferPointer right = peek(state.input(Side::kRight));
  if (take_gaps(state, left.get(), right.get())) return GST_AGGREGATOR_FLOW_NEED_DATA;
  if (left && right) return pair_heads(state, left.get(), right.get());
  if (ended(state.input(Side::kLeft), left.get()) ||
      ended(state.input(Side::kRight), right.get())) {
    return end(state, left.get(), right.get());
  }
  if (timeout && left) drop_at_deadline(state, Side::kLeft, left.get());
  if (timeout && right) drop_at_deadline(state, Side::kRight, right.get());
  return GST_AGGREGATOR_FLOW_NEED_DATA;
}

GstClockTime next_deadline(ElementState& state) {
  const BufferPointer left = peek(state.input(Side::kLeft));
  const BufferPointer right = peek(state.input(Side::kRight));
  if ((left == nullptr) == (right == nullptr)) return GST_CLOCK_TIME_NONE;
  const Input& input = state.input(left ? Side::kLeft : Side::kRight);
  const auto time = running_time(input, left ? left.get() : right.get());
  const auto now = running_time_now(state);
  if (!time || !now) return GST_CLOCK_TIME_NONE;
  const Nanoseconds deadline = state.waiting_frame.deadline(
      left != nullptr, *time, *now, static_cast<Nanoseconds>(state.known_latency));
  return deadline > 0 ? static_cast<GstClockTime>(deadline) : 0;
}

}  // namespace mtstereo::plugin

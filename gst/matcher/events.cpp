// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/events.hpp"

#include "matcher/frame_flow.hpp"
#include "matcher/negotiation.hpp"
#include "matcher/stream_changes.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

bool take_caps(ElementState& state, Side side, GstEvent* event) {
  GstCaps* caps = nullptr;
  gst_event_parse_caps(event, &caps);
  const bool taken = take_sink_caps(state, side, caps);
  gst_event_unref(event);
  return taken;
}

bool refuse_segment(ElementState& state, Side side, GstEvent* event, GstFormat format) {
  state.messages.error(
      GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT,
      std::string("The segment of ") + pad_name(side) + " is in " + gst_format_get_name(format) +
          ", but frames are paired by time: put a parser (such as rawvideoparse) upstream "
          "of it, or set format=time if the source is an appsrc, is-live=true and "
          "do-timestamp=true if it is a shmsrc.");
  gst_event_unref(event);
  return false;
}

/// With a longer offset, the clock of a sink cannot wait for the running times of the maps.
constexpr gint64 kLongestOffset = gint64{1} << 61;  // 73 years [ns]

bool refuse_offset(ElementState& state, Side side, GstEvent* event, gint64 offset) {
  state.messages.error(GST_LIBRARY_ERROR, GST_LIBRARY_ERROR_SETTINGS,
                       std::string(pad_name(side)) + "::offset is " + std::to_string(offset) +
                           " ns, but an offset must be between -" + std::to_string(kLongestOffset) +
                           " and " + std::to_string(kLongestOffset) +
                           " ns: set it to the delay between the streams, or 0.");
  gst_event_unref(event);
  return false;
}

bool take_segment(ElementState& state, GstAggregatorPad* pad, GstEvent* event) {
  const Side side = state.pairing.side_of(pad);
  const gint64 offset = gst_pad_get_offset(GST_PAD_CAST(pad));
  if (offset < -kLongestOffset || offset > kLongestOffset) {
    return refuse_offset(state, side, event, offset);
  }
  const GstSegment* segment = nullptr;
  gst_event_parse_segment(event, &segment);
  if (segment->format != GST_FORMAT_TIME) {
    return refuse_segment(state, side, event, segment->format);
  }
  const GstSegment copy = *segment;
  const guint32 seqnum = gst_event_get_seqnum(event);
  if (!state.base_class->sink_event(state.element, pad, event)) return false;
  take_stream_segment(state, side, copy, seqnum);
  return true;
}

/// Notes the end of a stream; aggregate() matches the frames that still have partners. The base
/// class of GStreamer 1.22 calls it only when each pad has a frame or has ended: while the other
/// stream is silent, which may last forever, aggregate() is called from here, in the same task.
bool take_end(ElementState& state, GstAggregatorPad* pad, GstEvent* event) {
  const Side other = other_side(state.pairing.side_of(pad));
  if (!state.end_seqnum) state.end_seqnum = gst_event_get_seqnum(event);
  const bool taken = state.base_class->sink_event(state.element, pad, event) != FALSE;
  if (state.messages.failed()) {
    // Both sources get the error before downstream has taken the end. For that a sink may need an
    // application that waits for the other source, as gst-launch-1.0 -e does.
    state.pairing.refuse(other);
    state.output.events.end(*state.end_seqnum);
  } else if (!state.pairing.has_news(other)) {
    const GstFlowReturn flow = aggregate(state, false);
    if (flow == GST_FLOW_ERROR || flow == GST_FLOW_NOT_NEGOTIATED) state.pending_flow = flow;
  }
  return taken;
}

/// A gap in no segment has no running time. The base class would report a programming error.
bool is_outside_of_segments(GstAggregatorPad* pad) {
  const ObjectLock lock(pad);
  return pad->segment.format != GST_FORMAT_TIME;
}

void note_seek(ElementState& state, GstEvent* event) {
  GstSeekFlags flags = GST_SEEK_FLAG_NONE;
  gst_event_parse_seek(event, nullptr, nullptr, &flags, nullptr, nullptr, nullptr, nullptr);
  state.pairing.note_seek(gst_event_get_seqnum(event), (flags & GST_SEEK_FLAG_FLUSH) != 0);
}

}  // namespace

bool handle_sink_event(ElementState& state, GstAggregatorPad* pad, GstEvent* event) {
  switch (GST_EVENT_TYPE(event)) {
    case GST_EVENT_CAPS:
      return take_caps(state, state.pairing.side_of(pad), event);
    case GST_EVENT_SEGMENT:
      return take_segment(state, pad, event);
    case GST_EVENT_EOS:
      return take_end(state, pad, event);
    case GST_EVENT_FLUSH_STOP:
      state.pairing.clear(state.pairing.side_of(pad));
      break;
    case GST_EVENT_GAP:
      if (!is_outside_of_segments(pad)) break;
      gst_event_unref(event);
      return true;
    case GST_EVENT_SEGMENT_DONE:
      // The output follows the left stream: only the end of its segment is passed on.
      if (state.pairing.side_of(pad) == Side::kLeft) break;
      gst_event_unref(event);
      return true;
    default:
      break;
  }
  return state.base_class->sink_event(state.element, pad, event) != FALSE;
}

void before_sink_event(ElementState& state, GstAggregatorPad* pad, GstEvent* event) {
  // The end of a stream is handled after its frames. After a failure nobody takes them any more.
  if (GST_EVENT_TYPE(event) == GST_EVENT_EOS && state.messages.failed()) {
    state.pairing.refuse(state.pairing.side_of(pad));
  }
}

bool handle_source_event(ElementState& state, GstEvent* event) {
  switch (GST_EVENT_TYPE(event)) {
    case GST_EVENT_QOS:
      state.output.punctuality.note_qos_event(event);
      if (state.flow_settings().qos) break;
      gst_event_unref(event);  // the sources must not drop frames either
      return true;
    case GST_EVENT_LATENCY:
      state.output.punctuality.note_latency_event(event);
      break;
    case GST_EVENT_SEEK:
      note_seek(state, event);
      break;
    default:
      break;
  }
  return state.base_class->src_event(state.element, event) != FALSE;
}

}  // namespace mtstereo::plugin

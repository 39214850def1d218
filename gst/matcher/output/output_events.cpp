// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/output_events.hpp"

#include <cstdio>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

/// Sends the segment if it is due. False if there is none: then no other event may be sent.
bool send_segment(ElementState& state) {
  if (state.segment == OutputSegment::kWaiting) {
    GstEvent* event = nullptr;
    {
      const ObjectLock lock(state.element);
      event = gst_event_new_segment(&GST_AGGREGATOR_PAD(state.source_pad())->segment);
    }
    gst_event_set_seqnum(event, state.segment_seqnum);
    state.segment_repeats = false;
    gst_pad_push_event(state.source_pad(), event);
    state.segment_repeats = true;
    state.segment = OutputSegment::kSent;
  }
  return state.segment == OutputSegment::kSent;
}

/// Drops the events that the base class sends before a buffer or the end if the element has sent
/// them already. After a second start of the stream, a sink would wait for a second end.
GstPadProbeReturn on_output_event(GstPad*, GstPadProbeInfo* info, gpointer data) noexcept {
  auto& state = *static_cast<ElementState*>(data);
  GstEvent* const event = GST_PAD_PROBE_INFO_EVENT(info);
  const GstEventType type = GST_EVENT_TYPE(event);
  const bool segment = type == GST_EVENT_SEGMENT && state.segment_repeats;
  const bool start = type == GST_EVENT_STREAM_START && state.start_repeats;
  if (!segment && !start) return GST_PAD_PROBE_OK;
  (segment ? state.segment_repeats : state.start_repeats) = false;
  gst_event_unref(event);
  return GST_PAD_PROBE_HANDLED;  // a sticky event that is dropped would be sent again
}

}  // namespace

void watch_output(ElementState& state) {
  gst_pad_add_probe(state.source_pad(), GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, on_output_event,
                    &state, nullptr);
}

void end_output(ElementState& state, guint32 seqnum) {
  GstPad* pad = state.source_pad();
  const CapsPointer caps(gst_pad_get_current_caps(pad));
  if (caps) {
    if (!send_segment(state)) return;  // the base class sends the event
  } else if (GstEvent* start = gst_pad_get_sticky_event(pad, GST_EVENT_STREAM_START, 0)) {
    gst_event_unref(start);
  } else {
    // There was no output: the base class would send nothing while the other stream is silent.
    char id[32];
    std::snprintf(id, sizeof id, "mtstereo-%08x", g_random_int());
    gst_pad_push_event(pad, gst_event_new_stream_start(id));
    state.start_repeats = true;
  }
  GstEvent* end = gst_event_new_eos();
  gst_event_set_seqnum(end, seqnum);
  gst_pad_push_event(pad, end);
}

void send_gap(ElementState& state, GstClockTime pts, GstClockTime duration) {
  GstPad* pad = state.source_pad();
  const CapsPointer caps(gst_pad_get_current_caps(pad));
  // Without caps the stream has not started, and a gap needs a time.
  if (!caps || !GST_CLOCK_TIME_IS_VALID(pts) || !send_segment(state)) return;
  gst_pad_push_event(pad, gst_event_new_gap(pts, duration));
}

}  // namespace mtstereo::plugin

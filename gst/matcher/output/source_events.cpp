// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/output/source_events.hpp"

#include <cstdio>

#include "shared/ownership.hpp"

namespace mtstereo::plugin {

SourceEvents::SourceEvents(GstAggregator* element) : element_(element) {
  gst_pad_add_probe(pad(), GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, on_event, this, nullptr);
}

/// Drops the events that this object has sent already.
GstPadProbeReturn SourceEvents::on_event(GstPad*, GstPadProbeInfo* info, gpointer data) noexcept {
  auto& self = *static_cast<SourceEvents*>(data);
  GstEvent* const event = GST_PAD_PROBE_INFO_EVENT(info);
  const GstEventType type = GST_EVENT_TYPE(event);
  const bool segment = type == GST_EVENT_SEGMENT && self.segment_repeats_;
  const bool start = type == GST_EVENT_STREAM_START && self.start_repeats_;
  if (!segment && !start) return GST_PAD_PROBE_OK;
  (segment ? self.segment_repeats_ : self.start_repeats_) = false;
  gst_event_unref(event);
  return GST_PAD_PROBE_HANDLED;  // a sticky event that is dropped would be sent again
}

bool SourceEvents::adopt_segment(const std::shared_ptr<const StreamSegment>& segment) {
  if (!segment || segment == adopted_) return false;
  adopted_ = segment;
  gst_aggregator_update_segment(element_, &segment->segment);
  segment_ = Segment::kWaiting;
  segment_repeats_ = false;
  return true;
}

/// Sends the segment if it is due. False if no segment is known: then no other event may be sent.
bool SourceEvents::send_segment() {
  if (segment_ == Segment::kWaiting) {
    GstEvent* event = nullptr;
    {
      const ObjectLock lock(element_);
      event = gst_event_new_segment(&GST_AGGREGATOR_PAD(pad())->segment);
    }
    gst_event_set_seqnum(event, adopted_->seqnum);
    segment_repeats_ = false;
    gst_pad_push_event(pad(), event);
    segment_repeats_ = true;
    segment_ = Segment::kSent;
  }
  return segment_ == Segment::kSent;
}

void SourceEvents::end(guint32 seqnum) {
  const CapsPointer caps(gst_pad_get_current_caps(pad()));
  if (caps) {
    if (!send_segment()) return;  // the base class sends the event
  } else if (GstEvent* start = gst_pad_get_sticky_event(pad(), GST_EVENT_STREAM_START, 0)) {
    gst_event_unref(start);
  } else {
    // There was no output: the base class would send nothing while the other stream is silent.
    char id[32];
    std::snprintf(id, sizeof id, "mtstereo-%08x", g_random_int());
    gst_pad_push_event(pad(), gst_event_new_stream_start(id));
    start_repeats_ = true;
  }
  GstEvent* end = gst_event_new_eos();
  gst_event_set_seqnum(end, seqnum);
  gst_pad_push_event(pad(), end);
}

void SourceEvents::send_gap(GstClockTime pts, GstClockTime duration) {
  const CapsPointer caps(gst_pad_get_current_caps(pad()));
  // Without caps the stream has not started, and a gap needs a time.
  if (!caps || !GST_CLOCK_TIME_IS_VALID(pts) || !send_segment()) return;
  gst_pad_push_event(pad(), gst_event_new_gap(pts, duration));
}

void SourceEvents::send_gap_at(Nanoseconds running_time, GstClockTime duration) {
  if (running_time < 0) return;
  GstClockTime position = GST_CLOCK_TIME_NONE;
  {
    const ObjectLock lock(element_);
    const GstSegment& segment = GST_AGGREGATOR_PAD(pad())->segment;
    if (segment.format == GST_FORMAT_TIME) {
      position = gst_segment_position_from_running_time(&segment, GST_FORMAT_TIME,
                                                        static_cast<guint64>(running_time));
    }
  }
  send_gap(position, duration);
}

void SourceEvents::restart() {
  segment_ = Segment::kNone;
  segment_repeats_ = false;
  adopted_.reset();
}

void SourceEvents::start() {
  restart();
  start_repeats_ = false;
}

}  // namespace mtstereo::plugin

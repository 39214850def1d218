// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/left_pad.hpp"

#include <algorithm>
#include <utility>

#include "shared/caps_check.hpp"
#include "shared/exception_guard.hpp"
#include "shared/running_time.hpp"

namespace mtstereo::plugin {
namespace {

LeftStream& stream_of(GstPad* pad) {
  return *static_cast<LeftStream*>(gst_pad_get_element_private(pad));
}

// GstPad's functions have the pad as first argument; guarded<> reports to the element.

GstFlowReturn chain(GstObject* parent, GstPad* pad, GstBuffer* buffer) {
  LeftStream& stream = stream_of(pad);
  LeftFrame frame;
  frame.buffer.reset(buffer);
  if (!stream.has_caps) {
    GST_ELEMENT_ERROR(parent, CORE, NEGOTIATION,
                      ("The left view has no caps: put a capsfilter or a decoder upstream of "
                       "sink_left."),
                      (nullptr));
    return GST_FLOW_NOT_NEGOTIATED;
  }
  frame.info = stream.info;
  frame.time = to_running_time(stream.segment, GST_BUFFER_PTS(buffer));
  return stream.frames.push(std::move(frame));
}

bool take_caps(LeftStream& stream, GstEvent* event) {
  GstCaps* caps = nullptr;
  gst_event_parse_caps(event, &caps);
  stream.has_caps = gst_video_info_from_caps(&stream.info, caps);
  return stream.has_caps;
}

void take_gap(LeftStream& stream, GstEvent* event) {
  GstClockTime start = GST_CLOCK_TIME_NONE;
  GstClockTime duration = GST_CLOCK_TIME_NONE;
  gst_event_parse_gap(event, &start, &duration);
  if (!GST_CLOCK_TIME_IS_VALID(start)) return;
  if (!GST_CLOCK_TIME_IS_VALID(duration)) duration = 0;
  constexpr GstClockTime kLast = GST_CLOCK_TIME_NONE - 1;
  const auto end = to_running_time(stream.segment, start + std::min(duration, kLast - start));
  if (end) stream.frames.skip_to(*end);
}

gboolean event(GstObject* parent, GstPad* pad, GstEvent* event) {
  LeftStream& stream = stream_of(pad);
  gboolean taken = TRUE;
  if (!allows_caps(parent, pad, event, FrameKind::kView)) {
    gst_event_unref(event);
    return FALSE;
  }
  switch (GST_EVENT_TYPE(event)) {
    case GST_EVENT_CAPS:
      taken = take_caps(stream, event);
      break;
    case GST_EVENT_SEGMENT:
      gst_event_copy_segment(event, &stream.segment);
      break;
    case GST_EVENT_GAP:
      take_gap(stream, event);
      break;
    case GST_EVENT_EOS:
      stream.frames.end();
      break;
    case GST_EVENT_FLUSH_START:
      stream.frames.set_flushing(true);
      break;
    case GST_EVENT_FLUSH_STOP:
      gst_segment_init(&stream.segment, GST_FORMAT_UNDEFINED);
      stream.frames.set_flushing(false);
      break;
    default:
      break;
  }
  gst_event_unref(event);
  return taken;
}

gboolean query(GstObject* parent, GstPad* pad, GstQuery* query) {
  if (accepts_all_caps(query)) return TRUE;
  if (GST_QUERY_TYPE(query) != GST_QUERY_ALLOCATION) {
    return gst_pad_query_default(pad, parent, query);
  }
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  return TRUE;
}

/// With the arguments in the order of GstPad.
template <auto kFunction, auto kFallback>
struct PadFunction;

template <typename Result, typename Argument, Result (*kFunction)(GstObject*, GstPad*, Argument),
          auto kFallback>
struct PadFunction<kFunction, kFallback> {
  static Result call(GstPad* pad, GstObject* parent, Argument argument) noexcept {
    return guarded<kFunction, kFallback>(parent, pad, argument);
  }
};

/// It is called before the pad waits for its streaming thread, which may wait in push().
gboolean activate(GstPad* pad, GstObject*, GstPadMode mode, gboolean active) noexcept {
  if (mode != GST_PAD_MODE_PUSH) return FALSE;
  LeftStream& stream = stream_of(pad);
  if (active == TRUE) {
    stream.has_caps = false;
    gst_segment_init(&stream.segment, GST_FORMAT_UNDEFINED);
  }
  stream.frames.set_flushing(active == FALSE);
  return TRUE;
}

}  // namespace

GstPad* add_left_pad(GstElement* element, LeftStream& stream) {
  GstPadTemplate* pad_template =
      gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(element), kLeftPad);
  GstPad* pad = gst_pad_new_from_template(pad_template, kLeftPad);
  gst_pad_set_element_private(pad, &stream);
  gst_pad_set_chain_function(pad, (PadFunction<chain, GST_FLOW_ERROR>::call));
  gst_pad_set_event_function(pad, (PadFunction<event, FALSE>::call));
  gst_pad_set_query_function(pad, (PadFunction<query, FALSE>::call));
  gst_pad_set_activatemode_function(pad, activate);
  gst_element_add_pad(element, pad);
  return pad;
}

}  // namespace mtstereo::plugin

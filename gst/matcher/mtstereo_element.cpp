// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/mtstereo_element.hpp"

#include <exception>

#include "matcher/element_properties.hpp"
#include "matcher/element_state.hpp"
#include "shared/frame_views.hpp"

using mtstereo::Side;
using namespace mtstereo::plugin;

GST_DEBUG_CATEGORY(mtstereo_debug);
#define GST_CAT_DEFAULT mtstereo_debug

namespace {

struct GstMtStereo {
  GstAggregator parent;
  ElementState* state;
};

struct GstMtStereoClass {
  GstAggregatorClass parent_class;
};

void child_proxy_init(gpointer interface, gpointer);

}  // namespace

G_DEFINE_TYPE_WITH_CODE(GstMtStereo, mtstereo_element, GST_TYPE_AGGREGATOR,
                        G_IMPLEMENT_INTERFACE(GST_TYPE_CHILD_PROXY, child_proxy_init))

namespace {

ElementState& state_of(gpointer element) { return *reinterpret_cast<GstMtStereo*>(element)->state; }

GstAggregatorClass* parent_class() { return GST_AGGREGATOR_CLASS(mtstereo_element_parent_class); }

/// Runs what may allocate: no exception leaves the element.
template <typename T, typename Function>
T guarded(gpointer element, T fallback, Function function) noexcept {
  try {
    return function(state_of(element));
  } catch (const std::exception& error) {
    GST_ELEMENT_ERROR(element, LIBRARY, FAILED, ("A frame could not be handled: %s.", error.what()),
                      ("an exception reached the element"));
  } catch (...) {
    GST_ELEMENT_ERROR(element, LIBRARY, FAILED, ("A frame could not be handled."),
                      ("an unknown exception reached the element"));
  }
  ObjectLock lock(element);
  state_of(element).failed = true;
  return fallback;
}

// --- properties ---

void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  guarded(object, 0, [&](ElementState& state) {
    set_element_property(state, id, value, spec);
    return 0;
  });
}

void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  guarded(object, 0, [&](ElementState& state) {
    get_element_property(state, id, value, spec);
    return 0;
  });
}

// --- events and queries ---

gboolean refuse_segment(ElementState& state, Side side, GstEvent* event, GstFormat format) {
  post_error(state, GST_STREAM_ERROR, GST_STREAM_ERROR_FORMAT,
             std::string("The stream of ") + pad_name(side) + " is counted in " +
                 gst_format_get_name(format) +
                 ", a time line is needed to pair its frames: put a parser (such as "
                 "rawvideoparse) ahead of it, or set format=time where it is an appsrc.",
             state.streams_text());
  gst_event_unref(event);
  return FALSE;
}

gboolean take_segment(ElementState& state, Side side, GstAggregatorPad* pad, GstEvent* event) {
  const GstSegment* segment = nullptr;
  gst_event_parse_segment(event, &segment);
  if (segment->format != GST_FORMAT_TIME) {
    return refuse_segment(state, side, event, segment->format);
  }
  const GstSegment copy = *segment;
  const guint32 seqnum = gst_event_get_seqnum(event);
  if (!parent_class()->sink_event(state.element, pad, event)) return FALSE;
  if (side == Side::kRight) return TRUE;
  gst_aggregator_update_segment(state.element, &copy);
  state.segment = OutputSegment::kWaiting;
  state.segment_seqnum = seqnum;
  const ObjectLock lock(state.element);
  state.qos_earliest = GST_CLOCK_TIME_NONE;
  return TRUE;
}

gboolean sink_event(GstAggregator* aggregator, GstAggregatorPad* pad, GstEvent* event) {
  return guarded(aggregator, FALSE, [&](ElementState& state) -> gboolean {
    const Side side = pad == state.input(Side::kLeft).pad ? Side::kLeft : Side::kRight;
    switch (GST_EVENT_TYPE(event)) {
      case GST_EVENT_CAPS: {
        GstCaps* caps = nullptr;
        gst_event_parse_caps(event, &caps);
        const bool taken = take_sink_caps(state, side, caps);
        gst_event_unref(event);
        return taken;
      }
      case GST_EVENT_SEGMENT:
        return take_segment(state, side, pad, event);
      case GST_EVENT_EOS: {
        const guint32 seqnum = gst_event_get_seqnum(event);
        const gboolean taken = parent_class()->sink_event(aggregator, pad, event);
        end_output(state, seqnum);
        return taken;
      }
      case GST_EVENT_SEGMENT_DONE:
        // The output follows the left stream: its end of a segment is the output's.
        if (side == Side::kLeft) break;
        gst_event_unref(event);
        return TRUE;
      default:
        break;
    }
    return parent_class()->sink_event(aggregator, pad, event);
  });
}

gboolean sink_query(GstAggregator* aggregator, GstAggregatorPad* pad, GstQuery* query) {
  return guarded(aggregator, FALSE, [&](ElementState& state) -> gboolean {
    const Side side = pad == state.input(Side::kLeft).pad ? Side::kLeft : Side::kRight;
    switch (GST_QUERY_TYPE(query)) {
      case GST_QUERY_CAPS: {
        GstCaps* filter = nullptr;
        gst_query_parse_caps(query, &filter);
        gst_query_set_caps_result(query, sink_caps(state, side, filter).get());
        return TRUE;
      }
      case GST_QUERY_ACCEPT_CAPS:
        // What cannot be matched is refused when it comes, with an error that says why: a "no"
        // here would only make the source report that it is not negotiated.
        gst_query_set_accept_caps_result(query, TRUE);
        return TRUE;
      default:
        return parent_class()->sink_query(aggregator, pad, query);
    }
  });
}

gboolean source_event(GstAggregator* aggregator, GstEvent* event) {
  if (GST_EVENT_TYPE(event) == GST_EVENT_QOS && !take_qos_event(state_of(aggregator), event)) {
    gst_event_unref(event);
    return TRUE;
  }
  return parent_class()->src_event(aggregator, event);
}

gboolean source_query(GstAggregator* aggregator, GstQuery* query) {
  ElementState& state = state_of(aggregator);
  if (const auto answered = answer_source_query(state, query)) return *answered;
  if (!parent_class()->src_query(aggregator, query)) return FALSE;
  if (GST_QUERY_TYPE(query) == GST_QUERY_LATENCY) add_processing_latency(state, query);
  return TRUE;
}

// --- negotiation and data ---

gboolean negotiate(GstAggregator* aggregator) {
  return guarded(aggregator, FALSE, [&](ElementState& state) -> gboolean {
    {
      const ObjectLock lock(aggregator);
      if (state.failed) return FALSE;
    }
    if (!state.input(Side::kLeft).has_caps) return TRUE;  // again when they come
    if (!apply_settings(state)) return FALSE;
    if (parent_class()->negotiate(aggregator)) return TRUE;
    if (GST_PAD_IS_FLUSHING(state.source_pad())) return FALSE;
    const CapsPointer downstream(gst_pad_peer_query_caps(state.source_pad(), nullptr));
    post_error(state, GST_CORE_ERROR, GST_CORE_ERROR_NEGOTIATION,
               "What follows does not take this disparity map. Size and framerate are those of "
               "the left stream, the scale is the property disparity-scale, the format is "
               "GRAY16_LE: change those, or put a converter (mtcolor, videoconvert) behind.",
               "offered: " + caps_text(output_caps(state).get()) +
                   "; taken: " + caps_text(downstream.get()) + "; " + state.streams_text());
    return FALSE;
  });
}

GstFlowReturn update_source_caps(GstAggregator* aggregator, GstCaps* downstream, GstCaps** result) {
  return guarded(aggregator, GST_FLOW_ERROR, [&](ElementState& state) {
    const CapsPointer own = output_caps(state);
    *result = gst_caps_intersect(own.get(), downstream);
    return GST_FLOW_OK;  // the base class refuses empty caps
  });
}

gboolean negotiated_source_caps(GstAggregator* aggregator, GstCaps* caps) {
  return gst_video_info_from_caps(&state_of(aggregator).output, caps);
}

/// Frames that lie outside of their segment are not to be shown: neither has a disparity. Called
/// with the pad's own lock, so the element's may not be taken.
GstBuffer* clip(GstAggregator*, GstAggregatorPad* pad, GstBuffer* buffer) {
  const GstClockTime begin = GST_BUFFER_PTS(buffer);
  if (!GST_CLOCK_TIME_IS_VALID(begin) || GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_GAP)) {
    return buffer;
  }
  const GstClockTime end = GST_BUFFER_DURATION_IS_VALID(buffer)
                               ? begin + GST_BUFFER_DURATION(buffer)
                               : GST_CLOCK_TIME_NONE;
  bool inside = true;
  {
    const ObjectLock lock(pad);
    if (pad->segment.format == GST_FORMAT_TIME) {
      inside = gst_segment_clip(&pad->segment, GST_FORMAT_TIME, begin, end, nullptr, nullptr);
    }
  }
  if (inside) return buffer;
  gst_buffer_unref(buffer);
  return nullptr;
}

GstFlowReturn aggregate_heads(GstAggregator* aggregator, gboolean timeout) {
  return guarded(aggregator, GST_FLOW_ERROR,
                 [&](ElementState& state) { return aggregate(state, timeout != FALSE); });
}

GstClockTime next_time(GstAggregator* aggregator) { return next_deadline(state_of(aggregator)); }

// --- life ---

gboolean start(GstAggregator* aggregator) {
  return guarded(aggregator, FALSE, [&](ElementState& state) -> gboolean {
    {
      const ObjectLock lock(aggregator);
      state.statistics = {};
      state.caps_durations = {};
      state.qos_earliest = GST_CLOCK_TIME_NONE;
      state.processing.reset();
      state.failed = false;
    }
    state.alarm.reset();
    state.lonely = {};
    state.known_latency = 0;
    state.segment = OutputSegment::kNone;
    return apply_settings(state);
  });
}

gboolean stop(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  for (Input& input : state.inputs) input.has_caps = false;
  state.matcher.reset();
  state.confidence_pool.clear();
  return TRUE;
}

GstFlowReturn flush(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  state.alarm.reset();
  state.lonely = {};
  state.segment = OutputSegment::kNone;
  const ObjectLock lock(aggregator);
  state.qos_earliest = GST_CLOCK_TIME_NONE;
  return GST_FLOW_OK;
}

GstStateChangeReturn change_state(GstElement* element, GstStateChange transition) {
  if (transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING ||
      transition == GST_STATE_CHANGE_PLAYING_TO_PAUSED) {
    const ObjectLock lock(element);
    state_of(element).playing = transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING;
  }
  return GST_ELEMENT_CLASS(mtstereo_element_parent_class)->change_state(element, transition);
}

void finalize(GObject* object) {
  delete reinterpret_cast<GstMtStereo*>(object)->state;
  G_OBJECT_CLASS(mtstereo_element_parent_class)->finalize(object);
}

// The pads are the element's children, so that `sink_right::offset` can be set by name.

GObject* child_by_index(GstChildProxy* proxy, guint index) {
  const ObjectLock lock(proxy);
  gpointer pad = g_list_nth_data(GST_ELEMENT_CAST(proxy)->pads, index);
  return pad != nullptr ? G_OBJECT(gst_object_ref(pad)) : nullptr;
}

guint children_count(GstChildProxy* proxy) {
  const ObjectLock lock(proxy);
  return GST_ELEMENT_CAST(proxy)->numpads;
}

void child_proxy_init(gpointer interface, gpointer) {
  auto* proxy = static_cast<GstChildProxyInterface*>(interface);
  proxy->get_child_by_index = child_by_index;
  proxy->get_children_count = children_count;
}

void add_pad_templates(GstElementClass* element_class) {
  const std::string sink = "video/x-raw, format = (string) " + luma_formats() +
                           ", width = (int) [ 1, max ], height = (int) [ 1, max ], "
                           "framerate = (fraction) [ 0/1, max ], "
                           "interlace-mode = (string) progressive";
  const CapsPointer sink_caps(gst_caps_from_string(sink.c_str()));
  const CapsPointer source_caps(gst_caps_from_string(
      "video/x-raw, format = (string) GRAY16_LE, width = (int) [ 1, max ], "
      "height = (int) [ 1, max ], framerate = (fraction) [ 0/1, max ], "
      "interlace-mode = (string) progressive, disparity-scale = (int) [ 1, 65535 ]"));
  for (const Side side : kSides) {
    gst_element_class_add_pad_template(
        element_class, gst_pad_template_new_with_gtype(pad_name(side), GST_PAD_SINK, GST_PAD_ALWAYS,
                                                       sink_caps.get(), GST_TYPE_AGGREGATOR_PAD));
  }
  gst_element_class_add_pad_template(
      element_class, gst_pad_template_new_with_gtype("src", GST_PAD_SRC, GST_PAD_ALWAYS,
                                                     source_caps.get(), GST_TYPE_AGGREGATOR_PAD));
}

}  // namespace

static void mtstereo_element_class_init(GstMtStereoClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtstereo_debug, "mtstereo", 0, "stereo matching on Max-trees");
  auto* object_class = G_OBJECT_CLASS(klass);
  object_class->set_property = set_property;
  object_class->get_property = get_property;
  object_class->finalize = finalize;
  install_properties(object_class);

  auto* element_class = GST_ELEMENT_CLASS(klass);
  element_class->change_state = change_state;
  add_pad_templates(element_class);
  gst_element_class_set_static_metadata(
      element_class, "Stereo disparity", "Filter/Analyzer/Video",
      "Disparity of two rectified cameras, by MTStereo 2.0 (Max-trees of scan-lines)",
      "the mtstereo authors");

  auto* aggregator_class = GST_AGGREGATOR_CLASS(klass);
  aggregator_class->start = start;
  aggregator_class->stop = stop;
  aggregator_class->flush = flush;
  aggregator_class->clip = clip;
  aggregator_class->aggregate = aggregate_heads;
  aggregator_class->get_next_time = next_time;
  aggregator_class->sink_event = sink_event;
  aggregator_class->sink_query = sink_query;
  aggregator_class->src_event = source_event;
  aggregator_class->src_query = source_query;
  aggregator_class->negotiate = negotiate;
  aggregator_class->update_src_caps = update_source_caps;
  aggregator_class->negotiated_src_caps = negotiated_source_caps;
  aggregator_class->decide_allocation = decide_allocation;
  aggregator_class->propose_allocation = propose_allocation;
}

static void mtstereo_element_init(GstMtStereo* self) {
  auto* element = GST_ELEMENT_CAST(self);
  self->state = new ElementState(GST_AGGREGATOR_CAST(self));
  for (const Side side : kSides) {
    GstPadTemplate* pad_template =
        gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(self), pad_name(side));
    auto* pad = static_cast<GstPad*>(g_object_new(GST_TYPE_AGGREGATOR_PAD, "name", pad_name(side),
                                                  "direction", GST_PAD_SINK, "template",
                                                  pad_template, nullptr));
    self->state->input(side).pad = GST_AGGREGATOR_PAD(pad);
    gst_element_add_pad(element, pad);
  }
}

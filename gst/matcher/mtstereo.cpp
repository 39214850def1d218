// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/mtstereo.hpp"

#include "matcher/element_state.hpp"
#include "matcher/events.hpp"
#include "matcher/frame_flow.hpp"
#include "matcher/negotiation.hpp"
#include "matcher/output/allocation.hpp"
#include "matcher/output/output_caps.hpp"
#include "matcher/properties.hpp"
#include "matcher/queries.hpp"
#include "matcher/settings_in_use.hpp"
#include "matcher/silent_pads.hpp"
#include "matcher/sink_pads.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/exception_guard.hpp"
#include "shared/luma.hpp"
#include "shared/ownership.hpp"

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {
namespace {

struct GstMtStereo {
  GstAggregator parent;
  ElementState* state;
};

struct GstMtStereoClass {
  GstAggregatorClass parent_class;
};

void child_proxy_init(gpointer interface, gpointer) noexcept;

}  // namespace

G_DEFINE_TYPE_WITH_CODE(GstMtStereo, gst_mtstereo, GST_TYPE_AGGREGATOR,
                        G_IMPLEMENT_INTERFACE(GST_TYPE_CHILD_PROXY, child_proxy_init))

ElementState& state_of(gpointer element) { return *reinterpret_cast<GstMtStereo*>(element)->state; }

namespace {

/// After an exception no further error is posted and no further frame is matched.
void mark_as_failed(gpointer element) noexcept { state_of(element).messages.fail(); }

template <auto kFunction, auto kFallback = nullptr>
constexpr auto guarded_or_failed = guarded<kFunction, kFallback, mark_as_failed>;

// --- properties ---

void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  set_element_property(state_of(object), id, *value, spec);
}

void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  get_element_property(state_of(object), id, *value, spec);
}

/// See MatchProperties.
void properties_changed(GObject* object, guint count, GParamSpec** specs) {
  state_of(object).properties.commit();
  G_OBJECT_CLASS(gst_mtstereo_parent_class)->dispatch_properties_changed(object, count, specs);
}

// --- events and queries ---

gboolean sink_event(GstAggregator* aggregator, GstAggregatorPad* pad, GstEvent* event) {
  return handle_sink_event(state_of(aggregator), pad, event);
}

GstFlowReturn sink_event_arrives(GstAggregator* aggregator, GstAggregatorPad* pad,
                                 GstEvent* event) {
  ElementState& state = state_of(aggregator);
  before_sink_event(state, pad, event);
  return state.base_class->sink_event_pre_queue(aggregator, pad, event);
}

gboolean sink_query(GstAggregator* aggregator, GstAggregatorPad* pad, GstQuery* query) {
  return answer_sink_query(state_of(aggregator), pad, query);
}

gboolean source_event(GstAggregator* aggregator, GstEvent* event) {
  return handle_source_event(state_of(aggregator), event);
}

gboolean source_query(GstAggregator* aggregator, GstQuery* query) {
  return answer_source_query(state_of(aggregator), query);
}

// --- negotiation and data ---

gboolean negotiate(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  // aggregate() returns the error, which also ends the stream downstream.
  return state.messages.failed() || negotiate_output(state);
}

GstFlowReturn update_source_caps(GstAggregator* aggregator, GstCaps* downstream, GstCaps** result) {
  const ElementState& state = state_of(aggregator);
  const CapsPointer caps = output_caps(state.formats[Side::kLeft], state.engine.settings().unit());
  *result = gst_caps_intersect(caps.get(), downstream);
  return GST_FLOW_OK;  // the base class rejects empty caps
}

gboolean negotiated_source_caps(GstAggregator* aggregator, GstCaps* caps) {
  GST_DEBUG_OBJECT(aggregator, "maps %" GST_PTR_FORMAT, static_cast<void*>(caps));
  return state_of(aggregator).output.set_caps(caps);
}

/// Drops frames outside of their segment. The base class calls it with the lock of the pad held, so
/// it must not lock the element, which posting an error would do: it calls C functions only.
GstBuffer* clip(GstAggregator*, GstAggregatorPad* pad, GstBuffer* buffer) noexcept {
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
  ElementState& state = state_of(aggregator);
  const BusyMark mark(state.progress);
  return aggregate(state, timeout != FALSE);
}

GstClockTime next_time(GstAggregator* aggregator) { return next_deadline(state_of(aggregator)); }

// --- life cycle ---

gboolean start(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  state.restart();
  state.progress.pairs_before = 0;
  state.pairing.start();
  state.pairing_reports.start();
  state.engine.start();
  state.output.start();
  state.properties.commit();
  if (!apply_settings(state)) return FALSE;
  state.watchdog.start();
  state.properties.set_started(true);
  return TRUE;
}

gboolean stop(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  state.watchdog.stop();
  state.formats.clear();
  state.pairing.stop();
  state.engine.stop();
  state.properties.set_started(false);
  return TRUE;
}

GstFlowReturn flush(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  // Pairing, matcher and punctuality start over with the segments that follow.
  state.restart();
  state.output.events.restart();
  state.progress.pairs_before = state.engine.statistics().pairs;
  return GST_FLOW_OK;
}

GstStateChangeReturn change_state(GstElement* element, GstStateChange transition) {
  if (transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING ||
      transition == GST_STATE_CHANGE_PLAYING_TO_PAUSED) {
    state_of(element).clock.set_playing(transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING);
  }
  return GST_ELEMENT_CLASS(gst_mtstereo_parent_class)->change_state(element, transition);
}

void finalize(GObject* object) noexcept {
  delete &state_of(object);
  G_OBJECT_CLASS(gst_mtstereo_parent_class)->finalize(object);
}

// --- child proxy: the pads are the children, so that `sink_right::offset` can be set by name ---

GObject* child_by_index(GstChildProxy* proxy, guint index) noexcept {
  const ObjectLock lock(proxy);
  gpointer pad = g_list_nth_data(GST_ELEMENT_CAST(proxy)->pads, index);
  return pad != nullptr ? G_OBJECT(gst_object_ref(pad)) : nullptr;
}

guint children_count(GstChildProxy* proxy) noexcept {
  const ObjectLock lock(proxy);
  return GST_ELEMENT_CAST(proxy)->numpads;
}

void child_proxy_init(gpointer interface, gpointer) noexcept {
  auto* proxy = static_cast<GstChildProxyInterface*>(interface);
  proxy->get_child_by_index = child_by_index;
  proxy->get_children_count = children_count;
}

// --- class ---

void add_pad_templates(GstElementClass* element_class) noexcept {
  const std::string fields = ", format = (string) " + luma_formats() +
                             ", " MTSTEREO_SIZE_CAPS ", interlace-mode = (string) progressive";
  // Overlays are ignored, and with them upstream need not draw them into the frames.
  const std::string sink = "video/x-raw" + fields +
                           "; video/x-raw(" GST_CAPS_FEATURE_MEMORY_SYSTEM_MEMORY
                           ", " GST_CAPS_FEATURE_META_GST_VIDEO_OVERLAY_COMPOSITION ")" +
                           fields;
  for (const Side side : kSides) {
    add_pad_template(element_class, pad_name(side), GST_PAD_SINK, sink.c_str(),
                     GST_TYPE_AGGREGATOR_PAD);
  }
  add_pad_template(element_class, "src", GST_PAD_SRC,
                   "video/x-raw, format = (string) GRAY16_LE, " MTSTEREO_SIZE_CAPS
                   ", interlace-mode = (string) progressive, disparity-scale = (int) [ 1, 65535 ]",
                   GST_TYPE_AGGREGATOR_PAD);
}

void set_aggregator_functions(GstAggregatorClass* aggregator_class) {
  aggregator_class->start = guarded_or_failed<start, FALSE>;
  aggregator_class->stop = guarded_or_failed<stop, FALSE>;
  aggregator_class->flush = guarded_or_failed<flush, GST_FLOW_ERROR>;
  aggregator_class->clip = clip;
  aggregator_class->aggregate = guarded_or_failed<aggregate_heads, GST_FLOW_ERROR>;
  aggregator_class->get_next_time = guarded_or_failed<next_time, GST_CLOCK_TIME_NONE>;
  aggregator_class->sink_event = guarded_or_failed<sink_event, FALSE>;
  aggregator_class->sink_event_pre_queue = guarded_or_failed<sink_event_arrives, GST_FLOW_ERROR>;
  aggregator_class->sink_query = guarded_or_failed<sink_query, FALSE>;
  aggregator_class->src_event = guarded_or_failed<source_event, FALSE>;
  aggregator_class->src_query = guarded_or_failed<source_query, FALSE>;
  aggregator_class->negotiate = guarded_or_failed<negotiate, FALSE>;
  aggregator_class->update_src_caps = guarded_or_failed<update_source_caps, GST_FLOW_ERROR>;
  aggregator_class->negotiated_src_caps = guarded_or_failed<negotiated_source_caps, FALSE>;
  aggregator_class->decide_allocation = guarded_or_failed<decide_allocation, FALSE>;
  aggregator_class->propose_allocation = guarded_or_failed<propose_allocation, FALSE>;
}

}  // namespace

static void gst_mtstereo_class_init(GstMtStereoClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtstereo_debug, "mtstereo", 0, "stereo matching");
  auto* object_class = G_OBJECT_CLASS(klass);
  object_class->set_property = guarded_or_failed<set_property>;
  object_class->get_property = guarded_or_failed<get_property>;
  object_class->dispatch_properties_changed = guarded_or_failed<properties_changed>;
  object_class->finalize = finalize;
  install_properties(object_class);

  auto* element_class = GST_ELEMENT_CLASS(klass);
  element_class->change_state = guarded_or_failed<change_state, GST_STATE_CHANGE_FAILURE>;
  add_pad_templates(element_class);
  gst_element_class_set_static_metadata(element_class, "Stereo matcher", "Filter/Analyzer/Video",
                                        "Disparity of two rectified video streams, with the "
                                        "confidence of each value. Set max-disparity and mode "
                                        "first; those marked Expert rarely need a change",
                                        kAuthors);
  set_aggregator_functions(GST_AGGREGATOR_CLASS(klass));
}

static void gst_mtstereo_init(GstMtStereo* self) {
  self->state = new_state<ElementState>(
      GST_AGGREGATOR_CAST(self), GST_AGGREGATOR_CLASS(gst_mtstereo_parent_class), watch_pads);
  add_sink_pads(*self->state);
}

}  // namespace mtstereo::plugin

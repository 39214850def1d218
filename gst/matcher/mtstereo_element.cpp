// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/mtstereo_element.hpp"

#include "matcher/aggregation.hpp"
#include "matcher/element_properties.hpp"
#include "matcher/element_state.hpp"
#include "matcher/events.hpp"
#include "matcher/negotiation.hpp"
#include "matcher/output/allocation.hpp"
#include "matcher/output/output_events.hpp"
#include "matcher/queries.hpp"
#include "matcher/settings.hpp"
#include "matcher/streams.hpp"
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

namespace {

ElementState& state_of(gpointer element) { return *reinterpret_cast<GstMtStereo*>(element)->state; }

/// After an exception no further error is posted and no further frame is matched.
void mark_as_failed(gpointer element) noexcept {
  const ObjectLock lock(element);
  state_of(element).failed = true;
}

template <auto kFunction, auto kFallback = nullptr>
constexpr auto guarded_or_failed = guarded<kFunction, kFallback, mark_as_failed>;

// --- properties ---

void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  set_element_property(state_of(object), id, value, spec);
}

void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  get_element_property(state_of(object), id, value, spec);
}

/// GObject calls it once after all properties of a g_object_set(), or between
/// g_object_freeze_notify() and g_object_thaw_notify(), are set: these belong together.
void properties_changed(GObject* object, guint count, GParamSpec** specs) {
  state_of(object).complete_settings();
  G_OBJECT_CLASS(gst_mtstereo_parent_class)->dispatch_properties_changed(object, count, specs);
}

// --- events and queries ---

gboolean sink_event(GstAggregator* aggregator, GstAggregatorPad* pad, GstEvent* event) {
  return handle_sink_event(state_of(aggregator), pad, event);
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
  return has_failed(state) || negotiate_output(state);
}

GstFlowReturn update_source_caps(GstAggregator* aggregator, GstCaps* downstream, GstCaps** result) {
  *result = gst_caps_intersect(output_caps(state_of(aggregator)).get(), downstream);
  return GST_FLOW_OK;  // the base class rejects empty caps
}

gboolean negotiated_source_caps(GstAggregator* aggregator, GstCaps* caps) {
  GST_DEBUG_OBJECT(aggregator, "maps %" GST_PTR_FORMAT, static_cast<void*>(caps));
  return gst_video_info_from_caps(&state_of(aggregator).output, caps);
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
  const BusyMark mark(state);
  return aggregate(state, timeout != FALSE);
}

GstClockTime next_time(GstAggregator* aggregator) { return next_deadline(state_of(aggregator)); }

// --- life cycle ---

gboolean start(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  {
    const ObjectLock lock(aggregator);
    state.statistics = {};
    state.alignment_report = {};
    state.caps_durations = {};
    state.lateness = {};
    state.processing.reset();
    state.watchdog_input = {};
    state.failed = false;
  }
  state.alignment = PairAlignment();
  state.logged_half_resolution = false;
  state.announced = {};
  state.unpaired_warning.reset();
  state.waiting_frame = {};
  state.known_latency = 0;
  state.doubt_warning = {};
  state.segment = OutputSegment::kNone;
  state.segment_repeats = false;
  state.start_repeats = false;
  state.output_segment.reset();
  clear_streams(state);
  state.complete_settings();
  if (!apply_settings(state)) return FALSE;
  state.watchdog.start();
  const ObjectLock lock(aggregator);
  state.started = true;
  return TRUE;
}

gboolean stop(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  state.watchdog.stop();
  for (Input& input : state.inputs) input.has_caps = false;
  clear_streams(state);
  state.adopted_infos = {};
  for (FrameQueue& queue : state.queues) queue = {};
  state.matcher.reset();
  state.logged_revision.reset();
  state.alignment = PairAlignment();
  state.confidence_pool.clear();
  for (LumaReader& luma : state.luma) luma.clear();
  state.borders = {};
  const ObjectLock lock(aggregator);
  state.started = false;
  return TRUE;
}

GstFlowReturn flush(GstAggregator* aggregator) {
  ElementState& state = state_of(aggregator);
  state.restart_matching();
  state.unpaired_warning.reset();
  state.waiting_frame = {};
  state.segment = OutputSegment::kNone;
  state.segment_repeats = false;
  state.output_segment.reset();
  clear_streams(state);
  const ObjectLock lock(aggregator);
  state.failed = false;
  state.lateness.restart();
  ++state.watchdog_input.flushes;
  state.watchdog_input.pairs_before = state.statistics.pairs;
  return GST_FLOW_OK;
}

GstStateChangeReturn change_state(GstElement* element, GstStateChange transition) {
  if (transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING ||
      transition == GST_STATE_CHANGE_PLAYING_TO_PAUSED) {
    const ObjectLock lock(element);
    state_of(element).playing = transition == GST_STATE_CHANGE_PAUSED_TO_PLAYING;
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
                                        "The mtstereo authors");
  set_aggregator_functions(GST_AGGREGATOR_CLASS(klass));
}

static void gst_mtstereo_init(GstMtStereo* self) {
  auto* element = GST_ELEMENT_CAST(self);
  self->state = new_state<ElementState>(GST_AGGREGATOR_CAST(self),
                                        GST_AGGREGATOR_CLASS(gst_mtstereo_parent_class));
  for (const Side side : kSides) {
    GstPadTemplate* pad_template =
        gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(self), pad_name(side));
    auto* pad = static_cast<GstPad*>(g_object_new(GST_TYPE_AGGREGATOR_PAD, "name", pad_name(side),
                                                  "direction", GST_PAD_SINK, "template",
                                                  pad_template, nullptr));
    self->state->input(side).pad = GST_AGGREGATOR_PAD(pad);
    gst_element_add_pad(element, pad);
    watch_pad(*self->state, side);
  }
  watch_output(*self->state);
}

}  // namespace mtstereo::plugin

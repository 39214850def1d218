// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/mtsplit.hpp"

#include <string>

#include "cameras/split_layout.hpp"
#include "cameras/split_state.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/ownership.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtsplit_debug);
#define GST_CAT_DEFAULT mtsplit_debug

namespace {

using GstMtSplit = Instance<GstElement, SplitState>;
using GstMtSplitClass = GstElementClass;

constexpr const char* kNames[] = {"left", "right"};

const PropertyTable<SplitSettings>& properties() {
  static const GType layouts = enum_type<SplitLayout>(
      "GstMtStereoSplitLayout",
      {{SplitLayout::kSideBySide, "The left half and the right half", "side-by-side"},
       {SplitLayout::kTopBottom, "The upper half and the lower half", "top-bottom"}});
  static const PropertyTable<SplitSettings> table({
      {"layout", &SplitSettings::layout, layouts, "Position of the two views in a frame"},
      {"swap", &SplitSettings::swap,
       "The first half (left or upper) is the right view, not the left one"},
  });
  return table;
}

}  // namespace

G_DEFINE_TYPE(GstMtSplit, gst_mtstereo_split, GST_TYPE_ELEMENT)

namespace {

SplitState& state_of(gpointer element) { return *reinterpret_cast<GstMtSplit*>(element)->state; }

/// Runs a function of a pad. No exception may reach GStreamer: it becomes an error message.
template <typename Result, typename Body>
Result at_pad(GstObject* element, Result failure, Body&& body) noexcept {
  try {
    return body(state_of(element));
  } catch (...) {
    post_exception(element);
  }
  return failure;
}

// --- caps ---

CapsPointer intersection(const CapsPointer& first, const CapsPointer& second) {
  return CapsPointer(gst_caps_intersect_full(first.get(), second.get(), GST_CAPS_INTERSECT_FIRST));
}

CapsPointer template_of(GstPad* pad) { return CapsPointer(gst_pad_get_pad_template_caps(pad)); }

/// What both outputs accept, as whole frames.
CapsPointer sink_caps(SplitState& state, GstCaps* filter) {
  const SplitLayout layout = state.current_settings().layout;
  CapsPointer result = template_of(state.sink);
  for (const SplitOutput& output : state.outputs) {
    const CapsPointer half = template_of(output.pad);
    const CapsPointer accepted(gst_pad_peer_query_caps(output.pad, half.get()));
    result = intersection(whole_caps(intersection(accepted, half).get(), layout), result);
  }
  return filtered_caps(std::move(result), filter);
}

/// Halves of what upstream can deliver. If it can be split by no means, the pads can be linked
/// nevertheless, and the error at the caps of the frames says why.
CapsPointer source_caps(SplitState& state, GstPad* pad, GstCaps* filter) {
  const SplitLayout layout = state.current_settings().layout;
  const CapsPointer whole = template_of(state.sink);
  const CapsPointer upstream(gst_pad_peer_query_caps(state.sink, whole.get()));
  const CapsPointer half = half_caps(intersection(upstream, whole).get(), layout);
  CapsPointer result = intersection(half, template_of(pad));
  if (gst_caps_is_empty(result.get())) result = template_of(pad);
  return filtered_caps(std::move(result), filter);
}

gboolean answer_caps(GstQuery* query, const CapsPointer& caps) {
  gst_query_set_caps_result(query, caps.get());
  return TRUE;
}

// --- the sink pad ---

/// Each view is a stream of its own.
gboolean start_streams(SplitState& state, GstEvent* event) {
  const gchar* id = nullptr;
  guint group = GST_GROUP_ID_INVALID;
  GstStreamFlags flags = GST_STREAM_FLAG_NONE;
  gst_event_parse_stream_start(event, &id);
  gst_event_parse_stream_flags(event, &flags);
  const bool grouped = gst_event_parse_group_id(event, &group);
  gst_flow_combiner_reset(state.flows);
  for (const SplitOutput& output : state.outputs) {
    GstEvent* start = gst_event_new_stream_start((std::string(id) + "/" + output.name).c_str());
    gst_event_set_seqnum(start, gst_event_get_seqnum(event));
    gst_event_set_stream_flags(start, flags);
    if (grouped) gst_event_set_group_id(start, group);
    gst_pad_push_event(output.pad, start);
  }
  gst_event_unref(event);
  return TRUE;
}

gboolean sink_event(GstPad* pad, GstObject* parent, GstEvent* event) noexcept {
  return at_pad(parent, FALSE, [&](SplitState& state) -> gboolean {
    if (!allows_caps(parent, pad, event, FrameKind::kView)) {
      gst_event_unref(event);
      return FALSE;
    }
    switch (GST_EVENT_TYPE(event)) {
      case GST_EVENT_STREAM_START:
        return start_streams(state, event);
      case GST_EVENT_CAPS: {
        GstCaps* caps = nullptr;
        gst_event_parse_caps(event, &caps);
        const bool sent = send_half_caps(state, caps, gst_event_get_seqnum(event));
        gst_event_unref(event);
        return sent ? TRUE : FALSE;
      }
      case GST_EVENT_FLUSH_STOP:
      case GST_EVENT_SEGMENT:
        gst_flow_combiner_reset(state.flows);
        return gst_pad_event_default(pad, parent, event);
      default:
        return gst_pad_event_default(pad, parent, event);
    }
  });
}

gboolean sink_query(GstPad* pad, GstObject* parent, GstQuery* query) noexcept {
  return at_pad(parent, FALSE, [&](SplitState& state) -> gboolean {
    if (accepts_all_caps(query)) return TRUE;
    switch (GST_QUERY_TYPE(query)) {
      case GST_QUERY_CAPS: {
        GstCaps* filter = nullptr;
        gst_query_parse_caps(query, &filter);
        return answer_caps(query, sink_caps(state, filter));
      }
      case GST_QUERY_ALLOCATION:
        // Any stride and offset is read.
        gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
        return TRUE;
      default:
        return gst_pad_query_default(pad, parent, query);
    }
  });
}

GstFlowReturn sink_chain(GstPad*, GstObject* parent, GstBuffer* buffer) noexcept {
  const BufferPointer owned(buffer);
  return at_pad(parent, GST_FLOW_ERROR,
                [&](SplitState& state) { return split_buffer(state, owned.get()); });
}

// --- the source pads ---

/// A sink downstream of both views sends a seek to both: it is executed once.
gboolean seek_once(SplitState& state, GstPad* pad, GstEvent* event) {
  const guint32 seqnum = gst_event_get_seqnum(event);
  {
    const std::lock_guard<std::mutex> lock(state.seek_mutex);
    if (seqnum == state.last_seek && seqnum != GST_SEQNUM_INVALID) {
      gst_event_unref(event);
      return state.last_seek_done ? TRUE : FALSE;
    }
    state.last_seek = seqnum;
    state.last_seek_done = true;
  }
  const gboolean done = gst_pad_event_default(pad, GST_OBJECT_CAST(state.element), event);
  const std::lock_guard<std::mutex> lock(state.seek_mutex);
  if (state.last_seek == seqnum) state.last_seek_done = done != FALSE;
  return done;
}

gboolean source_event(GstPad* pad, GstObject* parent, GstEvent* event) noexcept {
  return at_pad(parent, FALSE, [&](SplitState& state) {
    return GST_EVENT_TYPE(event) == GST_EVENT_SEEK ? seek_once(state, pad, event)
                                                   : gst_pad_event_default(pad, parent, event);
  });
}

gboolean source_query(GstPad* pad, GstObject* parent, GstQuery* query) noexcept {
  return at_pad(parent, FALSE, [&](SplitState& state) {
    if (GST_QUERY_TYPE(query) != GST_QUERY_CAPS) return gst_pad_query_default(pad, parent, query);
    GstCaps* filter = nullptr;
    gst_query_parse_caps(query, &filter);
    return answer_caps(query, source_caps(state, pad, filter));
  });
}

// --- life ---

GstStateChangeReturn change_state(GstElement* element, GstStateChange transition) {
  const GstStateChangeReturn result =
      GST_ELEMENT_CLASS(gst_mtstereo_split_parent_class)->change_state(element, transition);
  if (transition == GST_STATE_CHANGE_PAUSED_TO_READY) clear_split(state_of(element));
  return result;
}

void add_pad_templates(GstElementClass* element_class) noexcept {
  const std::string formats = "video/x-raw, format = (string) " + split_formats();
  const std::string whole = formats +
                            ", width = (int) [ 1, 32768 ], height = (int) [ 1, 32768 ], "
                            "framerate = (fraction) [ 0/1, max ]";
  const std::string half = formats + ", " MTSTEREO_SIZE_CAPS;
  static_assert(2 * kLargestImageSide == 32768);
  add_pad_template(element_class, "sink", GST_PAD_SINK, whole.c_str());
  for (const char* name : kNames) {
    add_pad_template(element_class, name, GST_PAD_SRC, half.c_str());
  }
}

GstPad* add_pad(GstElement* element, const char* name) {
  GstPadTemplate* pad_template =
      gst_element_class_get_pad_template(GST_ELEMENT_GET_CLASS(element), name);
  GstPad* pad = gst_pad_new_from_template(pad_template, name);
  gst_element_add_pad(element, pad);
  return pad;
}

}  // namespace

static void gst_mtstereo_split_class_init(GstMtSplitClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtsplit_debug, "mtsplit", 0, "splitting of stereo frames");
  ElementObject<GstMtSplit, properties, &SplitState::settings>::install(G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  element_class->change_state = guarded<change_state, GST_STATE_CHANGE_FAILURE>;
  add_pad_templates(element_class);
  gst_element_class_set_static_metadata(
      element_class, "Stereo frame splitter", "Filter/Video",
      "Splits frames with both views of a stereo camera, side by side or one above the other, into "
      "a left and a right stream, without copying pixels",
      kAuthors);
}

static void gst_mtstereo_split_init(GstMtSplit* self) {
  auto* element = GST_ELEMENT_CAST(self);
  self->state = new_state<SplitState>(element);
  SplitState& state = *self->state;
  state.sink = add_pad(element, "sink");
  gst_pad_set_chain_function(state.sink, sink_chain);
  gst_pad_set_event_function(state.sink, sink_event);
  gst_pad_set_query_function(state.sink, sink_query);
  for (std::size_t i = 0; i < state.outputs.size(); ++i) {
    SplitOutput& output = state.outputs[i];
    output.name = kNames[i];
    output.pad = add_pad(element, kNames[i]);
    gst_pad_set_event_function(output.pad, source_event);
    gst_pad_set_query_function(output.pad, source_query);
    gst_flow_combiner_add_pad(state.flows, output.pad);
  }
}

}  // namespace mtstereo::plugin

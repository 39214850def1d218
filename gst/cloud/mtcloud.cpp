// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cloud/mtcloud.hpp"

#include <gst/base/gstbasesink.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "cloud/cloud_location.hpp"
#include "cloud/cloud_properties.hpp"
#include "cloud/cloud_writer.hpp"
#include "cloud/left_pad.hpp"
#include "filters/disparity_filter.hpp"
#include "shared/authors.hpp"
#include "shared/caps_check.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/running_time.hpp"

// A GstBaseSink for the disparity maps: preroll, synchronization, the end of the stream, flushes
// and state changes are those of every sink. The left view comes on a second pad of the element,
// which only keeps frames (LeftFrames) until the map of the same time is rendered. So the left view
// can be absent, end or fail without blocking the maps. An aggregator with a sink in a bin would
// wait for a left frame without an end.

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtcloud_debug);
#define GST_CAT_DEFAULT mtcloud_debug

namespace {

/// The name of the message about a file. It is part of the public interface, as are the names of
/// its fields.
constexpr const char* kCloudMessage = "mtstereo-cloud";

/// All data of one mtcloud element. Created in its init, deleted in its finalize.
struct CloudState {
  CloudProperties properties;  ///< guarded by the element's object lock
  GeometrySource source;       ///< any thread
  LeftStream left;
  GstPad* left_pad = nullptr;

  // Used by the streaming thread of the maps, and by begin() while that thread does not run.
  std::optional<CloudLocation> location;
  CapsPointer caps;
  GstVideoInfo info{};
  std::optional<MapUnit> caps_unit;
  DepthRange range;         ///< the last valid one
  std::uint64_t frame = 0;  ///< number of the next map
  bool warned = false;      ///< of a missing left frame
  bool refused = false;     ///< an error about the stream was posted
  CloudWriter writer;
};

using GstMtCloud = Instance<GstBaseSink, CloudState>;
using GstMtCloudClass = GstBaseSinkClass;

}  // namespace

G_DEFINE_TYPE(GstMtCloud, gst_mtstereo_cloud, GST_TYPE_BASE_SINK)

namespace {

CloudState& state_of(gpointer element) { return *reinterpret_cast<GstMtCloud*>(element)->state; }

CloudProperties properties_of(gpointer element) {
  const ObjectLock lock(element);
  return state_of(element).properties;
}

// --- caps ---

/// Posts an error, once: a source may try to negotiate several times.
void refuse_stream(GstBaseSink* sink, const std::string& reason, const GstCaps* caps) {
  if (std::exchange(state_of(sink).refused, true)) return;
  GST_ELEMENT_ERROR(sink, STREAM, FORMAT,
                    ("The disparity map cannot be turned into points: %s.", reason.c_str()),
                    ("caps: %s", caps_text(caps).c_str()));
}

/// A warning if the principal point is that of a larger map.
void check_region(GstBaseSink* sink, const StereoGeometry& geometry, const GstVideoInfo& info) {
  const GeometryProperties properties = properties_of(sink).geometry;
  const std::string sizes = larger_frame(geometry, info.width, info.height);
  if (sizes.empty() || properties.principal_x || properties.principal_y) return;
  GST_ELEMENT_WARNING(
      sink, STREAM, FORMAT,
      ("The geometry in the caps is that of a larger map: an element downstream of mtrectify "
       "scales or crops it, but keeps the caps fields. The points are displaced: set the property "
       "step instead of scaling; after cropping, set principal-x and principal-y."),
      ("%s", sizes.c_str()));
}

gboolean set_caps(GstBaseSink* sink, GstCaps* caps) {
  CloudState& state = state_of(sink);
  const GstStructure* fields = gst_caps_get_structure(caps, 0);
  const Result<std::optional<MapUnit>> unit = disparity_unit_in(fields);
  if (!unit) {
    refuse_stream(sink, unit.error().message, caps);
    return FALSE;
  }
  const auto geometry = state.source.geometry(fields, properties_of(sink).geometry);
  if (!geometry) {
    refuse_stream(sink, geometry.error().message, caps);
    return FALSE;
  }
  if (!gst_video_info_from_caps(&state.info, caps)) return FALSE;
  check_region(sink, *geometry, state.info);
  state.caps.reset(gst_caps_ref(caps));
  state.caps_unit = *unit;
  state.refused = false;
  return TRUE;
}

gboolean propose_allocation(GstBaseSink*, GstQuery* query) {
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  return TRUE;
}

// --- frames ---

/// The left frame of a map; std::nullopt if there is none. Not GST_FLOW_OK if the element is being
/// flushed or stopped.
GstFlowReturn find_left(GstBaseSink* sink, GstBuffer* map, std::optional<LeftFrame>& left) {
  CloudState& state = state_of(sink);
  if (!gst_pad_is_linked(state.left_pad)) return GST_FLOW_OK;
  const auto time = to_running_time(sink->segment, GST_BUFFER_PTS(map));
  for (;;) {
    LeftFrame frame;
    switch (state.left.frames.find(time, frame)) {
      case LeftFrames::Outcome::kFound:
        left = std::move(frame);
        return GST_FLOW_OK;
      case LeftFrames::Outcome::kNone:
        if (std::exchange(state.warned, true)) return GST_FLOW_OK;
        GST_ELEMENT_WARNING(sink, STREAM, FAILED,
                            ("A disparity map has no left frame, so its points are white: "
                             "sink_left must get the frames that mtstereo gets on its "
                             "sink_left, with the same time stamps. Not reported again."),
                            ("running time %" GST_STIME_FORMAT,
                             GST_STIME_ARGS(time.value_or(GST_CLOCK_STIME_NONE))));
        return GST_FLOW_OK;
      case LeftFrames::Outcome::kInterrupted: {
        state.left.frames.hold(true);
        const GstFlowReturn flow = gst_base_sink_wait_preroll(sink);
        state.left.frames.hold(false);
        if (flow != GST_FLOW_OK) return flow;
      }
    }
  }
}

void post_file(GstBaseSink* sink, const std::string& path, GstBuffer* map, bool colored) {
  CloudState& state = state_of(sink);
  const auto running = to_running_time(sink->segment, GST_BUFFER_PTS(map));
  const GstClockTime time =
      running ? static_cast<GstClockTime>(std::max<Nanoseconds>(*running, 0)) : GST_CLOCK_TIME_NONE;
  gst_element_post_message(
      GST_ELEMENT_CAST(sink),
      gst_message_new_element(
          GST_OBJECT_CAST(sink),
          gst_structure_new(kCloudMessage, "filename", G_TYPE_STRING, utf8_path(path).c_str(),
                            "points", G_TYPE_UINT64, static_cast<guint64>(state.writer.points()),
                            "frame", G_TYPE_UINT64, static_cast<guint64>(state.frame), "timestamp",
                            G_TYPE_UINT64, GST_BUFFER_PTS(map), "running-time", G_TYPE_UINT64, time,
                            "colored", G_TYPE_BOOLEAN, colored ? TRUE : FALSE, nullptr)));
  GST_LOG_OBJECT(sink, "%s: %" G_GSIZE_FORMAT " points", path.c_str(), state.writer.points());
}

GstFlowReturn write_map(GstBaseSink* sink, GstBuffer* map, const CloudProperties& properties) {
  CloudState& state = state_of(sink);
  const auto stream =
      state.source.geometry(gst_caps_get_structure(state.caps.get(), 0), properties.geometry);
  if (!stream) {
    refuse_stream(sink, stream.error().message, state.caps.get());
    return GST_FLOW_ERROR;
  }
  const DepthGeometry geometry =
      depth_geometry(*stream, map_unit(state.caps_unit, map, properties.geometry.disparity_scale));
  const DepthRange range = settle_range(sink, state.properties.range, state.range);
  const CloudOptions options = {range.near, range.end(), properties.min_confidence,
                                properties.step};
  std::optional<LeftFrame> left;
  const GstFlowReturn flow = find_left(sink, map, left);
  if (flow != GST_FLOW_OK) return flow;
  const std::string path = state.location->path(state.frame);
  if (!state.writer.make(sink, map, state.info, left ? &*left : nullptr, geometry, options) ||
      !state.writer.write(sink, state.location->format(), path)) {
    return GST_FLOW_ERROR;
  }
  post_file(sink, path, map, left.has_value());
  return GST_FLOW_OK;
}

GstFlowReturn render(GstBaseSink* sink, GstBuffer* map) {
  CloudState& state = state_of(sink);
  state.left.frames.hold(false);
  const CloudProperties properties = properties_of(sink);
  GstFlowReturn flow = GST_FLOW_OK;
  if (state.frame % static_cast<std::uint64_t>(properties.every_nth) == 0) {
    flow = write_map(sink, map, properties);
  }
  if (flow == GST_FLOW_OK) ++state.frame;
  return flow;
}

/// The sink is paused with this map: the left view may wait for as long as that lasts.
GstFlowReturn preroll(GstBaseSink* sink, GstBuffer*) {
  state_of(sink).left.frames.hold(true);
  return GST_FLOW_OK;
}

// --- events and life ---

gboolean unlock(GstBaseSink* sink) {
  state_of(sink).left.frames.interrupt(true);
  return TRUE;
}

gboolean unlock_stop(GstBaseSink* sink) {
  state_of(sink).left.frames.interrupt(false);
  return TRUE;
}

gboolean query(GstBaseSink* sink, GstQuery* query) {
  if (accepts_all_caps(query)) return TRUE;
  return GST_BASE_SINK_CLASS(gst_mtstereo_cloud_parent_class)->query(sink, query);
}

gboolean event(GstBaseSink* sink, GstEvent* event) {
  if (!allows_caps(sink, GST_BASE_SINK_PAD(sink), event, FrameKind::kMap)) {
    gst_event_unref(event);
    return FALSE;
  }
  LeftFrames& frames = state_of(sink).left.frames;
  switch (GST_EVENT_TYPE(event)) {
    case GST_EVENT_EOS:
      frames.finish(true);
      break;
    case GST_EVENT_FLUSH_STOP:
      frames.hold(false);
      frames.finish(false);
      break;
    default:
      break;
  }
  return GST_BASE_SINK_CLASS(gst_mtstereo_cloud_parent_class)->event(sink, event);
}

/// Checks the properties before the first frame; false after an error.
bool begin(GstElement* element) {
  CloudState& state = state_of(element);
  const CloudProperties properties = properties_of(element);
  Result<CloudLocation> location = CloudLocation::parse(properties.location, properties.format());
  if (!location) {
    GST_ELEMENT_ERROR(element, RESOURCE, SETTINGS, ("%s.", location.error().message.c_str()),
                      (nullptr));
    return false;
  }
  const std::filesystem::path folder = std::filesystem::path(location->path(0)).parent_path();
  std::error_code problem;
  if (!folder.empty() && !std::filesystem::is_directory(folder, problem)) {
    GST_ELEMENT_ERROR(
        element, RESOURCE, OPEN_WRITE,
        ("The folder %s of the property location does not exist: create it.", folder.c_str()),
        ("location=%s", properties.location.c_str()));
    return false;
  }
  if (!check_range_at_start(element, properties.range)) return false;
  state.location = std::move(location.value());
  state.range = properties.range;
  state.frame = 0;
  state.warned = false;
  state.refused = false;
  state.source.forget();
  state.left.frames.hold(false);
  state.left.frames.finish(false);
  state.left.frames.set_timeout(std::chrono::nanoseconds(properties.timeout));
  return true;
}

GstStateChangeReturn change_state(GstElement* element, GstStateChange change) {
  if (change == GST_STATE_CHANGE_READY_TO_PAUSED && !begin(element)) {
    return GST_STATE_CHANGE_FAILURE;
  }
  const GstStateChangeReturn result =
      GST_ELEMENT_CLASS(gst_mtstereo_cloud_parent_class)->change_state(element, change);
  if (change == GST_STATE_CHANGE_PAUSED_TO_READY) {
    state_of(element).writer.clear();
    state_of(element).caps.reset();
  }
  return result;
}

}  // namespace

static void gst_mtstereo_cloud_class_init(GstMtCloudClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtcloud_debug, "mtcloud", 0, "point clouds of disparity maps");
  ElementObject<GstMtCloud, cloud_properties, &CloudState::properties>::install(
      G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  element_class->change_state = guarded<change_state, GST_STATE_CHANGE_FAILURE>;
  add_pad_template(element_class, "sink", GST_PAD_SINK, kDisparityCaps);
  add_pad_template(element_class, kLeftPad, GST_PAD_SINK, kLeftCaps);
  gst_element_class_set_static_metadata(
      element_class, "Point cloud writer", "Sink/File/Video",
      "Writes disparity maps as files of points in meters (PLY or PCD), with the colors of the "
      "left view and the confidence",
      kAuthors);

  auto* sink_class = GST_BASE_SINK_CLASS(klass);
  sink_class->set_caps = guarded<set_caps, FALSE>;
  sink_class->propose_allocation = guarded<propose_allocation, FALSE>;
  sink_class->preroll = guarded<preroll, GST_FLOW_ERROR>;
  sink_class->render = guarded<render, GST_FLOW_ERROR>;
  sink_class->unlock = guarded<unlock, FALSE>;
  sink_class->unlock_stop = guarded<unlock_stop, FALSE>;
  sink_class->event = guarded<event, FALSE>;
  sink_class->query = guarded<query, FALSE>;
}

static void gst_mtstereo_cloud_init(GstMtCloud* self) {
  self->state = new_state<CloudState>();
  self->state->left_pad = add_left_pad(GST_ELEMENT(self), self->state->left);
  gst_base_sink_set_sync(GST_BASE_SINK(self), FALSE);
}

}  // namespace mtstereo::plugin

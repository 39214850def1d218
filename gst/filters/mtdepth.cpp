// SPDX-License-Identifier: LGPL-2.1-or-later
#include "filters/mtdepth.hpp"

#include <optional>
#include <string>
#include <utility>

#include "filters/depth_frame.hpp"
#include "filters/depth_properties.hpp"
#include "filters/depth_report.hpp"
#include "filters/disparity_filter.hpp"
#include "mtstereo/geometry/rig.hpp"
#include "shared/authors.hpp"
#include "shared/caps.hpp"
#include "shared/caps_check.hpp"
#include "shared/depth_range.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/element_object.hpp"
#include "shared/exception_guard.hpp"
#include "shared/frame_views.hpp"
#include "shared/geometry_properties.hpp"

namespace mtstereo::plugin {

GST_DEBUG_CATEGORY_STATIC(mtdepth_debug);
#define GST_CAT_DEFAULT mtdepth_debug

namespace {

/// All data of one mtdepth element. Created in its init, deleted in its finalize.
struct DepthState {
  DepthProperties properties;  ///< guarded by the element's object lock
  GeometrySource source;       ///< any thread

  // Used by the streaming thread, and by start() while that thread does not run.
  std::optional<MapUnit> caps_unit;  ///< of the input
  StereoGeometry stream;             ///< what the output caps state
  double unit = 0;                   ///< what the output caps state [m]
  DepthRange range;                  ///< the last valid one
  DepthGeometry geometry;            ///< of `converter`
  DepthOptions options;              ///< of `converter`
  std::optional<DepthConverter> converter;
  FrameBounds bounds;
  bool refused = false;  ///< an error about the stream was posted
};

using GstMtDepth = Instance<GstVideoFilter, DepthState>;
using GstMtDepthClass = GstVideoFilterClass;

}  // namespace

G_DEFINE_TYPE(GstMtDepth, gst_mtstereo_depth, GST_TYPE_VIDEO_FILTER)

namespace {

DepthState& state_of(gpointer element) { return *reinterpret_cast<GstMtDepth*>(element)->state; }

/// The caps of the output state the unit and the geometry.
bool changes_caps(const DepthProperties& before, const DepthProperties& now) {
  return before.unit != now.unit || before.geometry != now.geometry;
}

DepthProperties properties_of(gpointer element) {
  const ObjectLock lock(element);
  return state_of(element).properties;
}

// --- caps ---

bool has_fixed_size(const GstStructure* fields) {
  int width = 0;
  int height = 0;
  return gst_structure_get_int(fields, "width", &width) &&
         gst_structure_get_int(fields, "height", &height);
}

/// Removes what this element puts into the caps of its output. The input may state any geometry, or
/// none: the properties may supply it.
void remove_depth_fields(GstStructure* fields) {
  gst_structure_remove_fields(fields, kDepthUnitField, kFocalLengthField, kBaselineField,
                              kPrincipalOffsetField, kPrincipalXField, kPrincipalYField, nullptr);
}

/// From the fields of a disparity map to the fields of its depth map.
void to_depth(GstStructure* fields, GeometrySource& source, const DepthProperties& properties) {
  if (has_fixed_size(fields)) {
    const Result<StereoGeometry> geometry = source.geometry(fields, properties.geometry);
    // set_info() reports a geometry that is missing.
    if (geometry) write_geometry(fields, *geometry);
  }
  gst_structure_set(fields, kDepthUnitField, G_TYPE_DOUBLE, properties.unit / 1000, nullptr);
}

GstCaps* transform_caps(GstBaseTransform* transform, GstPadDirection direction, GstCaps* caps,
                        GstCaps* filter) {
  const DepthProperties properties = properties_of(transform);
  const CapsPointer possible(gst_caps_from_string(kDisparityCaps));
  const CapsPointer common(gst_caps_intersect_full(caps, possible.get(), GST_CAPS_INTERSECT_FIRST));
  CapsPointer other(gst_caps_copy(common.get()));
  for (guint i = 0; i < gst_caps_get_size(other.get()); ++i) {
    GstStructure* fields = gst_caps_get_structure(other.get(), i);
    remove_map_unit(fields);
    if (direction == GST_PAD_SINK) {
      to_depth(fields, state_of(transform).source, properties);
    } else {
      remove_depth_fields(fields);
    }
  }
  return filtered_caps(std::move(other), filter).release();
}

/// The base class puts the caps of downstream first where they are possible for the input as well.
/// Here they are those of depths, which the input must not have.
gboolean query(GstBaseTransform* transform, GstPadDirection direction, GstQuery* query) {
  const auto base = GST_BASE_TRANSFORM_CLASS(gst_mtstereo_depth_parent_class)->query;
  const gboolean answered = base(transform, direction, query);
  if (direction != GST_PAD_SINK || GST_QUERY_TYPE(query) != GST_QUERY_CAPS || answered == FALSE) {
    return answered;
  }
  GstCaps* result = nullptr;
  gst_query_parse_caps_result(query, &result);
  CapsPointer caps(gst_caps_copy(result));
  for (guint i = 0; i < gst_caps_get_size(caps.get()); ++i) {
    remove_depth_fields(gst_caps_get_structure(caps.get(), i));
  }
  caps.reset(gst_caps_simplify(caps.release()));
  GstCaps* filter = nullptr;
  gst_query_parse_caps(query, &filter);
  // Fields that upstream has are part of what it offers, and remain.
  if (filter != nullptr) {
    caps.reset(gst_caps_intersect_full(caps.get(), filter, GST_CAPS_INTERSECT_FIRST));
  }
  gst_query_set_caps_result(query, caps.get());
  return TRUE;
}

/// Posts an error, once: a source may try to negotiate several times.
void refuse_stream(GstVideoFilter* filter, const std::string& reason, const GstCaps* caps) {
  if (std::exchange(state_of(filter).refused, true)) return;
  GST_ELEMENT_ERROR(filter, STREAM, FORMAT,
                    ("The disparity map cannot be turned into depths: %s.", reason.c_str()),
                    ("caps: %s", caps_text(caps).c_str()));
}

/// What the cameras of these disparities can measure, as mtrectify states it.
void log_rig(GstVideoFilter* filter, const GstStructure* in) {
  const StereoGeometry& stream = state_of(filter).stream;
  Rectification views;
  gst_structure_get_int(in, "width", &views.width);
  gst_structure_get_int(in, "height", &views.height);
  views.focal_length = stream.focal_length;
  views.baseline = stream.baseline;
  views.left_center_x = stream.principal_x;
  views.right_center_x = stream.principal_x + stream.principal_offset;
  views.center_y = stream.principal_y;
  DisparityRange range;
  if (const std::optional<DisparityUnit> unit = read_disparity_unit(in)) {
    range.smallest = unit->min_disparity;
    range.largest = unit->max_disparity;
  }
  GST_INFO_OBJECT(filter, "%s", rig_text(rig_figures(views, range)).c_str());
  for (const std::string& remark : state_of(filter).source.remarks()) {
    GST_INFO_OBJECT(filter, "%s", remark.c_str());
  }
}

gboolean set_info(GstVideoFilter* filter, GstCaps* in_caps, GstVideoInfo*, GstCaps* out_caps,
                  GstVideoInfo*) {
  DepthState& state = state_of(filter);
  const GstStructure* in = gst_caps_get_structure(in_caps, 0);
  const GstStructure* out = gst_caps_get_structure(out_caps, 0);
  const Result<std::optional<MapUnit>> unit = disparity_unit_in(in);
  if (!unit) {
    refuse_stream(filter, unit.error().message, in_caps);
    return FALSE;
  }
  const Result<StereoGeometry> found = state.source.geometry(in, properties_of(filter).geometry);
  if (!found) {
    refuse_stream(filter, found.error().message, in_caps);
    return FALSE;
  }
  // The negotiated caps decide: a property may have changed since then.
  const std::optional<double> depth_unit = depth_unit_in(out);
  const std::optional<StereoGeometry> stated = read_geometry(out);
  if (!depth_unit || !stated) return FALSE;
  state.refused = false;
  state.caps_unit = *unit;
  state.unit = *depth_unit;
  state.stream = *stated;
  log_rig(filter, in);
  return TRUE;
}

// --- frames ---

/// Makes the converter for this frame unless it exists already; false after an error.
bool prepare(GstVideoFilter* filter, const MapUnit& unit) {
  DepthState& state = state_of(filter);
  const DepthRange range = settle_range(filter, state.properties.range, state.range);
  const DepthGeometry geometry = depth_geometry(state.stream, unit);
  const DepthOptions options = {state.unit, range.near, range.end(),
                                properties_of(filter).overflow == DepthOverflow::kClamp};
  if (state.converter && geometry == state.geometry && options == state.options) return true;
  Result<DepthConverter> converter = DepthConverter::create(geometry, options);
  if (!converter) {
    refuse_stream(filter, converter.error().message, nullptr);
    return false;
  }
  state.converter = std::move(converter.value());
  state.geometry = geometry;
  state.options = options;
  report_depths(filter, geometry, options);
  GST_INFO_OBJECT(filter, "principal offset %g px, %d steps per px", geometry.principal_offset,
                  unit.scale);
  return true;
}

/// Turns the disparities of a frame into depths; false after an error.
bool convert(GstVideoFilter* filter, MappedFrame& frame, bool free_space) {
  DepthState& state = state_of(filter);
  if (free_space) {
    if (const Status status = state.bounds.write(frame); !status) {
      GST_ELEMENT_ERROR(filter, RESOURCE, NO_SPACE_LEFT,
                        ("There is not enough memory for the free space of a map of %dx%d px.",
                         filter->in_info.width, filter->in_info.height),
                        ("%s", status.error().message.c_str()));
      return false;
    }
  }
  write_depths(*state.converter, frame);
  return true;
}

GstFlowReturn transform_ip(GstBaseTransform* transform, GstBuffer* buffer) {
  auto* filter = reinterpret_cast<GstVideoFilter*>(transform);
  const DepthProperties properties = properties_of(filter);
  const MapUnit unit =
      map_unit(state_of(filter).caps_unit, buffer, properties.geometry.disparity_scale);
  if (!prepare(filter, unit)) return GST_FLOW_ERROR;
  {
    MappedFrame frame(filter->in_info, buffer, GST_MAP_READWRITE);
    if (!frame.mapped()) return refuse_frame(filter, "the sink pad", frame);
    if (!convert(filter, frame, properties.free_space)) return GST_FLOW_ERROR;
  }
  // The buffer keeps its metas, the confidence map among them; its values are not disparities.
  if (GstCustomMeta* meta = gst_buffer_get_custom_meta(buffer, kDisparityMeta)) {
    gst_buffer_remove_meta(buffer, &meta->meta);
  }
  return GST_FLOW_OK;
}

// --- life ---

gboolean start(GstBaseTransform* transform) {
  DepthState& state = state_of(transform);
  state.source.forget();
  state.converter.reset();  // reported again
  state.refused = false;
  const DepthRange range = properties_of(transform).range;
  state.range = range;
  return check_range_at_start(transform, range);
}

}  // namespace

static void gst_mtstereo_depth_class_init(GstMtDepthClass* klass) {
  GST_DEBUG_CATEGORY_INIT(mtdepth_debug, "mtdepth", 0, "depth maps of disparity maps");
  ElementObject<GstMtDepth, depth_properties, &DepthState::properties, changes_caps>::install(
      G_OBJECT_CLASS(klass));

  auto* element_class = GST_ELEMENT_CLASS(klass);
  add_pad_template(element_class, "sink", GST_PAD_SINK, kDisparityCaps);
  add_pad_template(element_class, "src", GST_PAD_SRC, kDisparityCaps);
  gst_element_class_set_static_metadata(
      element_class, "Depth from disparity", "Filter/Converter/Video",
      "Turns a disparity map into 16-bit depths, in millimeters by default: focal length x "
      "baseline / disparity",
      kAuthors);

  auto* transform_class = GST_BASE_TRANSFORM_CLASS(klass);
  check_sink_caps<FrameKind::kMap>(transform_class);
  transform_class->start = guarded<start, FALSE>;
  transform_class->transform_caps = guarded<transform_caps>;
  transform_class->query = guarded<query, FALSE>;
  transform_class->transform_ip = guarded<transform_ip, GST_FLOW_ERROR>;
  GST_VIDEO_FILTER_CLASS(klass)->set_info = guarded<set_info, FALSE>;
}

static void gst_mtstereo_depth_init(GstMtDepth* self) {
  self->state = new_state<DepthState>();
  // Frames that are not writable are copied by the base class.
  gst_base_transform_set_in_place(GST_BASE_TRANSFORM(self), TRUE);
}

}  // namespace mtstereo::plugin

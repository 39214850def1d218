// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/element_properties.hpp"

#include "matcher/alignment_properties.hpp"
#include "matcher/alignment_reports.hpp"
#include "matcher/negotiation.hpp"
#include "matcher/parameter_properties.hpp"
#include "matcher/settings.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

enum Property : guint {
  kDisparityScale = 1,
  kSyncTolerance,
  kConfidenceMap,
  kQos,
  kStats,
  kTimeout,
  kSyncMode,
  kNewestPair,
  kLatency,
  kMinUpstreamLatency
};

/// Largest wait [ns]. Deadlines are sums of several waits, which must not overflow.
constexpr gint64 kLongestWait = 3600 * static_cast<gint64>(GST_SECOND);

/// Sets a value under the object lock. A value that is not valid is not set: while the element
/// runs, the failure is returned. Otherwise it is kept as the error of the start, since there may
/// be no bus yet.
template <typename Set>
Status set_or_keep_problem(ElementState& state, guint id, const Set& set) {
  const ObjectLock lock(state.element);
  Settings& settings = state.settings;
  const Status status = set(settings);
  if (!status && state.started) return status;
  fit_scale(settings);
  ++settings.revision;
  if (!status) {
    settings.problem = status.error().message;
    settings.problem_property = id;
  } else if (settings.problem_property == id) {
    settings.problem.clear();
    settings.problem_property = 0;
  }
  return {};
}

Status set_parameter(ElementState& state, guint id, const ParameterInfo& info,
                     const GValue& value) {
  return set_or_keep_problem(state, id, [&](Settings& settings) {
    return set_parameter_from_value(settings.parameters, info, value);
  });
}

Status set_alignment(ElementState& state, guint id, const GValue& value) {
  return set_or_keep_problem(state, id, [&](Settings& settings) {
    Status status = set_alignment_from_value(settings.alignment, id, value);
    // The field that was found is no longer the one to read.
    if (status && id == kAlignmentField) state.alignment_report.field.reset();
    return status;
  });
}

/// Reports a value that was refused; call it without the object lock.
void warn_of_value(ElementState& state, const Status& status, const GParamSpec* spec) {
  if (status) return;
  GValue value = G_VALUE_INIT;
  g_object_get_property(G_OBJECT(state.element), spec->name, &value);
  const TextPointer kept(gst_value_serialize(&value));
  g_value_unset(&value);
  std::string text = status.error().message;
  if (text.find(spec->name) == std::string::npos) text = std::string(spec->name) + ": " + text;
  post_settings_warning(state, text + ". The property keeps its last value.",
                        std::string(spec->name) + " stays " + (kept ? kept.get() : "empty"));
}

/// The properties of the base class for waits. It adds them to other times without limits.
void set_wait(ElementState& state, const GValue& value, const GParamSpec* spec) {
  auto* base_class = G_OBJECT_CLASS(state.base_class);
  GParamSpec* base = g_object_class_find_property(base_class, spec->name);
  GValue limited = G_VALUE_INIT;
  g_value_init(&limited, G_TYPE_UINT64);
  g_value_set_uint64(&limited, MIN(g_value_get_uint64(&value), guint64{kLongestWait}));
  base_class->set_property(G_OBJECT(state.element), base->param_id, &limited, base);
  g_value_unset(&limited);
}

void get_wait(ElementState& state, GValue& value, const GParamSpec* spec) {
  auto* base_class = G_OBJECT_CLASS(state.base_class);
  GParamSpec* base = g_object_class_find_property(base_class, spec->name);
  base_class->get_property(G_OBJECT(state.element), base->param_id, &value, base);
}

GType sync_mode_type() {
  static const GEnumValue values[] = {
      {static_cast<gint>(SyncMode::kRunningTime), "By the running times of the time stamps",
       "running-time"},
      {static_cast<gint>(SyncMode::kArrival),
       "In the order of arrival, without a look at time stamps", "arrival"},
      {static_cast<gint>(SyncMode::kFirstPts),
       "By the running times since the first frame of each stream", "first-pts"},
      {static_cast<gint>(SyncMode::kReferenceTimestamp),
       "By the reference time stamps of the frames (NTP, PTP)", "reference-timestamp"},
      {0, nullptr, nullptr}};
  static const GType type = [] {
    const GType made = g_enum_register_static("GstMtStereoSyncMode", values);
    gst_type_mark_as_plugin_api(made, static_cast<GstPluginAPIFlags>(0));
    return made;
  }();
  return type;
}

GstStructure* statistics_structure(const Statistics& statistics, const AlignmentReport& alignment,
                                   int scale) {
  const double mean =
      statistics.pairs > 0 ? statistics.total_ms / static_cast<double>(statistics.pairs) : 0.0;
  GstStructure* structure = gst_structure_new(
      "mtstereo-stats", "disparity-scale", G_TYPE_INT, scale, "pairs", G_TYPE_UINT64,
      statistics.pairs, "dropped-left", G_TYPE_UINT64, statistics.dropped[0], "dropped-right",
      G_TYPE_UINT64, statistics.dropped[1], "skipped", G_TYPE_UINT64, statistics.skipped, "last-ms",
      G_TYPE_DOUBLE, statistics.last_ms, "mean-ms", G_TYPE_DOUBLE, mean, "density", G_TYPE_DOUBLE,
      statistics.density, "half-resolution", G_TYPE_BOOLEAN,
      static_cast<gboolean>(statistics.half_resolution), "fine-detail", G_TYPE_DOUBLE,
      statistics.fine_detail, "wrong-times", G_TYPE_UINT64, statistics.wrong_times, "difference-ms",
      G_TYPE_DOUBLE, statistics.difference.mean * 1e-6, "difference-spread-ms", G_TYPE_DOUBLE,
      statistics.difference.spread * 1e-6, "difference-drift", G_TYPE_DOUBLE,
      statistics.difference.drift * 1e-6, nullptr);
  add_alignment_fields(structure, alignment);
  return structure;
}

constexpr auto kFlags = static_cast<GParamFlags>(G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS |
                                                 GST_PARAM_MUTABLE_PLAYING);

void install_wait_properties(GObjectClass* object_class) noexcept {
  g_object_class_install_property(
      object_class, kSyncTolerance,
      g_param_spec_int64("sync-tolerance", "sync-tolerance",
                         "Largest difference of the running times of a left and a right frame that "
                         "are a pair, in nanoseconds (-1: half the frame duration of the faster "
                         "stream; more than one hour: one hour)",
                         -1, G_MAXINT64, -1, kFlags));
  g_object_class_install_property(
      object_class, kSyncMode,
      g_param_spec_enum("sync-mode", "sync-mode", "The times by which frames are paired",
                        sync_mode_type(), static_cast<gint>(SyncMode::kRunningTime), kFlags));
  g_object_class_install_property(
      object_class, kNewestPair,
      g_param_spec_boolean("newest-pair", "newest-pair",
                           "Live pipelines: match the newest pair, and skip older ones that have "
                           "arrived while a pair was matched, for sinks that report no lateness",
                           FALSE, kFlags));
  g_object_class_install_property(
      object_class, kTimeout,
      g_param_spec_uint64("timeout", "timeout",
                          "Streams that are not live: how long frames wait for a frame of the "
                          "other pad, in nanoseconds, until the element reports an error if that "
                          "pad is not linked, or a warning if it is silent (0: wait without a "
                          "report)",
                          0, G_MAXUINT64, 5 * GST_SECOND, kFlags));
  g_object_class_install_property(
      object_class, kLatency,
      g_param_spec_uint64("latency", "latency",
                          "Additional wait for a partner in live pipelines, in nanoseconds, at "
                          "most one hour",
                          0, G_MAXUINT64, 0, kFlags));
  g_object_class_install_property(
      object_class, kMinUpstreamLatency,
      g_param_spec_uint64("min-upstream-latency", "min-upstream-latency",
                          "Latency to assume of sources that are linked later, in nanoseconds, at "
                          "most one hour",
                          0, G_MAXUINT64, 0, kFlags));
}

}  // namespace

void install_properties(GObjectClass* object_class) noexcept {
  install_parameter_properties(object_class);
  install_alignment_properties(object_class);
  install_wait_properties(object_class);
  g_object_class_install_property(
      object_class, kDisparityScale,
      g_param_spec_int(
          "disparity-scale", "disparity-scale",
          "Steps per px of the output: disparity in px = value / disparity-scale, "
          "0 = none; plus min-disparity if that is negative; the number of disparities "
          "times this value must fit in 16 bits (256: KITTI, 16: OpenCV). If it is not set "
          "and 256 does not fit: the next of 128, 64, ... that does",
          1, 65535, 256, kFlags));
  g_object_class_install_property(
      object_class, kConfidenceMap,
      g_param_spec_boolean("confidence-map", "confidence-map",
                           "Attach the confidence of every value to the disparity map: field "
                           "\"confidence\" of the meta MtStereoConfidenceMeta, a GRAY8 sample with "
                           "values from 1 (lowest) to 255 (highest), 0 = no disparity",
                           TRUE, kFlags));
  g_object_class_install_property(
      object_class, kQos,
      g_param_spec_boolean("qos", "qos",
                           "Skip pairs whose maps would be too late at the sink; sinks with "
                           "sync=false report no lateness",
                           TRUE, kFlags));
  g_object_class_install_property(
      object_class, kStats,
      g_param_spec_boxed(
          "stats", "stats",
          "Statistics since the start: pairs (matched pairs), dropped-left and "
          "dropped-right (frames without a partner), skipped (pairs that were too "
          "late, or not the newest), wrong-times (of the dropped frames, those "
          "with a wrong time stamp), difference-ms, difference-spread-ms and "
          "difference-drift (of the times of the pairs: mean, standard deviation, "
          "and change in ms per s), last-ms and mean-ms (time of a pair), density "
          "(share of the last map's pixels with a disparity), half-resolution (the last "
          "pair was matched at half resolution), fine-detail (energy in the finest "
          "octave divided by that in the next one, resolution=auto only); alignment of the "
          "views: offset (px), roll (degrees), residual (px), trust, applied, inspections, "
          "sharpness (left / right), left-blur and right-blur (px), problem",
          GST_TYPE_STRUCTURE, static_cast<GParamFlags>(G_PARAM_READABLE | G_PARAM_STATIC_STRINGS)));
}

void set_element_property(ElementState& state, guint id, const GValue* value, GParamSpec* spec) {
  if (const ParameterInfo* info = parameter_of_property(id)) {
    warn_of_value(state, set_parameter(state, id, *info, *value), spec);
    return;
  }
  if (is_alignment_property(id)) {
    warn_of_value(state, set_alignment(state, id, *value), spec);
    return;
  }
  if (id == kLatency || id == kMinUpstreamLatency) {
    set_wait(state, *value, spec);
    return;
  }
  {
    const ObjectLock lock(state.element);
    switch (id) {
      case kDisparityScale:
        state.settings.disparity_scale = g_value_get_int(value);
        state.settings.scale_is_set = true;
        ++state.settings.revision;
        return;
      case kConfidenceMap:
        state.settings.confidence_map = g_value_get_boolean(value);
        ++state.settings.revision;
        return;
      case kQos:
        state.settings.qos = g_value_get_boolean(value);
        return;
      case kTimeout:
        state.settings.timeout = g_value_get_uint64(value);
        return;
      case kSyncMode:
        state.settings.sync_mode = static_cast<SyncMode>(g_value_get_enum(value));
        return;
      case kNewestPair:
        state.newest_pair = g_value_get_boolean(value) != FALSE;
        return;
      case kSyncTolerance:
        state.settings.sync_tolerance = MIN(g_value_get_int64(value), kLongestWait);
        break;
      default:
        G_OBJECT_WARN_INVALID_PROPERTY_ID(state.element, id, spec);
        return;
    }
  }
  // Takes the lock of the aggregator, which comes before the object lock.
  update_pairing_latency(state);
}

void get_element_property(ElementState& state, guint id, GValue* value, GParamSpec* spec) {
  if (id == kLatency || id == kMinUpstreamLatency) {
    get_wait(state, *value, spec);
    return;
  }
  const ObjectLock lock(state.element);
  if (const ParameterInfo* info = parameter_of_property(id)) {
    parameter_to_value(state.settings.parameters, *info, *value);
    return;
  }
  if (is_alignment_property(id)) {
    alignment_to_value(state.settings.alignment, state.settings.parameters.preset(),
                       state.alignment_report.field, id, *value);
    return;
  }
  switch (id) {
    case kDisparityScale:
      g_value_set_int(value, state.settings.disparity_scale);
      return;
    case kSyncTolerance:
      g_value_set_int64(value, state.settings.sync_tolerance);
      return;
    case kConfidenceMap:
      g_value_set_boolean(value, state.settings.confidence_map);
      return;
    case kQos:
      g_value_set_boolean(value, state.settings.qos);
      return;
    case kTimeout:
      g_value_set_uint64(value, state.settings.timeout);
      return;
    case kSyncMode:
      g_value_set_enum(value, static_cast<gint>(state.settings.sync_mode));
      return;
    case kNewestPair:
      g_value_set_boolean(value, state.newest_pair);
      return;
    case kStats:
      g_value_take_boxed(value, statistics_structure(state.statistics, state.alignment_report,
                                                     state.settings.disparity_scale));
      return;
    default:
      G_OBJECT_WARN_INVALID_PROPERTY_ID(state.element, id, spec);
  }
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/properties.hpp"

#include <algorithm>
#include <string>

#include "matcher/stream_changes.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {
namespace {

/// Largest wait [ns]. Deadlines are sums of several waits, which must not overflow.
constexpr gint64 kLongestWait = 3600 * static_cast<gint64>(GST_SECOND);

GType sync_mode_type() {
  static const GType type = enum_type<SyncMode>(
      "GstMtStereoSyncMode",
      {{SyncMode::kRunningTime, "By the running times of the time stamps", "running-time"},
       {SyncMode::kArrival, "In the order of arrival, ignoring time stamps", "arrival"},
       {SyncMode::kFirstPts, "By the running times since the first frame of each stream",
        "first-pts"},
       {SyncMode::kReferenceTimestamp, "By the reference time stamps of the frames (NTP, PTP)",
        "reference-timestamp"}});
  return type;
}

/// The properties that act at once.
const PropertyTable<FlowSettings>& flow_properties() {
  static const PropertyTable<FlowSettings> table(
      {
          {"sync-tolerance", &FlowSettings::sync_tolerance, -1, G_MAXINT64,
           "Largest difference of running times within a pair, in nanoseconds (-1: half the frame "
           "duration of the faster stream; more than one hour: "
           "one hour)"},
          {"sync-mode", &FlowSettings::sync_mode, sync_mode_type(), "Times used to pair frames"},
          {"newest-pair", &FlowSettings::newest_pair,
           "Live pipelines: match the newest pair, and skip older ones that arrived during "
           "matching; for sinks that report no lateness"},
          {"timeout", &FlowSettings::timeout, 0, G_MAXUINT64,
           "Streams that are not live: time in nanoseconds until a pad without frames is reported, "
           "as an error if it is not linked, as a warning if it is silent; live streams without "
           "any frame are reported after twice this time (0: never)"},
          {"qos", &FlowSettings::qos,
           "Skip pairs whose maps would be too late at the sink; sinks with sync=false report no "
           "lateness"},
      },
      match_properties().end());
  return table;
}

/// The other properties: two of the base class, and one that is read only.
enum Other : guint { kLatency, kMinUpstreamLatency, kStats };
guint number_of(Other other) { return flow_properties().end() + other; }

constexpr const char* kStatsBlurb =
    "Statistics since the start: pairs (matched pairs), dropped-left and dropped-right (frames "
    "without a partner), skipped (pairs that were too late, or not the newest), wrong-times (of "
    "the dropped frames, those with a wrong time stamp), difference-ms, difference-spread-ms and "
    "difference-drift (of the times of the pairs: mean, standard deviation, and change in ms per "
    "s), last-ms and mean-ms (matching time), density (share of pixels with a disparity in the "
    "last map), half-resolution (the last pair was matched at half resolution), fine-detail "
    "(energy in the finest octave divided by that in the next one, resolution=auto only); "
    "alignment of the views: offset (px), roll (degrees), residual (px), trust, applied, "
    "inspections, sharpness (left / right), left-blur and right-blur (px), problem";

GstStructure* statistics_structure(const ElementState& state) {
  const PairingStatistics paired = state.pairing.statistics();
  const MatchStatistics matched = state.engine.statistics();
  const double mean =
      matched.pairs > 0 ? matched.total_ms / static_cast<double>(matched.pairs) : 0.0;
  const MatchSettings settings = state.properties.current();
  GstStructure* structure = gst_structure_new(
      "mtstereo-stats", "disparity-scale", G_TYPE_INT, settings.disparity_scale, "pairs",
      G_TYPE_UINT64, matched.pairs, "dropped-left", G_TYPE_UINT64, paired.dropped[0],
      "dropped-right", G_TYPE_UINT64, paired.dropped[1], "skipped", G_TYPE_UINT64,
      state.output.punctuality.skipped(), "last-ms", G_TYPE_DOUBLE, matched.last_ms, "mean-ms",
      G_TYPE_DOUBLE, mean, "density", G_TYPE_DOUBLE, matched.density, "half-resolution",
      G_TYPE_BOOLEAN, static_cast<gboolean>(matched.half_resolution), "fine-detail", G_TYPE_DOUBLE,
      matched.fine_detail, "wrong-times", G_TYPE_UINT64, paired.wrong_times, "difference-ms",
      G_TYPE_DOUBLE, paired.difference.mean * 1e-6, "difference-spread-ms", G_TYPE_DOUBLE,
      paired.difference.spread * 1e-6, "difference-drift", G_TYPE_DOUBLE,
      paired.difference.drift * 1e-6, nullptr);
  AlignmentReport alignment = state.engine.alignment();
  alignment.field = alignment.current_field(settings.alignment);
  add_alignment_fields(structure, alignment);
  return structure;
}

/// Reports a value that was refused; call it without locks.
void warn_of_value(ElementState& state, const Status& status, const GParamSpec* spec) {
  if (status) return;
  GValue value = G_VALUE_INIT;
  g_object_get_property(G_OBJECT(state.element), spec->name, &value);
  const TextPointer kept(gst_value_serialize(&value));
  g_value_unset(&value);
  std::string text = status.error().message;
  if (text.find(spec->name) == std::string::npos) text = std::string(spec->name) + ": " + text;
  state.messages.warning_of_property(
      text + ". The property keeps its previous value.",
      std::string(spec->name) + " stays " + (kept ? kept.get() : "empty"));
}

void set_flow_property(ElementState& state, guint id, const GValue& value) {
  {
    const ObjectLock lock(state.element);
    flow_properties().set(state.flow, id, value);
    state.flow.sync_tolerance = std::min(state.flow.sync_tolerance, kLongestWait);
    state.pairing.set_mode(state.flow.sync_mode);
    state.pairing.set_tolerance(state.flow.sync_tolerance);
  }
  // Takes the lock of the aggregator, which comes before the object lock.
  update_pairing_latency(state);
}

/// Sets a property of the base class, which adds waits to other times without limits. `spec` is
/// that of the base class.
void set_wait(ElementState& state, const GValue& value, const GParamSpec* spec) {
  GValue limited = G_VALUE_INIT;
  g_value_init(&limited, G_TYPE_UINT64);
  g_value_set_uint64(&limited, std::min(g_value_get_uint64(&value), guint64{kLongestWait}));
  G_OBJECT_CLASS(state.base_class)
      ->set_property(G_OBJECT(state.element), spec->param_id, &limited,
                     const_cast<GParamSpec*>(spec));
  g_value_unset(&limited);
}

}  // namespace

void install_properties(GObjectClass* object_class) noexcept {
  match_properties().install(object_class);
  flow_properties().install(object_class);
  // Their values are limited; all else is left to the base class.
  g_object_class_override_property(object_class, number_of(kLatency), "latency");
  g_object_class_override_property(object_class, number_of(kMinUpstreamLatency),
                                   "min-upstream-latency");
  g_object_class_install_property(
      object_class, number_of(kStats),
      g_param_spec_boxed("stats", "stats", kStatsBlurb, GST_TYPE_STRUCTURE,
                         static_cast<GParamFlags>(G_PARAM_READABLE | G_PARAM_STATIC_STRINGS)));
}

void set_element_property(ElementState& state, guint id, const GValue& value,
                          const GParamSpec* spec) {
  if (match_properties().has(id)) {
    warn_of_value(state, state.properties.set(id, value), spec);
  } else if (flow_properties().has(id)) {
    set_flow_property(state, id, value);
  } else {
    set_wait(state, value, spec);
  }
}

void get_element_property(ElementState& state, guint id, GValue& value, const GParamSpec* spec) {
  if (match_properties().has(id)) {
    state.properties.get(id, state.engine.alignment(), value);
  } else if (flow_properties().has(id)) {
    flow_properties().get(state.flow_settings(), id, value);
  } else if (id == number_of(kStats)) {
    g_value_take_boxed(&value, statistics_structure(state));
  } else {
    G_OBJECT_CLASS(state.base_class)
        ->get_property(G_OBJECT(state.element), spec->param_id, &value,
                       const_cast<GParamSpec*>(spec));
  }
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/silent_pads.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace mtstereo::plugin {
namespace {

Nanoseconds timeout_of(const ElementState& state) {
  return static_cast<Nanoseconds>(
      std::min<guint64>(state.flow_settings().timeout, static_cast<guint64>(G_MAXINT64)));
}

/// True if the pipeline waits until each of its sinks has data.
bool prerolls(GstElement* element) {
  auto* top = GST_OBJECT_CAST(gst_object_ref(element));
  while (GstObject* parent = gst_object_get_parent(top)) {
    gst_object_unref(top);
    top = parent;
  }
  bool waits = false;
  {
    const ObjectLock lock(top);
    waits = GST_STATE_RETURN(top) == GST_STATE_CHANGE_ASYNC;
  }
  gst_object_unref(top);
  return waits;
}

StreamsObservation observe(const ElementState& state) {
  StreamsObservation streams;
  for (const Side side : kSides) {
    GstAggregatorPad* const pad = state.pairing.pad(side);
    streams.waiting[index_of(side)] =
        gst_aggregator_pad_has_buffer(pad) != FALSE || state.pairing.holds(side);
    streams.ended[index_of(side)] = gst_aggregator_pad_is_eos(pad) != FALSE;
  }
  const guint64 pairs = state.engine.statistics().pairs;
  const PairingStatistics paired = state.pairing.statistics();
  const bool mapped = pairs > state.progress.pairs_before;
  streams.starting = mapped && state.progress.busy && prerolls(GST_ELEMENT_CAST(state.element));
  // A paused pipeline that has its first map is paused by its user, who may pause the sources too.
  streams.busy = state.progress.busy || (mapped && !state.clock.playing());
  streams.progress =
      pairs + state.output.punctuality.skipped() + paired.dropped[0] + paired.dropped[1];
  return streams;
}

std::string seconds(Nanoseconds time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", static_cast<double>(time) / 1e9);
  return text;
}

/// Reports a silent pad. Frames of live streams have a deadline, and are reported there.
void report(ElementState& state, Side silent, Nanoseconds timeout) {
  if (state.clock.is_live()) return;
  const Side waiting = other_side(silent);
  const std::string pad = pad_name(silent);
  const std::string details = "waited for " + seconds(timeout) + " (property timeout)";
  if (gst_pad_is_linked(GST_PAD_CAST(state.pairing.pad(silent)))) {
    state.messages.warning_of_pad(
        std::string("Frames wait on ") + pad_name(waiting) + ", but none has arrived on " + pad +
            " for " + seconds(timeout) +
            ". Check the source of that stream. If both streams come from one element, put a "
            "queue upstream of each pad.",
        details);
    return;
  }
  state.messages.error_of_pad(std::string("Frames wait on ") + pad_name(waiting) + ", but " + pad +
                                  " is not linked. " + how_to_link(silent),
                              details);
  // The source of the other stream gets the error with its next frame.
  state.pairing.refuse(waiting);
}

void report_start(ElementState& state, Nanoseconds timeout) {
  state.messages.warning_of_pad(
      "The pipeline does not start: downstream holds a map for " + seconds(timeout) +
          ", because another sink has no data yet. Put a queue in each branch of a tee; where an "
          "encoder collects frames first, set it to low latency (x264enc tune=zerolatency).",
      "waited for " + seconds(timeout) + " (property timeout)");
}

}  // namespace

Watchdog::Functions watch_pads(ElementState& state) {
  return {[&state] { return observe(state); }, [&state] { return timeout_of(state); },
          [&state](Side silent, Nanoseconds timeout) { report(state, silent, timeout); },
          [&state](Nanoseconds timeout) { report_start(state, timeout); }};
}

}  // namespace mtstereo::plugin

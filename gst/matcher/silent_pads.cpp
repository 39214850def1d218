// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/silent_pads.hpp"

#include <gst/base/gstbasesrc.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace mtstereo::plugin {
namespace {

Nanoseconds timeout_of(const ElementState& state) {
  return static_cast<Nanoseconds>(
      std::min<guint64>(state.flow_settings().timeout, static_cast<guint64>(G_MAXINT64 / 2)));
}

/// The pipeline of an element.
ObjectPointer top_of(const ElementState& state) {
  ObjectPointer top(GST_OBJECT_CAST(gst_object_ref(state.element)));
  while (GstObject* parent = gst_object_get_parent(top.get())) top.reset(parent);
  return top;
}

/// True if the pipeline waits until each of its sinks has data.
bool prerolls(const ElementState& state) {
  const ObjectPointer top = top_of(state);
  const ObjectLock lock(top.get());
  return GST_STATE_RETURN(top.get()) == GST_STATE_CHANGE_ASYNC;
}

/// 0 for a live source.
gint compare_with_live(gconstpointer item, gconstpointer) noexcept {
  gpointer element = g_value_get_object(static_cast<const GValue*>(item));
  return GST_IS_BASE_SRC(element) && gst_base_src_is_live(GST_BASE_SRC(element)) ? 0 : 1;
}

/// True if any source of the pipeline is live, also one that is not linked to the element yet.
bool has_live_source(const ElementState& state) {
  const ObjectPointer top = top_of(state);
  if (!GST_IS_BIN(top.get())) return false;
  GstIterator* elements = gst_bin_iterate_recurse(GST_BIN(top.get()));
  GValue source = G_VALUE_INIT;
  const bool found = gst_iterator_find_custom(elements, compare_with_live, &source, nullptr);
  if (found) g_value_unset(&source);
  gst_iterator_free(elements);
  return found;
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
  streams.starting = mapped && state.progress.busy && prerolls(state);
  // A paused pipeline that has its first map is paused by its user, who may pause the sources too.
  streams.busy = state.progress.busy || (mapped && !state.clock.playing());
  streams.progress =
      pairs + state.output.punctuality.skipped() + paired.dropped[0] + paired.dropped[1];
  const auto [waits, other_waits] = streams.waiting;
  const auto [ended, other_ended] = streams.ended;
  streams.empty = state.clock.playing() && streams.progress == 0 && !state.progress.busy &&
                  !(waits || other_waits || ended || other_ended);
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

std::string state_of_pad(const ElementState& state, Side side) {
  GstPad* const pad = GST_PAD_CAST(state.pairing.pad(side));
  const char* const text = !gst_pad_is_linked(pad)         ? " is not linked"
                           : gst_pad_has_current_caps(pad) ? " has a format"
                                                           : " has no format yet";
  return pad_name(side) + std::string(text);
}

/// Reports live streams that do not begin. Files may take any time to open.
void report_empty(ElementState& state, Nanoseconds time) {
  if (state.messages.failed() || !(state.clock.is_live() || has_live_source(state))) return;
  state.messages.warning_of_pad(
      "No frame has arrived on sink_left and sink_right for " + seconds(time) +
          " since the start. Check that both cameras deliver, or that the sender runs, and that "
          "its port is this one and no firewall blocks it; run each source alone (SOURCE ! "
          "fakesink silent=false -v). A decoder delivers nothing before the first key frame: the "
          "sender must repeat it and its parameters (x264enc key-int-max=30, rtph264pay "
          "config-interval=-1).",
      state_of_pad(state, Side::kLeft) + ", " + state_of_pad(state, Side::kRight) +
          "; waited for " + seconds(time) + " (twice the property timeout)");
}

}  // namespace

Watchdog::Functions watch_pads(ElementState& state) {
  return {[&state] { return observe(state); }, [&state] { return timeout_of(state); },
          [&state](Side silent, Nanoseconds timeout) { report(state, silent, timeout); },
          [&state](Nanoseconds timeout) { report_start(state, timeout); },
          [&state](Nanoseconds time) { report_empty(state, time); }};
}

}  // namespace mtstereo::plugin

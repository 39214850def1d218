// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>

#include <atomic>
#include <optional>

#include "matcher/base/clock.hpp"
#include "matcher/base/messages.hpp"
#include "matcher/base/stream_formats.hpp"
#include "matcher/engine/engine.hpp"
#include "matcher/match_properties.hpp"
#include "matcher/output/output.hpp"
#include "matcher/pairing/pairing.hpp"
#include "matcher/pairing_reports.hpp"
#include "matcher/watchdog.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The properties that act at once.
struct FlowSettings {
  SyncMode sync_mode = SyncMode::kRunningTime;
  gint64 sync_tolerance = -1;        ///< [ns]; -1: see effective_tolerance()
  bool newest_pair = false;          ///< live: skip pairs for which there is a newer one
  bool qos = true;                   ///< skip pairs that are too late
  guint64 timeout = 5 * GST_SECOND;  ///< until a silent pad is reported [ns]; 0: never
};

/// What the watchdog sees of the task of the source pad. Any thread.
struct Progress {
  std::atomic<bool> busy = false;         ///< a pair is being matched, or downstream blocks
  std::atomic<guint64> pairs_before = 0;  ///< matched pairs at the last flush
};

/// Marks the task of the source pad as busy during its lifetime.
class BusyMark {
 public:
  explicit BusyMark(Progress& progress) : progress_(progress) { progress_.busy = true; }
  ~BusyMark() { progress_.busy = false; }
  BusyMark(const BusyMark&) = delete;
  BusyMark& operator=(const BusyMark&) = delete;

 private:
  Progress& progress_;
};

/// One mtstereo element. Created in its init, deleted in its finalize. A frame passes `pairing`,
/// `engine` and `output`, in this order; each of them states who may use it and what its lock
/// guards. None calls another one: the functions of the element do (frame_flow.hpp).
struct ElementState {
  ElementState(GstAggregator* aggregator, GstAggregatorClass* base,
               Watchdog::Functions (*watch)(ElementState&))
      : element(aggregator), base_class(base), watchdog(aggregator, watch(*this)) {}

  GstAggregator* const element;              ///< owns this state
  GstAggregatorClass* const base_class;      ///< to chain up to
  GstPadChainFunction base_chain = nullptr;  ///< of the sink pads

  StreamFormats formats;
  Messages messages{GST_ELEMENT_CAST(element), formats};
  PipelineClock clock{element};

  MatchProperties properties;  ///< has its own lock
  FlowSettings flow;           ///< guarded by the object lock of the element

  Pairing pairing;
  Engine engine{messages, formats};
  Output output{element, clock};

  PairingReports pairing_reports{messages, pairing.pairer()};
  Progress progress;
  Watchdog watchdog;

  // Used by the task of the source pad, and by start, stop and flush while the task does not run.
  int checked_width = 0;  ///< the frame size for which the settings were checked [px]
  int checked_height = 0;
  bool geometry_compared = false;            ///< of the streams whose caps are adopted
  std::optional<guint32> end_seqnum;         ///< of the end of the stream that ended first
  GstFlowReturn pending_flow = GST_FLOW_OK;  ///< of a call that the base class did not make

  /// A flush.
  void restart() {
    messages.clear();
    end_seqnum.reset();
    pending_flow = GST_FLOW_OK;
  }

  FlowSettings flow_settings() const {
    const ObjectLock lock(element);
    return flow;
  }
};

}  // namespace mtstereo::plugin

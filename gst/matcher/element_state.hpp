// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>
#include <gst/video/video.h>

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "matcher/engine/alignment.hpp"
#include "matcher/engine/view_borders.hpp"
#include "matcher/output/latency.hpp"
#include "matcher/output/lateness.hpp"
#include "matcher/pairing/frame_queue.hpp"
#include "matcher/pairing/pair_finder.hpp"
#include "matcher/pairing/pair_times.hpp"
#include "matcher/pairing/tolerance.hpp"
#include "matcher/watchdog.hpp"
#include "mtstereo/matcher.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/confidence_pool.hpp"
#include "shared/luma.hpp"

namespace mtstereo::plugin {

/// The debug category of the element.
GST_DEBUG_CATEGORY_EXTERN(mtstereo_debug);

/// "sink_left" or "sink_right".
const char* pad_name(Side side);

/// The values of the properties. Each pair is matched with one copy of them.
struct Settings {
  Parameters parameters;
  AlignmentSettings alignment;
  int disparity_scale = 256;   ///< [steps per px]
  bool scale_is_set = false;   ///< otherwise it follows the search range, see fit_scale()
  gint64 sync_tolerance = -1;  ///< [ns]; -1: see effective_tolerance()
  bool confidence_map = true;  ///< attach a confidence map to every disparity map
  SyncMode sync_mode = SyncMode::kRunningTime;
  bool qos = true;                   ///< skip pairs that are too late
  guint64 timeout = 5 * GST_SECOND;  ///< until a silent pad is reported [ns]; 0: never
  std::string problem;  ///< why a value was rejected, the error of the next start; "" if none
  guint problem_property = 0;  ///< the id of the property of `problem`
  guint64 revision = 0;        ///< incremented by every change
};

/// The fields of the property `stats`.
struct Statistics {
  guint64 pairs = 0;
  std::array<guint64, 2> dropped{};  ///< frames without a partner, by side
  guint64 skipped = 0;      ///< pairs that were too late to be matched (QoS), or not the newest
  guint64 wrong_times = 0;  ///< of the dropped frames, those with a wrong time stamp
  DifferenceStatistics difference;  ///< of the times of the pairs
  double last_ms = 0;               ///< time for the last pair: conversion, inspection and matching
  double total_ms = 0;              ///< of all pairs
  double density = 0;               ///< of the last pair
  bool half_resolution = false;     ///< the last pair was matched at half resolution
  double fine_detail = 0;           ///< of the last pair
};

/// The correction in the last message `mtstereo-alignment`.
struct AnnouncedCorrection {
  ViewCorrection correction;
  std::optional<gint64> time;  ///< wall clock [us]
};

/// A sink pad and its stream.
struct Input {
  GstAggregatorPad* pad = nullptr;  ///< owned by the element
  bool has_caps = false;
  GstVideoInfo info{};  ///< of the frame at the head of the pad's queue; valid if has_caps
  std::shared_ptr<const GstStructure> geometry;  ///< of the same frame; nullptr: no caps yet
};

/// How far the segment of the left stream has been sent downstream. The base class sends a segment
/// only before buffers: before other events the element sends it itself.
enum class OutputSegment {
  kNone,     ///< the left stream has had none since the start or the last flush
  kWaiting,  ///< to be sent before the next event
  kSent,
};

/// All data of one mtstereo element. Created in its init, deleted in its finalize.
struct ElementState {
  ElementState(GstAggregator* aggregator, GstAggregatorClass* base)
      : element(aggregator), base_class(base) {}

  GstAggregator* const element;          ///< owns this state
  GstAggregatorClass* const base_class;  ///< to chain up to

  // Guarded by the element's object lock.
  Settings settings;     ///< the values that the properties return
  Settings complete;     ///< `settings` after the last g_object_set() that has ended
  bool started = false;  ///< a value that is not valid is refused, and no longer a problem
  Statistics statistics;
  AlignmentReport alignment_report;
  FrameDurations caps_durations;  ///< from the framerates of the caps
  Lateness lateness;
  double qos_proportion = 1;  ///< of the last QoS event
  ProcessingLatency processing;
  WatchdogInput watchdog_input;
  SeekHistory seeks;
  bool playing = false;  ///< the base time of the clock is valid
  bool failed = false;   ///< an error was posted; until a flush a second one would hide it

  // Used by the task of the source pad, and by start, stop and flush while the task does not run.
  std::array<Input, 2> inputs;
  Settings active;               ///< the copy in use
  guint64 matcher_revision = 0;  ///< Settings::revision of the matcher's parameters; 0: none
  std::optional<guint64> logged_revision;  ///< Settings::revision of the settings in the log
  int checked_width = 0;                   ///< the frame size for which `active` was checked [px]
  int checked_height = 0;
  std::optional<Matcher> matcher;
  PairAlignment alignment;
  AnnouncedCorrection announced;
  bool logged_half_resolution = false;  ///< the last choice of the matcher in the log
  double inspection_ms = 0;        ///< time for the conversion and the inspection of the last pair
  GstVideoInfo output{};           ///< of the disparity map; valid if the source pad has caps
  std::array<LumaReader, 2> luma;  ///< by side
  Borders borders;                 ///< of the last pair
  long border_pixels = 0;  ///< disparities that were removed from the last map, as in a border
  bool geometry_compared = false;  ///< of the streams whose caps are adopted
  ConfidencePool confidence_pool;
  std::array<std::shared_ptr<const StreamInfo>, 2> adopted_infos;       ///< that of Input::info
  std::shared_ptr<const StreamSegment> output_segment;                  ///< that of the source pad
  std::array<std::shared_ptr<const StreamSegment>, 2> paired_segments;  ///< of the last frames
  SyncMode paired_mode = SyncMode::kRunningTime;
  std::optional<SyncMode> working_mode;  ///< of the last pair
  /// The running time of the first live frame without a reference time stamp since the last pair.
  std::optional<Nanoseconds> unreferenced_since;
  PairFinder finder;
  PairClock clock;
  std::optional<Nanoseconds> logged_offset;  ///< of the streams
  GstFlowReturn pending_flow = GST_FLOW_OK;  ///< of a failure outside of aggregate()
  OutputSegment segment = OutputSegment::kNone;
  bool segment_repeats = false;                 ///< the base class is about to send it once more
  bool start_repeats = false;                   ///< the same of the start of the stream
  guint32 segment_seqnum = GST_SEQNUM_INVALID;  ///< of the left stream's segment
  UnpairedWarning unpaired_warning;
  DoubtWarning doubt_warning;
  WaitingFrame waiting_frame;      ///< the frame whose partner has not arrived
  GstClockTime known_latency = 0;  ///< added to deadlines by the base class; 0: not known yet

  // Guarded by queue_mutex. Lock it before the object lock, and not while a pair is matched.
  std::mutex queue_mutex;
  std::array<FrameQueue, 2> queues;

  std::atomic<bool> ended = false;                ///< no pair can follow; until a flush
  std::atomic<bool> newest_pair = false;          ///< the property
  std::atomic<std::uint64_t> flushing_seeks = 0;  ///< sent upstream so far

  Watchdog watchdog{*this};  ///< has its own lock

  FrameQueue& queue(Side side) { return queues[static_cast<std::size_t>(side)]; }
  Input& input(Side side) { return inputs[static_cast<std::size_t>(side)]; }
  const Input& input(Side side) const { return inputs[static_cast<std::size_t>(side)]; }
  Side side_of(const GstAggregatorPad* pad) const {
    return pad == input(Side::kLeft).pad ? Side::kLeft : Side::kRight;
  }
  /// Forgets what was learned of the times of the streams.
  void restart_pairing() {
    finder.reset();
    clock.reset();
    logged_offset.reset();
  }
  /// Forgets what was learned of the views.
  void restart_matching() {
    alignment.restart();
    if (matcher) matcher->restart();
  }
  GstPad* source_pad() const { return GST_AGGREGATOR_SRC_PAD(element); }

  /// Makes the property values those of the next pair. Takes the object lock.
  void complete_settings();
  /// A description of both streams for messages: "sink_left: GRAY8 640x480 at 30/1 fps;
  /// sink_right: ...".
  std::string streams_text() const;
};

/// Posts an error message, unless the element has already posted one since the start or the last
/// flush. `text` is for the user: what is wrong and how to correct it; `details` contains the
/// facts.
void post_error(ElementState& state, GQuark domain, gint code, const std::string& text,
                const std::string& details);

/// True if an error was posted since the start or the last flush. Takes the object lock.
bool has_failed(const ElementState& state);

/// Posts a warning message. Call it without locks.
void post_warning(ElementState& state, const std::string& text, const std::string& details);
/// The same for a value of a property, or several, that is refused.
void post_settings_warning(ElementState& state, const std::string& text,
                           const std::string& details);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>
#include <gst/video/video.h>

#include <array>
#include <optional>
#include <string>

#include "matcher/latency.hpp"
#include "matcher/pairing.hpp"
#include "mtstereo/matcher.hpp"
#include "mtstereo/parameters.hpp"
#include "shared/confidence_pool.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// Caps as text for a message.
std::string caps_text(const GstCaps* caps);

inline constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

/// "sink_left", "sink_right".
const char* pad_name(Side side);

/// What the user set. A pair is matched with one copy of it from its beginning to its end.
struct Settings {
  Parameters parameters;
  int disparity_scale = 256;   ///< steps per px
  gint64 sync_tolerance = -1;  ///< [ns]; -1: see tolerance_in_force()
  bool confidence_map = true;  ///< every disparity map carries one
  bool qos = true;             ///< pairs that come too late are skipped
  std::string problem;         ///< a value that was refused, told when it matters; "" if none
  const ParameterInfo* problem_parameter = nullptr;  ///< whose value that was
  guint64 revision = 0;                              ///< another one after every change
};

/// The numbers of the property `stats`.
struct Statistics {
  guint64 pairs = 0;
  std::array<guint64, 2> dropped{};  ///< frames without partner, by side
  guint64 skipped = 0;               ///< pairs that were too late to be matched (QoS)
  double last_ms = 0;                ///< of the last pair
  double total_ms = 0;               ///< of all pairs
  double density = 0;                ///< of the last pair
};

/// One sink pad and what is known of its stream.
struct Input {
  GstAggregatorPad* pad = nullptr;  ///< owned by the element
  bool has_caps = false;
  GstVideoInfo info{};  ///< of the frame at the head of the pad's queue; only where has_caps
};

/// Where the left stream's segment is on its way downstream. The base class sends one only ahead of
/// buffers: ahead of anything else it is sent here.
enum class OutputSegment {
  kNone,     ///< the left stream has none, since the start or the last flush
  kWaiting,  ///< to be sent ahead of what comes next
  kSent,
};

/// Everything that one mtstereo element knows. Made in its init, deleted in its finalize.
struct ElementState {
  explicit ElementState(GstAggregator* aggregator) : element(aggregator) {}

  /// The element; it owns this.
  GstAggregator* const element;

  // Guarded by the element's object lock.
  Settings settings;
  Statistics statistics;
  FrameDurations caps_durations;                    ///< what the framerates say
  GstClockTime qos_earliest = GST_CLOCK_TIME_NONE;  ///< frames before this are late [running time]
  double qos_proportion = 1;
  ProcessingLatency processing;
  bool playing = false;  ///< the clock's base time is valid
  bool failed = false;   ///< an error was posted: another one would only hide it

  // Only of the source pad's task, and of start, stop and flush, which run when the task does not.
  std::array<Input, 2> inputs;
  Settings active;               ///< the copy that is in use
  guint64 matcher_revision = 0;  ///< Settings::revision that the matcher has; 0: none
  int checked_width = 0;         ///< the frame size that `active` was checked with [px]
  int checked_height = 0;
  std::optional<Matcher> matcher;
  GstVideoInfo output{};  ///< of the disparity map; valid where the source pad has caps
  ConfidencePool confidence_pool;
  OutputSegment segment = OutputSegment::kNone;
  guint32 segment_seqnum = GST_SEQNUM_INVALID;  ///< of the left stream's segment
  UnpairedAlarm alarm;
  LonelyFrame lonely;              ///< the frame that waits alone for its partner
  GstClockTime known_latency = 0;  ///< that the base class adds to deadlines; 0: not known yet

  Input& input(Side side) { return inputs[static_cast<std::size_t>(side)]; }
  const Input& input(Side side) const { return inputs[static_cast<std::size_t>(side)]; }
  GstPad* source_pad() const { return GST_AGGREGATOR_SRC_PAD(element); }

  /// A copy of what the user set. Takes the object lock.
  Settings snapshot() const;
  /// What a message says of both streams: "sink_left: GRAY8 640x480 30/1 fps; sink_right: ...".
  std::string streams_text() const;
};

/// Posts an error message, unless the element has already posted one since it was started or
/// flushed. `text` is for the user: what is wrong and what to do; `details` holds the facts.
void post_error(ElementState& state, GQuark domain, gint code, const std::string& text,
                const std::string& details);

/// Posts a warning message.
void post_warning(ElementState& state, const std::string& text, const std::string& details);

// negotiation.cpp: all of it runs in the source pad's task, but for sink_caps().

/// The answer to a caps query on a sink pad: what can be taken here, best first. Any thread.
CapsPointer sink_caps(const ElementState& state, Side side, GstCaps* filter);
/// A stream's caps have changed. False where they cannot be taken; an error was posted then.
bool take_sink_caps(ElementState& state, Side side, const GstCaps* caps);
/// The caps of the disparity map, from the left stream and the active settings.
CapsPointer output_caps(const ElementState& state);
/// Takes the settings of this moment and fits the matcher to them and to the left stream. False
/// where they do not fit; an error was posted then.
bool apply_settings(ElementState& state);
/// Tells the base class how long a frame may have to wait for its partner. Any thread, no locks.
void update_pairing_latency(ElementState& state);

// allocation.cpp: runs in the source pad's task.

gboolean decide_allocation(GstAggregator* aggregator, GstQuery* query);
gboolean propose_allocation(GstAggregator* aggregator, GstAggregatorPad* pad,
                            GstQuery* decide_query, GstQuery* query);
/// A buffer for one disparity map, or the reason why there is none.
GstFlowReturn acquire_output(ElementState& state, BufferPointer& buffer);
/// Copies what belongs to a left frame beside its pixels: time stamps, flags and metas.
void copy_frame_properties(GstBuffer* left, GstBuffer* right, GstBuffer* output);

// confidence.cpp: runs in the source pad's task.

/// Gives a disparity map that was computed and has its times the confidence of its pixels. False
/// where there is no memory for it; an error was posted then.
bool attach_confidence(ElementState& state, GstBuffer* output);

// aggregation.cpp: runs in the source pad's task.

/// One step: pairs the heads of the two streams, or drops one of them.
GstFlowReturn aggregate(ElementState& state, bool timeout);
/// Until when to wait for the partner of a frame that waits alone [running time]; the base class
/// adds the latency to it and holds its own lock meanwhile.
GstClockTime next_deadline(ElementState& state);
/// One stream is over and all its frames are matched or dropped: no pair can follow. The base class
/// would wait for a frame or the end of the other stream, which may never come.
void end_output(ElementState& state, guint32 seqnum);
/// Tells downstream that there is no disparity for a span of time. Only where nothing may follow
/// for a while: a sink waits for the time of a gap.
void send_gap(ElementState& state, GstClockTime pts, GstClockTime duration);

// matching.cpp: runs in the source pad's task.

/// Matches a pair and pushes its disparity map. The buffers stay the caller's.
GstFlowReturn match_pair(ElementState& state, GstBuffer* left, GstBuffer* right);

// queries.cpp: any thread.

/// Answers queries on the source pad; std::nullopt: the base class is to answer.
std::optional<bool> answer_source_query(ElementState& state, GstQuery* query);
/// Adds the time that matching takes to the answer of the base class.
void add_processing_latency(ElementState& state, GstQuery* query);
/// Remembers what downstream tells about frames that come too late. True where the event is to go
/// on to the sources: not if every pair is wanted, as they would drop frames of one side.
bool take_qos_event(ElementState& state, GstEvent* event);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>

#include <memory>

#include "matcher/base/stream_segment.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

/// Sends the events of the source pad that the base class does not send: gaps, the segment before a
/// first gap, and an end while one stream is still silent.
///
/// In GStreamer 1.22 a subclass of GstAggregator can only push such events on the pad itself. The
/// base class does not learn of it: before its first buffer it sends stream-start and segment once
/// more, and a sink would wait for a second end. A probe on the pad drops those. From
/// GStreamer 1.26 on, gst_aggregator_push_src_event() can replace this class.
///
/// Used by the task of the source pad, and by start, stop and flush while the task does not run.
class SourceEvents {
 public:
  /// The source pad must outlive this object, which stays where it is.
  explicit SourceEvents(GstAggregator* element);
  SourceEvents(const SourceEvents&) = delete;
  SourceEvents& operator=(const SourceEvents&) = delete;

  /// The segment of the frames that follow. False if it has not changed since the last frame.
  bool adopt_segment(const std::shared_ptr<const StreamSegment>& segment);
  /// Signals that a span of time has no disparity. Send it only if no map can follow soon: a sink
  /// waits until the time of a gap.
  void send_gap(GstClockTime pts, GstClockTime duration);
  /// The same at a running time.
  void send_gap_at(Nanoseconds running_time, GstClockTime duration);
  /// Ends the output: no further pair is possible. The base class would wait for the other stream,
  /// possibly forever.
  void end(guint32 seqnum);
  /// The base class is about to send a buffer, and the segment before it.
  void before_buffer() { segment_ = Segment::kSent; }

  /// A flush.
  void restart();
  void start();

 private:
  /// How far the segment of the left stream has been sent downstream.
  enum class Segment {
    kNone,     ///< the left stream has had none since the start or the last flush
    kWaiting,  ///< to be sent before the next event
    kSent,
  };
  static GstPadProbeReturn on_event(GstPad* pad, GstPadProbeInfo* info, gpointer self) noexcept;
  GstPad* pad() const { return GST_AGGREGATOR_SRC_PAD(element_); }
  bool send_segment();

  GstAggregator* const element_;
  std::shared_ptr<const StreamSegment> adopted_;
  Segment segment_ = Segment::kNone;
  bool segment_repeats_ = false;  // the base class is about to send it once more
  bool start_repeats_ = false;    // the same of the start of the stream
};

}  // namespace mtstereo::plugin

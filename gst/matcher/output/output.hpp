// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>
#include <gst/video/video.h>

#include <memory>

#include "matcher/output/punctuality.hpp"
#include "matcher/output/source_events.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The source pad, and what is sent on it: the last station of a frame. Used by the task of the
/// source pad, and by start, stop and flush while the task does not run.
class Output {
 public:
  Output(GstAggregator* element, const PipelineClock& clock)
      : punctuality(GST_ELEMENT_CAST(element), clock), events(element), element_(element) {}

  GstPad* pad() const { return GST_AGGREGATOR_SRC_PAD(element_); }
  /// True if a flush or the end of the element is under way: the base class sends no buffer.
  bool is_stopping() const { return GST_PAD_IS_FLUSHING(pad()) || !gst_pad_is_active(pad()); }

  /// The negotiated caps of the maps.
  bool set_caps(const GstCaps* caps) { return gst_video_info_from_caps(&info_, caps) != FALSE; }
  /// Valid if the source pad has caps.
  const GstVideoInfo& info() const { return info_; }

  /// The segment of a left frame that is matched, or replaced by a gap, now. True if it is new.
  bool adopt_segment(const std::shared_ptr<const StreamSegment>& segment);
  /// The times of the map of a left frame.
  OutputTimes times(GstBuffer* left) const;
  /// A buffer for the map of a pair, with the times, flags and metas of the left frame.
  GstFlowReturn make_map(GstBuffer* left, GstBuffer* right, BufferPointer& map) const;
  /// Sends a map, `milliseconds` after the decision to match its pair.
  GstFlowReturn send(BufferPointer map, const OutputTimes& times, double milliseconds);

  void start();

  Punctuality punctuality;
  SourceEvents events;

 private:
  GstAggregator* const element_;
  GstVideoInfo info_{};
};

}  // namespace mtstereo::plugin

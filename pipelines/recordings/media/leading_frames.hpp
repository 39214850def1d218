// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <mutex>
#include <optional>

namespace mtstereo::run {

/// Recognizes the leading frames of an open group of pictures where a file was cut, or after a
/// seek: they follow the keyframe in the file, are shown before it, and refer to frames that are
/// not there. They are not shown if the segment starts at the keyframe. Matroska cannot state their
/// times, which are negative.
class LeadingFrames {
 public:
  /// `matroska`: frames without a time are among them.
  explicit LeadingFrames(bool matroska) : matroska_(matroska) {}

  /// Whether the next frame that goes through a pad is one of them, and is not shown.
  bool has(GstPad* pad, const GstBuffer* frame);
  /// The stream continues elsewhere.
  void flush();

 private:
  const bool matroska_;
  std::mutex mutex_;  // guards all below
  std::optional<GstClockTime> keyframe_;
  bool ended_ = false;
};

}  // namespace mtstereo::run

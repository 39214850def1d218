// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "matcher/pairing/pair_finder.hpp"

namespace mtstereo::calibrate {

struct SourceOptions;

/// The gst-launch line of a source, without its sink. Throws UserError if a file or a
/// device does not exist.
std::string launch_line(const std::string& source, const SourceOptions& options);

/// One source in a pipeline, and the frames that have come from it.
class Branch {
 public:
  struct Frame {
    cv::Mat image;                            ///< gray
    std::optional<plugin::Nanoseconds> time;  ///< running time
  };

  /// Adds the source to a pipeline. `name` is "left", "right" or "". Throws UserError.
  Branch(GstPipeline* pipeline, std::string name, std::string source, const SourceOptions& options);

  /// Waits for a frame for a part of a second. True if there is a new one.
  bool pull();
  /// No frames will follow those that have come.
  bool ended() const { return ended_; }
  const std::deque<Frame>& frames() const { return frames_; }
  void erase(std::size_t index);

  /// The frames for the pair finder; valid until the next change.
  plugin::WaitingFrames waiting() const;
  /// Frame durations of the caps and of the last buffer.
  std::optional<plugin::Nanoseconds> caps_period() const { return caps_period_; }
  std::optional<plugin::Nanoseconds> buffer_period() const { return buffer_period_; }

  /// Whether it delivers frames as they happen.
  bool is_live() const;
  /// Frames that are not taken in time are lost from now on.
  void drop_old_frames();
  /// Throws UserError if pull() has waited in vain for so long [s].
  void check_silence(double timeout) const;
  /// Whether a message comes from here.
  bool owns(GstObject* object) const;
  /// "left source (FILE)".
  std::string title() const;

 private:
  void refuse_turned() const;
  void take(GstSample* sample);

  std::string name_, source_;
  bool is_file_;
  GstElement* bin_ = nullptr;  // the pipeline owns both
  GstAppSink* sink_ = nullptr;
  std::deque<Frame> frames_;
  std::vector<plugin::Nanoseconds> times_;
  std::optional<plugin::Nanoseconds> caps_period_, buffer_period_;
  bool ended_ = false;
  double waited_ = 0;  // by pull() since the last frame [s]
};

}  // namespace mtstereo::calibrate

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "recordings/media/libav_log.hpp"
#include "recordings/media/source.hpp"

namespace mtstereo::run {

/// A frame that cannot be decoded as it was coded.
struct DamagedFrame {
  std::optional<Nanoseconds> time;  ///< as that of VideoFrame; none if the file does not state it
  std::string reason;
};

/// What the decoder of one video reports about its frames. Decoders conceal damage and continue;
/// they say so in logs only: libav in its own one, from threads of its own; others as a warning of
/// the category `videodecoder` of GStreamer, from the thread that begins the frame.
class DecoderReports : public LibavErrors, public std::enable_shared_from_this<DecoderReports> {
 public:
  /// The time of a frame that is decoded but not shown, as of one before an edit list. It is not
  /// counted.
  static constexpr Nanoseconds kNotShown = -1;

  /// Listens to a decoder from now on. What the logs print does not change.
  void listen_to(GstElement* decoder);

  /// A frame is about to be decoded by this thread. Frames before the first keyframe, and those
  /// that are shown before it, need frames that are not decoded: they are not counted.
  void begin(std::optional<Nanoseconds> time, bool keyframe);
  /// Frames before this time are only decoded for others, after a seek.
  void set_first(Nanoseconds time);
  /// The data that follows is not that after the last frame.
  void flush();
  /// A report about the frame that was begun last.
  void add(const std::string& reason);
  /// A report about a frame by its number: frames count from 0 as they are begun.
  void add_of(std::int64_t number, const std::string& reason) override;
  /// A report about a frame that was decoded.
  void add(std::optional<Nanoseconds> time, const std::string& reason);

  /// Takes the damaged frames up to this time out, by time. The decoder may be ahead of what is
  /// read.
  std::vector<DamagedFrame> take_until(Nanoseconds time);

 private:
  // A frame that was begun.
  struct Begun {
    std::optional<Nanoseconds> time;
    bool counts;
  };

  bool counts(std::optional<Nanoseconds> time) const;
  void add_frame(const Begun& frame, const std::string& reason);

  mutable std::mutex mutex_;  // guards all below
  std::vector<DamagedFrame> frames_;
  std::deque<Begun> begun_;                         // the last ones
  std::deque<std::optional<Nanoseconds>> damaged_;  // the times of the last ones
  std::int64_t number_ = 0;                         // of the next frame
  std::optional<Nanoseconds> start_;                // the time of the first keyframe
  std::optional<Nanoseconds> first_;                // the first time that counts after a seek
  bool started_ = false;                            // at a keyframe
};

/// A time in such a clause: "12.345 s".
std::string seconds_text(Nanoseconds time);

/// A clause about damaged frames of a source; empty without one.
std::string damage_text(const std::vector<DamagedFrame>& frames, const std::string& title);

}  // namespace mtstereo::run

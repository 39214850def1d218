// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstaggregator.h>
#include <gst/video/video.h>

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

#include "matcher/base/stream_formats.hpp"
#include "matcher/base/stream_segment.hpp"
#include "shared/ownership.hpp"
#include "shared/times.hpp"

namespace mtstereo::plugin {

/// The last seeks that were sent upstream, numbered from 1.
class SeekHistory {
 public:
  void add(guint32 seqnum);
  /// The number of a seek; 0 if the sequence number is of none.
  guint64 number_of(guint32 seqnum) const;
  guint64 count() const { return count_; }

 private:
  std::array<guint32, 16> seqnums_{};
  guint64 count_ = 0;
};

/// The property `sync-mode`: the times by which frames are paired.
enum class SyncMode {
  kRunningTime,         ///< the running times of the time stamps
  kArrival,             ///< none: in the order of arrival
  kFirstPts,            ///< the running times since the first frame of each stream
  kReferenceTimestamp,  ///< the reference time stamps that a frame carries (NTP, PTP)
};

/// The duration of a frame by the framerate; std::nullopt if that is variable or not known.
std::optional<Nanoseconds> frame_duration(const GstVideoInfo& info);

/// A frame, or a gap, in the order in which its stream delivers them.
struct QueuedFrame {
  BufferPointer buffer{};
  std::shared_ptr<const StreamInfo> info{};        ///< of the caps; nullptr: none arrived
  std::shared_ptr<const StreamSegment> segment{};  ///< nullptr: none arrived

  bool is_gap() const { return GST_BUFFER_FLAG_IS_SET(buffer.get(), GST_BUFFER_FLAG_GAP); }
  /// The running time of the time stamp; std::nullopt without one. It is negative for a frame that
  /// begins before its segment, also if a decoder has cut it there.
  std::optional<Nanoseconds> running_time() const;
  /// The running time at the end of a gap. One without a duration is as long as a frame.
  std::optional<Nanoseconds> end_time() const;
};

/// The end of a gap: no frame of the stream is before it.
struct PassedTime {
  Nanoseconds end = 0;                             ///< [running time]
  std::shared_ptr<const StreamSegment> segment{};  ///< nullptr: none arrived
};

/// The frames of a sink pad that wait for their partners. The last one may still be in the queue of
/// the pad, which keeps upstream waiting; hold() makes room there for the next one. Callers of
/// several threads need a lock around it.
class FrameQueue {
 public:
  /// Most frames that are held: more than the look-ahead needs.
  static constexpr std::size_t kCapacity = 16;

  /// The pad, owned by the element.
  GstAggregatorPad* pad = nullptr;

  /// What new frames belong to.
  std::shared_ptr<const StreamInfo> info;
  std::shared_ptr<const StreamSegment> segment;

  /// The last gap.
  std::optional<PassedTime> passed;

  /// Adds the frame at the head of the pad if it is not in the queue yet.
  void look();
  /// Takes the frame out of the pad. False if the pad has none.
  bool hold();
  /// Removes a frame, from the pad too if it is there.
  QueuedFrame take(std::size_t index = 0);
  /// Removes all frames, from the pad too, and returns their number.
  guint64 drop_all();
  /// Forgets all frames. That of the pad remains there.
  void clear();
  /// Forgets the stream as well.
  void reset();

  /// True if the stream has ended.
  bool ended() const { return gst_aggregator_pad_is_eos(pad) != FALSE; }
  bool empty() const { return frames_.empty(); }
  std::size_t size() const { return frames_.size(); }
  const QueuedFrame& front() const { return frames_.front(); }
  const QueuedFrame& operator[](std::size_t index) const { return frames_[index]; }
  /// Number of frames that are no longer in the pad.
  std::size_t held() const { return frames_.size() - (in_pad_ ? 1 : 0); }

 private:
  std::deque<QueuedFrame> frames_;
  bool in_pad_ = false;  // the last frame is still at the head of the pad
};

/// True if a segment is from before a seek that the other stream has carried out. Without a flush,
/// each stream ends its old segment elsewhere.
bool is_outdated(const StreamSegment& segment, const StreamSegment& other);

}  // namespace mtstereo::plugin

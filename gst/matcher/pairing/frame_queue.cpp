// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/frame_queue.hpp"

#include <algorithm>
#include <utility>

#include "shared/running_time.hpp"

namespace mtstereo::plugin {
namespace {

/// What a decoder has cut from the beginning of a frame that begins before its segment: it sets the
/// time stamp to the start of the segment and shortens the duration [stream time]. At its true time
/// the frame cannot be mistaken for its successor, of which little or nothing is cut.
Nanoseconds cut_at_start(const QueuedFrame& frame) {
  const GstBuffer* buffer = frame.buffer.get();
  const guint64 start = frame.segment->segment.start;
  if (start == 0 || GST_BUFFER_PTS(buffer) != start || !GST_BUFFER_DURATION_IS_VALID(buffer)) {
    return 0;
  }
  const auto duration = frame.info ? frame_duration(frame.info->video) : std::nullopt;
  if (!duration) return 0;
  return std::max<Nanoseconds>(*duration - bounded(GST_BUFFER_DURATION(buffer)), 0);
}

}  // namespace

std::optional<Nanoseconds> frame_duration(const GstVideoInfo& info) {
  if (info.fps_n <= 0 || info.fps_d <= 0) return std::nullopt;
  return bounded(gst_util_uint64_scale_int(GST_SECOND, info.fps_d, info.fps_n));
}

std::optional<Nanoseconds> QueuedFrame::running_time() const {
  if (!segment) return std::nullopt;
  const auto time = to_running_time(segment->segment, GST_BUFFER_PTS(buffer.get()));
  if (!time) return std::nullopt;
  return bounded(*time - bounded(static_cast<double>(cut_at_start(*this)) / segment->segment.rate));
}

std::optional<Nanoseconds> QueuedFrame::end_time() const {
  const auto begin = running_time();
  // In reverse the running time of the time stamp, the earliest one, is the end.
  if (!begin || segment->segment.rate < 0) return begin;
  Nanoseconds duration = 0;
  if (GST_BUFFER_DURATION_IS_VALID(buffer.get())) {
    duration = bounded(GST_BUFFER_DURATION(buffer.get()));
  } else if (info) {
    duration = frame_duration(info->video).value_or(0);
  }
  return bounded(*begin + bounded(static_cast<double>(duration) / segment->segment.rate));
}

void FrameQueue::look() {
  BufferPointer buffer(gst_aggregator_pad_peek_buffer(pad));
  if (in_pad_) {
    if (buffer.get() == frames_.back().buffer.get()) return;
    // A flush has removed it.
    frames_.pop_back();
    in_pad_ = false;
  }
  if (!buffer) return;
  frames_.push_back({std::move(buffer), info, segment});
  in_pad_ = true;
}

bool FrameQueue::hold() {
  look();
  if (!in_pad_) return false;
  const BufferPointer buffer(gst_aggregator_pad_pop_buffer(pad));
  in_pad_ = false;
  return true;
}

QueuedFrame FrameQueue::take(std::size_t index) {
  if (in_pad_ && index + 1 == frames_.size()) {
    gst_aggregator_pad_drop_buffer(pad);
    in_pad_ = false;
  }
  QueuedFrame frame = std::move(frames_[index]);
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(index));
  return frame;
}

guint64 FrameQueue::drop_all() {
  guint64 dropped = 0;
  for (look(); !empty(); ++dropped) take();
  return dropped;
}

void FrameQueue::clear() {
  frames_.clear();
  in_pad_ = false;
  passed.reset();
}

void FrameQueue::reset() {
  clear();
  info.reset();
  segment.reset();
}

void SeekHistory::add(guint32 seqnum) {
  // A seek arrives once from each sink.
  if (number_of(seqnum) == 0) seqnums_[count_++ % seqnums_.size()] = seqnum;
}

guint64 SeekHistory::number_of(guint32 seqnum) const {
  for (guint64 back = 0; back < std::min<guint64>(count_, seqnums_.size()); ++back) {
    if (seqnums_[(count_ - 1 - back) % seqnums_.size()] == seqnum) return count_ - back;
  }
  return 0;
}

bool is_outdated(const StreamSegment& segment, const StreamSegment& other) {
  // Not every source names the seek in its segment.
  const guint64 last = segment.known_seek != 0 ? segment.known_seek : segment.seeks_before;
  return last < other.known_seek;
}

}  // namespace mtstereo::plugin

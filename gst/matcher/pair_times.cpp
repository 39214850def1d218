// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pair_times.hpp"

namespace mtstereo::plugin {
namespace {

/// The reference of the first reference time stamp of a frame.
GstCaps* reference_of(const QueuedFrame& frame) {
  const GstReferenceTimestampMeta* meta =
      gst_buffer_get_reference_timestamp_meta(frame.buffer.get(), nullptr);
  return meta != nullptr ? meta->reference : nullptr;
}

/// The latest reference time stamp of this clock. A frame can have several: where a picture is
/// lost, an RTP depayloader puts what is left of it, with its time, in front of the next one.
std::optional<Nanoseconds> reference_time(const QueuedFrame& frame, GstCaps* reference) {
  if (reference == nullptr) return std::nullopt;
  std::optional<Nanoseconds> latest;
  gpointer position = nullptr;
  while (const GstMeta* each = gst_buffer_iterate_meta_filtered(
             frame.buffer.get(), &position, GST_REFERENCE_TIMESTAMP_META_API_TYPE)) {
    const auto* meta = reinterpret_cast<const GstReferenceTimestampMeta*>(each);
    if (gst_caps_is_subset(meta->reference, reference) == FALSE) continue;
    const Nanoseconds time = bounded(meta->timestamp);
    if (!latest || time > *latest) latest = time;
  }
  return latest;
}

}  // namespace

PairTimes PairClock::times(const FrameQueue& left, const FrameQueue& right, SyncMode mode) {
  PairTimes result;
  if (mode == SyncMode::kArrival) return result;
  GstCaps* const reference = reference_of(left.front());
  const bool segments = left.front().segment && right.front().segment;
  const Nanoseconds correction =
      segments ? seek_correction(*left.front().segment, *right.front().segment) : 0;
  const auto time_of = [&](const QueuedFrame& frame,
                           std::size_t side) -> std::optional<Nanoseconds> {
    if (mode == SyncMode::kReferenceTimestamp) return reference_time(frame, reference);
    auto time = frame.running_time();
    if (!time) return time;
    if (mode == SyncMode::kRunningTime) return side == 0 ? *time : bounded(*time + correction);
    if (!first_[side]) first_[side] = time;
    return bounded(*time - *first_[side]);
  };
  for (const std::size_t side : {0u, 1u}) {
    const FrameQueue& queue = side == 0 ? left : right;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto time = queue[i].is_gap() ? std::nullopt : time_of(queue[i], side);
      if (!time || (i > 0 && queue[i].segment != queue.front().segment)) {
        result.complete[side] = true;
        break;
      }
      result.times[side].push_back(*time);
    }
  }
  return result;
}

}  // namespace mtstereo::plugin

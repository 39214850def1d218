// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pair_times.hpp"

#include "matcher/pairing/pair_axis.hpp"

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
  const PairAxis axis(left.front().segment, right.front().segment);
  const auto time_of = [&](const QueuedFrame& frame, Side side) -> std::optional<Nanoseconds> {
    if (mode == SyncMode::kReferenceTimestamp) {
      const auto time = reference_time(frame, reference);
      return time && axis.reverse() ? -*time : time;
    }
    const auto running_time = frame.running_time();
    if (!running_time) return std::nullopt;
    const Nanoseconds time = axis.time(side, *running_time);
    if (mode == SyncMode::kRunningTime) return time;
    auto& first = first_[static_cast<std::size_t>(side)];
    if (!first) first = time;
    return bounded(time - *first);
  };
  for (const Side side : kSides) {
    const FrameQueue& queue = side == Side::kLeft ? left : right;
    const auto index = static_cast<std::size_t>(side);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto time = queue[i].is_gap() ? std::nullopt : time_of(queue[i], side);
      if (!time || (i > 0 && queue[i].segment != queue.front().segment)) {
        result.complete[index] = true;
        break;
      }
      result.times[index].push_back(*time);
    }
  }
  return result;
}

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pair_axis.hpp"

#include <cmath>

#include "shared/running_time.hpp"

namespace mtstereo::plugin {
namespace {

/// The running time at which a segment has this stream time, without the offset of the pad.
std::optional<Nanoseconds> running_time_at(const StreamSegment& stream, guint64 stream_time) {
  guint64 position = 0;
  const int sign = gst_segment_position_from_stream_time_full(&stream.segment, GST_FORMAT_TIME,
                                                              stream_time, &position);
  if (sign <= 0) return std::nullopt;
  const auto time = to_running_time(stream.segment, position);
  if (!time) return std::nullopt;
  return bounded(*time - bounded(stream.pad_offset));
}

/// What must be added to the running times of the right stream so that frames of the same stream
/// time are a pair, if both segments follow the same seek; 0 for other segments.
Nanoseconds seek_correction(const StreamSegment& left, const StreamSegment& right) {
  const bool same_seek = (left.seqnum != GST_SEQNUM_INVALID && left.seqnum == right.seqnum) ||
                         (left.seek != 0 && left.seek == right.seek);
  if (!same_seek || left.segment.rate != right.segment.rate) return 0;
  const guint64 stream_time = left.segment.time;
  if (!GST_CLOCK_TIME_IS_VALID(stream_time)) return 0;
  const auto left_time = running_time_at(left, stream_time);
  const auto right_time = running_time_at(right, stream_time);
  return left_time && right_time ? bounded(*left_time - *right_time) : 0;
}

/// The change of the stream time per running time.
double speed_of(const StreamSegment& stream) {
  const double speed = stream.segment.rate * stream.segment.applied_rate;
  return std::isfinite(speed) && speed != 0 ? speed : 1;
}

}  // namespace

PairAxis::PairAxis(const std::shared_ptr<const StreamSegment>& left,
                   const std::shared_ptr<const StreamSegment>& right) {
  if (!left || !right) return;
  speed_ = std::abs(speed_of(*left));
  reverse_ = speed_of(*left) < 0;
  running_shift_[1] = seek_correction(*left, *right);
  for (const Side side : kSides) {
    // The offset of a pad is the skew of a camera, which playing does not speed up or reverse.
    const Nanoseconds offset = bounded((side == Side::kLeft ? *left : *right).pad_offset);
    const auto index = static_cast<std::size_t>(side);
    running_shift_[index] = bounded(running_shift_[index] - offset);
    shift_[index] = reverse_ ? -offset : offset;
  }
}

Nanoseconds PairAxis::time(Side side, Nanoseconds running_time) const {
  const auto index = static_cast<std::size_t>(side);
  const Nanoseconds time = bounded(running_time + running_shift_[index]);
  const Nanoseconds scaled = speed_ == 1 ? time : bounded(static_cast<double>(time) * speed_);
  return bounded(scaled + shift_[index]);
}

bool is_in_gap(const QueuedFrame& frame, Side side, const FrameQueue& others,
               Nanoseconds tolerance) {
  const auto& gap = others.passed;
  if (!gap || gap->segment != others.segment || !gap->segment || !frame.segment) return false;
  const auto time = frame.running_time();
  if (!time) return false;
  const bool left = side == Side::kLeft;
  const PairAxis axis(left ? frame.segment : gap->segment, left ? gap->segment : frame.segment);
  return axis.time(side, *time) + tolerance < axis.time(other_side(side), gap->end);
}

}  // namespace mtstereo::plugin

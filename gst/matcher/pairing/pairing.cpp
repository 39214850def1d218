// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pairing.hpp"

#include <algorithm>

#include "matcher/pairing/pair_axis.hpp"

namespace mtstereo::plugin {
namespace {

using Lock = std::lock_guard<std::mutex>;

/// True if a new frame of the pad belongs to this segment: no other one waits in the pad.
bool is_newest_segment(GstAggregatorPad* pad, const std::shared_ptr<const StreamSegment>& segment) {
  GstEvent* const event = gst_pad_get_sticky_event(GST_PAD_CAST(pad), GST_EVENT_SEGMENT, 0);
  if (event == nullptr) return false;
  const GstSegment* newest = nullptr;
  gst_event_parse_segment(event, &newest);
  const bool equal = segment && gst_segment_is_equal(newest, &segment->segment);
  gst_event_unref(event);
  return equal;
}

}  // namespace

void Pairing::set_mode(SyncMode mode) {
  const Lock lock(mutex_);
  rules_.mode = mode;
}

void Pairing::set_tolerance(Nanoseconds tolerance) {
  const Lock lock(mutex_);
  rules_.tolerance = tolerance;
}

void Pairing::set_duration(Side side, std::optional<Nanoseconds> duration) {
  const Lock lock(mutex_);
  rules_.durations.of(side) = duration;
}

Pairing::Wait Pairing::wait() const {
  const Lock lock(mutex_);
  const Nanoseconds frame = rules_.durations.shorter().value_or(0);
  // A partner may arrive as late as the tolerance allows, and cameras do not deliver frames at
  // exact times: waiting for a whole frame has no cost if the partner is there.
  const Nanoseconds wait =
      std::max(frame, effective_tolerance(rules_.tolerance, rules_.durations, FrameDurations{}));
  // The pad of a live stream holds two frames, which limits the wait.
  return {wait, std::max(wait, 2 * frame)};
}

void Pairing::note_seek(guint32 seqnum, bool flushing) {
  const Lock lock(mutex_);
  if (flushing) ++flushing_seeks_;
  seeks_.add(seqnum);
}

/// Drops frames that wait, and the new one, if they are in a gap of the other stream: none of them
/// has a partner, and they must not block their source, which may be that of the other stream too.
/// True if the new frame is to be dropped.
bool Pairing::drop_in_gap(Side side, GstBuffer* buffer) {
  if (rules_.mode != SyncMode::kRunningTime) return false;
  FrameQueue& own = queue(side);
  const FrameQueue& others = queue(other_side(side));
  if (!others.passed || !others.empty()) return false;
  const Nanoseconds tolerance = effective_tolerance(rules_.tolerance, rules_.durations, {});
  guint64& dropped = statistics_.dropped[index_of(side)];
  for (own.look(); !own.empty() && is_in_gap(own.front(), side, others, tolerance); ++dropped) {
    own.take();
  }
  const QueuedFrame frame{BufferPointer(gst_buffer_ref(buffer)), own.info, own.segment};
  const bool drop = own.empty() && is_newest_segment(own.pad, own.segment) &&
                    is_in_gap(frame, side, others, tolerance);
  if (drop) ++dropped;
  // A frame at the end of the gap may still have a partner. There is room for the next one.
  if (!drop && own.held() == 0) own.hold();
  return drop;
}

/// Makes room in the pad for a new frame. The oldest of too many frames is dropped: the other
/// stream does not deliver.
void Pairing::make_room(Side side) {
  FrameQueue& own = queue(side);
  if (!gst_aggregator_pad_has_buffer(own.pad) || !own.hold()) return;
  if (own.size() <= FrameQueue::kCapacity) return;
  own.take();
  ++statistics_.dropped[index_of(side)];
}

Arrival Pairing::arrive(Side side, GstBuffer* buffer, bool newest) {
  const Lock lock(mutex_);
  if (ended_) return Arrival::kRefused;
  if (drop_in_gap(side, buffer)) return Arrival::kDropped;
  if (newest) make_room(side);
  return Arrival::kTaken;
}

void Pairing::refuse(Side side) {
  const Lock lock(mutex_);
  ended_ = true;
  statistics_.dropped[index_of(side)] += queue(side).drop_all();
}

void Pairing::clear(Side side) {
  const Lock lock(mutex_);
  ended_ = false;
  queue(side).clear();
}

PairingStatistics Pairing::statistics() const {
  const Lock lock(mutex_);
  return statistics_;
}

bool Pairing::holds(Side side) const {
  const Lock lock(mutex_);
  return queues_[index_of(side)].held() > 0;
}

bool Pairing::begin(Side side, const std::shared_ptr<const StreamInfo>& info) {
  const Lock lock(mutex_);
  queue(side).info = info;
  return queue(side).empty();
}

bool Pairing::begin(Side side, const std::shared_ptr<const StreamSegment>& segment) {
  const Lock lock(mutex_);
  queue(side).segment = segment;
  return queue(side).empty();
}

std::shared_ptr<const StreamSegment> Pairing::describe(Side side, const GstSegment& segment,
                                                       guint32 seqnum) const {
  auto stream = std::make_shared<StreamSegment>();
  stream->segment = segment;
  stream->seqnum = seqnum;
  stream->pad_offset = gst_pad_get_offset(GST_PAD_CAST(pad(side)));
  const Lock lock(mutex_);
  stream->seek = flushing_seeks_;
  stream->known_seek = seeks_.number_of(seqnum);
  stream->seeks_before = seeks_.count();
  return stream;
}

void Pairing::set_latency(GstClockTime latency) {
  const Lock lock(mutex_);
  latency_ = GST_CLOCK_TIME_IS_VALID(latency) ? bounded(latency) : 0;
  rules_.live = latency_ > 0;
}

PairingAction Pairing::next(Trigger trigger) {
  const Lock lock(mutex_);
  PairingAction action = pairer_.next(rules_, trigger);
  if (action.kind == PairingAction::Kind::kDrop) {
    ++statistics_.dropped[index_of(action.side)];
    if (action.wrong_time) ++statistics_.wrong_times;
  }
  statistics_.difference = pairer_.finder().offset().line().statistics();
  return action;
}

std::optional<Nanoseconds> Pairing::deadline(Nanoseconds now) {
  const Lock lock(mutex_);
  std::optional<Nanoseconds> time;
  bool left = true;
  for (const Side side : kSides) {
    FrameQueue& frames = queue(side);
    frames.look();
    if (frames.empty()) continue;
    const auto begin = frames.front().running_time();
    if (!begin) return std::nullopt;
    if (time && *time <= *begin) continue;
    time = begin;
    left = side == Side::kLeft;
  }
  if (!time) return std::nullopt;
  return waiting_frame_.deadline(left, *time, now, latency_);
}

bool Pairing::has_news(Side side) const {
  return gst_aggregator_pad_has_buffer(pad(side)) || queues_[index_of(side)].ended();
}

void Pairing::start() {
  const Lock lock(mutex_);
  ended_ = false;
  pairer_.clear();
  waiting_frame_ = {};
  statistics_ = {};
  rules_.durations = {};
  latency_ = 0;
  rules_.live = false;
}

void Pairing::stop() {
  const Lock lock(mutex_);
  for (FrameQueue& queue : queues_) queue.reset();
}

}  // namespace mtstereo::plugin

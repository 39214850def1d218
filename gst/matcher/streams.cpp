// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/streams.hpp"

#include <utility>

#include "matcher/clock.hpp"
#include "matcher/negotiation.hpp"
#include "matcher/pairing/pair_axis.hpp"
#include "shared/exception_guard.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

void count_dropped(ElementState& state, Side side, guint64 frames) {
  const ObjectLock lock(state.element);
  state.statistics.dropped[static_cast<std::size_t>(side)] += frames;
}

/// Makes room in the pad for a new frame. The oldest of too many frames is dropped: the other
/// stream does not deliver.
void make_room(ElementState& state, Side side) {
  GstAggregatorPad* const pad = state.input(side).pad;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    FrameQueue& queue = state.queue(side);
    if (!gst_aggregator_pad_has_buffer(pad) || !queue.hold(pad)) return;
    if (queue.size() <= FrameQueue::kCapacity) return;
    queue.take(pad, 0);
  }
  count_dropped(state, side, 1);
}

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

/// Drops frames that wait, and the new one, if they are in a gap of the other stream: none of them
/// has a partner, and they must not block their source, which may be that of the other stream too.
/// True if the new frame is to be dropped.
bool drop_in_gap(ElementState& state, Side side, GstBuffer* buffer) {
  Nanoseconds tolerance = 0;
  {
    const ObjectLock lock(state.element);
    if (state.settings.sync_mode != SyncMode::kRunningTime) return false;
    tolerance = effective_tolerance(state.settings.sync_tolerance, state.caps_durations, {});
  }
  guint64 dropped = 0;
  bool drop = false;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    FrameQueue& own = state.queue(side);
    FrameQueue& others = state.queue(other_side(side));
    if (!others.passed || !others.empty()) return false;
    GstAggregatorPad* const pad = state.input(side).pad;
    own.look(pad);
    while (!own.empty() && is_in_gap(own.front(), side, others, tolerance)) {
      own.take(pad, 0);
      ++dropped;
    }
    const QueuedFrame frame{BufferPointer(gst_buffer_ref(buffer)), own.info, own.segment};
    drop = own.empty() && is_newest_segment(pad, own.segment) &&
           is_in_gap(frame, side, others, tolerance);
    // A frame at the end of the gap may still have a partner. There is room for the next one.
    if (!drop && own.held() == 0) own.hold(pad);
  }
  count_dropped(state, side, dropped + (drop ? 1 : 0));
  return drop;
}

GstPadProbeReturn on_frame(GstPad* pad, GstPadProbeInfo* info, gpointer data) noexcept {
  auto& state = *static_cast<ElementState*>(data);
  try {
    const Side side = state.side_of(GST_AGGREGATOR_PAD(pad));
    GstBuffer* const buffer = GST_PAD_PROBE_INFO_BUFFER(info);
    if (state.ended) {
      gst_buffer_unref(buffer);
      GST_PAD_PROBE_INFO_FLOW_RETURN(info) = has_failed(state) ? GST_FLOW_ERROR : GST_FLOW_EOS;
      return GST_PAD_PROBE_HANDLED;
    }
    if (buffer != nullptr && drop_in_gap(state, side, buffer)) return GST_PAD_PROBE_DROP;
    if (only_newest(state)) make_room(state, side);
  } catch (...) {
    post_exception(state.element);
  }
  return GST_PAD_PROBE_OK;
}

}  // namespace

bool only_newest(const ElementState& state) { return state.newest_pair && is_live(state); }

void take_stream_info(ElementState& state, Side side, StreamInfo info) {
  const auto shared = std::make_shared<const StreamInfo>(std::move(info));
  bool now = false;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    state.queue(side).info = shared;
    now = state.queue(side).empty();
  }
  state.input(side).has_caps = true;
  if (now || !state.adopted_infos[static_cast<std::size_t>(side)]) adopt_caps(state, side, shared);
}

void adopt_caps(ElementState& state, Side side, const std::shared_ptr<const StreamInfo>& info) {
  auto& adopted = state.adopted_infos[static_cast<std::size_t>(side)];
  if (!info || info == adopted) return;
  adopted = info;
  Input& input = state.input(side);
  input.info = info->video;
  input.geometry = info->geometry;
  state.geometry_compared = false;
  {
    const ObjectLock lock(state.element);
    (side == Side::kLeft ? state.caps_durations.left : state.caps_durations.right) =
        frame_duration(input.info);
  }
  if (side == Side::kLeft) gst_pad_mark_reconfigure(state.source_pad());
  update_pairing_latency(state);
}

void take_stream_segment(ElementState& state, Side side, const GstSegment& segment,
                         guint32 seqnum) {
  auto stream = std::make_shared<StreamSegment>();
  stream->segment = segment;
  stream->seqnum = seqnum;
  stream->seek = state.flushing_seeks;
  {
    const ObjectLock lock(state.element);
    stream->known_seek = state.seeks.number_of(seqnum);
    stream->seeks_before = state.seeks.count();
  }
  stream->pad_offset = gst_pad_get_offset(GST_PAD_CAST(state.input(side).pad));
  bool now = false;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    state.queue(side).segment = stream;
    now = state.queue(side).empty();
  }
  if (now && side == Side::kLeft) adopt_segment(state, stream);
}

void adopt_segment(ElementState& state, const std::shared_ptr<const StreamSegment>& segment) {
  if (!segment || segment == state.output_segment) return;
  state.output_segment = segment;
  gst_aggregator_update_segment(state.element, &segment->segment);
  state.segment = OutputSegment::kWaiting;
  state.segment_repeats = false;
  state.segment_seqnum = segment->seqnum;
  state.restart_matching();  // the output of a segment does not depend on earlier ones
  const ObjectLock lock(state.element);
  state.lateness.restart();
}

void clear_streams(ElementState& state) {
  for (const Side side : kSides) clear_stream(state, side);
  state.paired_segments = {};
  state.working_mode.reset();
  state.unreferenced_since.reset();
  state.restart_pairing();
  state.pending_flow = GST_FLOW_OK;
}

void clear_stream(ElementState& state, Side side) {
  state.ended = false;
  const std::lock_guard<std::mutex> lock(state.queue_mutex);
  state.queue(side).clear();
}

void refuse_frames(ElementState& state, Side side) {
  state.ended = true;
  guint64 dropped = 0;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    FrameQueue& queue = state.queue(side);
    queue.look(state.input(side).pad);
    for (; !queue.empty(); ++dropped) queue.take(state.input(side).pad, 0);
  }
  count_dropped(state, side, dropped);
}

void watch_pad(ElementState& state, Side side) {
  gst_pad_add_probe(GST_PAD_CAST(state.input(side).pad), GST_PAD_PROBE_TYPE_BUFFER, on_frame,
                    &state, nullptr);
}

}  // namespace mtstereo::plugin

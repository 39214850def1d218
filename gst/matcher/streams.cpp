// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/streams.hpp"

#include "matcher/negotiation.hpp"
#include "shared/exception_guard.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {
namespace {

/// Makes room in the pad for a new frame. The oldest of too many frames is dropped: the other
/// stream does not deliver.
void make_room(ElementState& state, Side side) {
  GstAggregatorPad* const pad = state.input(side).pad;
  bool dropped = false;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    FrameQueue& queue = state.queue(side);
    if (!gst_aggregator_pad_has_buffer(pad) || !queue.hold(pad)) return;
    if (queue.size() > FrameQueue::kCapacity) {
      queue.take(pad, 0);
      dropped = true;
    }
  }
  if (!dropped) return;
  const ObjectLock lock(state.element);
  ++state.statistics.dropped[static_cast<std::size_t>(side)];
}

/// True if a new frame is in a gap of the other stream, so that it has no partner. It must not
/// block its source, which may be that of the other stream too.
bool in_gap(ElementState& state, Side side, GstBuffer* buffer) {
  {
    const ObjectLock lock(state.element);
    if (state.settings.sync_mode != SyncMode::kRunningTime) return false;
  }
  const std::lock_guard<std::mutex> lock(state.queue_mutex);
  const FrameQueue& own = state.queue(side);
  const FrameQueue& others = state.queue(other_side(side));
  if (!others.passed || !others.empty() || !own.empty() || !own.segment || !others.segment) {
    return false;
  }
  const StreamSegment& left = side == Side::kLeft ? *own.segment : *others.segment;
  const StreamSegment& right = side == Side::kLeft ? *others.segment : *own.segment;
  if (seek_correction(left, right) != 0) return false;
  const QueuedFrame frame{BufferPointer(gst_buffer_ref(buffer)), own.info, own.segment};
  const auto end = frame.end_time();
  return end && others.has_passed(*end);
}

GstPadProbeReturn on_frame(GstPad* pad, GstPadProbeInfo* info, gpointer data) noexcept {
  auto& state = *static_cast<ElementState*>(data);
  try {
    const Side side = state.side_of(GST_AGGREGATOR_PAD(pad));
    GstBuffer* const buffer = GST_PAD_PROBE_INFO_BUFFER(info);
    if (buffer != nullptr && in_gap(state, side, buffer)) {
      const ObjectLock lock(state.element);
      ++state.statistics.dropped[static_cast<std::size_t>(side)];
      return GST_PAD_PROBE_DROP;
    }
    if (state.newest_pair && GST_CLOCK_TIME_IS_VALID(gst_aggregator_get_latency(state.element))) {
      make_room(state, side);
    }
  } catch (...) {
    post_exception(state.element);
  }
  return GST_PAD_PROBE_OK;
}

}  // namespace

void take_stream_info(ElementState& state, Side side, const GstVideoInfo& info) {
  const auto shared = std::make_shared<const GstVideoInfo>(info);
  bool now = false;
  {
    const std::lock_guard<std::mutex> lock(state.queue_mutex);
    state.queue(side).info = shared;
    now = state.queue(side).empty();
  }
  state.input(side).has_caps = true;
  if (now || !state.adopted_infos[static_cast<std::size_t>(side)]) adopt_caps(state, side, shared);
}

void adopt_caps(ElementState& state, Side side, const std::shared_ptr<const GstVideoInfo>& info) {
  auto& adopted = state.adopted_infos[static_cast<std::size_t>(side)];
  if (!info || info == adopted) return;
  adopted = info;
  Input& input = state.input(side);
  input.info = *info;
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
  state.segment_seqnum = segment->seqnum;
  state.alignment.restart();  // the output of a segment does not depend on earlier ones
  const ObjectLock lock(state.element);
  state.lateness.restart();
}

void clear_streams(ElementState& state) {
  for (const Side side : kSides) clear_stream(state, side);
  state.paired_segments = {};
  state.working_mode.reset();
  state.finder.reset();
  state.clock.reset();
  state.pending_flow = GST_FLOW_OK;
}

void clear_stream(ElementState& state, Side side) {
  const std::lock_guard<std::mutex> lock(state.queue_mutex);
  state.queue(side).clear();
}

void watch_pad(ElementState& state, Side side) {
  gst_pad_add_probe(GST_PAD_CAST(state.input(side).pad), GST_PAD_PROBE_TYPE_BUFFER, on_frame,
                    &state, nullptr);
}

}  // namespace mtstereo::plugin

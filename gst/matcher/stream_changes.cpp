// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/stream_changes.hpp"

#include <utility>

#define GST_CAT_DEFAULT mtstereo_debug

namespace mtstereo::plugin {

void take_stream_info(ElementState& state, Side side, StreamInfo info) {
  const auto shared = std::make_shared<const StreamInfo>(std::move(info));
  const bool now = state.pairing.begin(side, shared);
  state.formats.set_known(side, true);
  if (now || !state.formats.adopted(side)) adopt_caps(state, side, shared);
}

void adopt_caps(ElementState& state, Side side, const std::shared_ptr<const StreamInfo>& info) {
  if (!state.formats.adopt(side, info)) return;
  state.geometry_compared = false;
  state.engine.forget();
  state.pairing.set_duration(side, frame_duration(info->video));
  if (side == Side::kLeft) gst_pad_mark_reconfigure(state.output.pad());
  update_pairing_latency(state);
}

void take_stream_segment(ElementState& state, Side side, const GstSegment& segment,
                         guint32 seqnum) {
  const auto described = state.pairing.describe(side, segment, seqnum);
  const bool now = state.pairing.begin(side, described);
  if (now && side == Side::kLeft) adopt_segment(state, described);
}

void adopt_segment(ElementState& state, const std::shared_ptr<const StreamSegment>& segment) {
  // The output of a segment does not depend on earlier ones.
  if (state.output.adopt_segment(segment)) state.engine.restart();
}

void update_pairing_latency(ElementState& state) {
  const Pairing::Wait wait = state.pairing.wait();
  GST_DEBUG_OBJECT(state.element, "a frame of a live stream waits %.2f ms for a partner",
                   static_cast<double>(wait.wait) / 1e6);
  gst_aggregator_set_latency(state.element, static_cast<GstClockTime>(wait.wait),
                             static_cast<GstClockTime>(wait.room));
}

}  // namespace mtstereo::plugin

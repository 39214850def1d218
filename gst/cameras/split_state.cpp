// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/split_state.hpp"

#include <memory>
#include <string>

#include "cameras/split_frame.hpp"
#include "shared/caps.hpp"
#include "shared/frame_views.hpp"

namespace mtstereo::plugin {
namespace {

void clear_pool(SplitOutput& output) {
  output.decided = false;
  if (output.pool == nullptr) return;
  gst_buffer_pool_set_active(output.pool, FALSE);
  gst_object_unref(output.pool);
  output.pool = nullptr;
}

/// True if downstream reads the video meta: without it, rows of the whole frame's stride would be
/// taken for rows of a half.
bool reads_video_meta(GstPad* pad, GstCaps* caps) {
  const QueryPointer query(gst_query_new_allocation(caps, FALSE));
  return gst_pad_peer_query(pad, query.get()) &&
         gst_query_find_allocation_meta(query.get(), GST_VIDEO_META_API_TYPE, nullptr);
}

bool start_pool(SplitOutput& output, GstCaps* caps, const GstVideoInfo& info) {
  output.pool = gst_buffer_pool_new();
  GstStructure* config = gst_buffer_pool_get_config(output.pool);
  gst_buffer_pool_config_set_params(config, caps, static_cast<guint>(info.size), 0, 0);
  return gst_buffer_pool_set_config(output.pool, config) &&
         gst_buffer_pool_set_active(output.pool, TRUE);
}

bool decide_allocation(SplitState& state, SplitOutput& output) {
  const bool again = gst_pad_check_reconfigure(output.pad);
  if ((output.decided && !again) || !gst_pad_is_linked(output.pad)) return true;
  clear_pool(output);
  const CapsPointer caps(gst_pad_get_current_caps(output.pad));
  if (!caps) return true;
  output.copies = !reads_video_meta(output.pad, caps.get());
  output.decided = true;
  return !output.copies || start_pool(output, caps.get(), state.half);
}

/// The half as a frame without padding; NULL if there is no memory.
BufferPointer copied(SplitState& state, const SplitOutput& output, GstBuffer* half) {
  GstBuffer* acquired = nullptr;
  if (gst_buffer_pool_acquire_buffer(output.pool, &acquired, nullptr) != GST_FLOW_OK) return {};
  BufferPointer copy(acquired);
  const MappedFrame from(state.half, half, GST_MAP_READ);
  MappedFrame to(state.half, copy.get(), GST_MAP_WRITE);
  if (!from.mapped() || !to.mapped()) return {};
  return gst_video_frame_copy(to.frame(), from.frame()) ? std::move(copy) : BufferPointer();
}

GstFlowReturn push_half(SplitState& state, SplitOutput& output, GstBuffer* whole,
                        const std::shared_ptr<SharedFrame>& frame, HalfPosition position) {
  const bool allocated = decide_allocation(state, output);
  BufferPointer half;
  if (allocated) half = SharedFrame::part(frame, state.half, position);
  if (allocated && output.decided && output.copies) half = copied(state, output, half.get());
  if (!half) {
    GST_ELEMENT_ERROR(
        state.element, RESOURCE, NO_SPACE_LEFT,
        ("There is not enough memory for a view of %dx%d px.", state.half.width, state.half.height),
        ("pad %s", output.name));
    return GST_FLOW_ERROR;
  }
  copy_frame_details(whole, half.get());
  return gst_pad_push(output.pad, half.release());
}

}  // namespace

bool send_half_caps(SplitState& state, GstCaps* caps, guint32 seqnum) {
  const SplitSettings settings = state.current_settings();
  const SplitLayout layout = settings.layout;
  GstVideoInfo whole;
  const bool known = gst_video_info_from_caps(&whole, caps);
  const std::string problem = known ? split_problem(whole, layout) : "The caps are incomplete.";
  if (!problem.empty()) {
    GST_ELEMENT_ERROR(state.element, STREAM, FORMAT, ("%s", problem.c_str()),
                      ("layout=%s, sink received %s",
                       layout == SplitLayout::kSideBySide ? "side-by-side" : "top-bottom",
                       caps_text(caps).c_str()));
    state.caps.reset();
    return false;
  }
  if (const std::string text = layout_contradiction(whole, layout, settings.swap); !text.empty()) {
    GST_ELEMENT_WARNING(state.element, STREAM, FORMAT, ("%s", text.c_str()),
                        ("sink received %s", caps_text(caps).c_str()));
  }
  const CapsPointer half = half_caps(caps, layout);
  if (!gst_video_info_from_caps(&state.half, half.get())) return false;
  state.whole = whole;
  state.layout = layout;
  if (state.caps.get() != caps) state.caps.reset(gst_caps_ref(caps));
  bool sent = false;
  for (SplitOutput& output : state.outputs) {
    clear_pool(output);
    GstEvent* event = gst_event_new_caps(half.get());
    if (seqnum != GST_SEQNUM_INVALID) gst_event_set_seqnum(event, seqnum);
    sent = gst_pad_push_event(output.pad, event) || sent;
  }
  return sent;
}

GstFlowReturn split_buffer(SplitState& state, GstBuffer* buffer) {
  if (!state.caps) return GST_FLOW_NOT_NEGOTIATED;
  const SplitSettings settings = state.current_settings();
  if (settings.layout != state.layout &&
      !send_half_caps(state, state.caps.get(), GST_SEQNUM_INVALID)) {
    return GST_FLOW_NOT_NEGOTIATED;
  }
  const auto frame = std::make_shared<SharedFrame>(state.whole, buffer);
  if (!frame->problem().empty()) {
    GST_ELEMENT_ERROR(state.element, STREAM, FAILED,
                      ("A frame does not match its caps: %s.", frame->problem().c_str()),
                      ("the fault is in the element that allocated the frame"));
    return GST_FLOW_ERROR;
  }
  GstFlowReturn combined = GST_FLOW_OK;
  for (std::size_t i = 0; i < state.outputs.size(); ++i) {
    const bool first = (i == 0) != settings.swap;
    const HalfPosition position = first ? HalfPosition{} : second_half(state.whole, state.layout);
    SplitOutput& output = state.outputs[i];
    const GstFlowReturn flow = push_half(state, output, buffer, frame, position);
    combined = gst_flow_combiner_update_pad_flow(state.flows, output.pad, flow);
    // One view may have ended, or may not be linked: the other one continues.
    if (combined == GST_FLOW_FLUSHING || combined <= GST_FLOW_NOT_NEGOTIATED) break;
  }
  return combined;
}

void clear_split(SplitState& state) {
  for (SplitOutput& output : state.outputs) clear_pool(output);
  gst_flow_combiner_reset(state.flows);
  state.caps.reset();
  const std::lock_guard<std::mutex> lock(state.seek_mutex);
  state.last_seek = GST_SEQNUM_INVALID;
}

}  // namespace mtstereo::plugin

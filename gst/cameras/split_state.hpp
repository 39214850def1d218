// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/base/gstflowcombiner.h>
#include <gst/video/video.h>

#include <array>
#include <mutex>

#include "cameras/split_layout.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The values of the properties.
struct SplitSettings {
  SplitLayout layout = SplitLayout::kSideBySide;
  bool swap = false;  ///< the first half is the right view
};

/// A source pad and its stream.
struct SplitOutput {
  GstPad* pad = nullptr;          ///< owned by the element
  const char* name = nullptr;     ///< of the pad
  bool decided = false;           ///< `copies` is valid
  bool copies = false;            ///< downstream reads no video meta: frames are copied
  GstBufferPool* pool = nullptr;  ///< of the copies
};

/// All data of one mtsplit element. Created in its init, deleted in its finalize.
struct SplitState {
  explicit SplitState(GstElement* owner) : element(owner), flows(gst_flow_combiner_new()) {}
  ~SplitState() { gst_flow_combiner_free(flows); }
  SplitState(const SplitState&) = delete;
  SplitState& operator=(const SplitState&) = delete;

  GstElement* const element;
  GstPad* sink = nullptr;  ///< owned by the element

  // Guarded by the element's object lock.
  SplitSettings settings;

  // Used by the streaming thread, and by a state change while that thread does not run.
  std::array<SplitOutput, 2> outputs;             ///< left, right
  CapsPointer caps;                               ///< of the sink pad
  SplitLayout layout = SplitLayout::kSideBySide;  ///< of the caps that were sent
  GstVideoInfo whole{};
  GstVideoInfo half{};
  GstFlowCombiner* const flows;

  // Guarded by seek_mutex.
  std::mutex seek_mutex;
  guint32 last_seek = GST_SEQNUM_INVALID;
  bool last_seek_done = false;

  SplitSettings current_settings() const {
    const ObjectLock lock(element);
    return settings;
  }
};

/// New caps of the sink pad, or another layout: sends caps to both source pads. False if the frames
/// cannot be split; an error was posted then. `seqnum`: of the event.
bool send_half_caps(SplitState& state, GstCaps* caps, guint32 seqnum);

/// Splits a frame and pushes both halves.
GstFlowReturn split_buffer(SplitState& state, GstBuffer* buffer);

/// Forgets the stream.
void clear_split(SplitState& state);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <memory>
#include <string>

#include "cameras/split_layout.hpp"
#include "shared/frame_views.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// A frame whose parts are used as frames of their own. It stays mapped until the last of them is
/// freed; only then does it return to its pool.
class SharedFrame {
 public:
  /// Takes a reference to the frame. Check problem() afterwards.
  SharedFrame(const GstVideoInfo& info, GstBuffer* frame);

  /// Why the frame does not match its caps; "" if it does.
  const std::string& problem() const { return problem_; }

  /// The part with the size in `info` at a position, in the memory of this frame: a read-only frame
  /// with a video meta. No pixel is copied.
  static BufferPointer part(const std::shared_ptr<SharedFrame>& frame, const GstVideoInfo& info,
                            HalfPosition position);

 private:
  // In this order: the frame is unmapped before it is released.
  BufferPointer frame_;
  MappedFrame mapped_;
  std::string problem_;
};

/// Copies times, flags and the metas that describe a frame as a whole, not its pixels.
void copy_frame_details(GstBuffer* from, GstBuffer* to);

}  // namespace mtstereo::plugin

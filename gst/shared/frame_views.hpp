// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "mtstereo/image.hpp"

namespace mtstereo::plugin {

/// A video frame that is mapped as long as this object lives. It does not keep the buffer alive.
class MappedFrame {
 public:
  /// Maps `buffer`, or leaves an object that is not mapped().
  MappedFrame(const GstVideoInfo& info, GstBuffer* buffer, GstMapFlags flags);
  ~MappedFrame();
  MappedFrame(const MappedFrame&) = delete;
  MappedFrame& operator=(const MappedFrame&) = delete;

  /// True where the frame can be read (or written). Else problem() says why not.
  bool mapped() const { return mapped_; }
  const std::string& problem() const { return problem_; }

  /// The frame itself; only where mapped().
  GstVideoFrame* frame() { return &frame_; }

  /// The first plane of an 8-bit format; only where mapped().
  GrayView luma() const;
  /// The plane of a 16-bit gray format; only where mapped() for writing.
  ImageView<std::uint16_t> gray16() const;

 private:
  GstVideoFrame frame_{};
  bool mapped_ = false;
  std::string problem_;
};

/// The first byte of row y of a mapped frame's first plane; written only where it was mapped so.
inline std::uint8_t* plane_row(const GstVideoFrame& frame, int y) {
  return static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
         static_cast<std::ptrdiff_t>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
}

/// True where the first plane of the format is 8-bit luma, one byte after the other: what the
/// matcher reads in place.
bool has_luma_plane(GstVideoFormat format);

/// All formats of the installed GStreamer with such a plane, as text for caps: "{ GRAY8, ... }".
std::string luma_formats();

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "mtstereo/image.hpp"

namespace mtstereo::plugin {

/// A video frame that stays mapped for the lifetime of this object. It holds no reference to the
/// buffer.
class MappedFrame {
 public:
  /// Maps `buffer`. Check mapped() afterwards.
  MappedFrame(const GstVideoInfo& info, GstBuffer* buffer, GstMapFlags flags);
  ~MappedFrame();
  MappedFrame(const MappedFrame&) = delete;
  MappedFrame& operator=(const MappedFrame&) = delete;

  /// True if the frame is mapped and its rows lie inside the buffer; otherwise problem() is the
  /// reason.
  bool mapped() const { return mapped_; }
  const std::string& problem() const { return problem_; }

  /// The frame; only if mapped().
  GstVideoFrame* frame() { return &frame_; }
  const GstVideoFrame* frame() const { return &frame_; }

  /// The first plane of an 8-bit format; only if mapped().
  GrayView luma() const;
  /// The plane of a 16-bit gray format; only if mapped() for writing.
  ImageView<std::uint16_t> gray16() const;

 private:
  GstVideoFrame frame_{};
  bool mapped_ = false;
  std::string problem_;
};

/// The first plane of a mapped frame of an 8-bit format.
inline GrayView luma_of(const GstVideoFrame& frame) {
  return {static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)),
          GST_VIDEO_FRAME_WIDTH(&frame), GST_VIDEO_FRAME_HEIGHT(&frame),
          GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0)};
}

/// The first byte of row y of the first plane of a mapped frame. Write to it only if the frame is
/// mapped for writing.
inline std::uint8_t* plane_row(const GstVideoFrame& frame, int y) {
  return static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
         static_cast<std::ptrdiff_t>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
}

/// The 16-bit value at any address, even an odd one, with the least significant byte first.
inline std::uint16_t read16(const std::uint8_t* from) {
  return static_cast<std::uint16_t>(from[0] | from[1] << 8);
}

/// Writes such a value.
inline void write16(std::uint8_t* to, std::uint16_t value) {
  to[0] = static_cast<std::uint8_t>(value);
  to[1] = static_cast<std::uint8_t>(value >> 8);
}

/// True if the first plane of the format is 8-bit luma with one byte per pixel, which the matcher
/// reads in place.
bool has_luma_plane(GstVideoFormat format);

}  // namespace mtstereo::plugin

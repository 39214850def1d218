// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/video/video.h>

#include <optional>
#include <string>

#include "mtstereo/image.hpp"
#include "shared/frame_views.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// True if a LumaReader reads the format: all formats but tiled ones and those with a palette.
bool is_readable(GstVideoFormat format);

/// All formats of the installed GStreamer that a LumaReader reads, as text for caps: first GRAY8,
/// then the others that are read in place, then those that are converted: "{ GRAY8, ... }".
std::string luma_formats();

/// Reads the 8-bit luma of the frames of one stream. The luma of YUV is read as it is stored, by
/// its 8 most significant bits; the luma of RGB has the weights of BT.601, in full range.
/// Any stride and offset is accepted.
class LumaReader {
 public:
  LumaReader() = default;
  ~LumaReader() { clear(); }
  LumaReader(const LumaReader&) = delete;
  LumaReader& operator=(const LumaReader&) = delete;

  /// The luma of a mapped frame of a readable format: its first plane (has_luma_plane()), or a
  /// converted copy in a buffer that is used again for the next frame. Valid while the frame is
  /// mapped and until the next call.
  GrayView read(const GstVideoFrame& frame);
  GrayView read(const MappedFrame& frame) { return read(*frame.frame()); }
  /// Frees the buffer.
  void clear();

 private:
  /// A frame in memory of its own.
  struct OwnFrame {
    BufferPointer buffer;
    std::optional<MappedFrame> frame;

    void fit(const GstVideoInfo& info);
    void clear();
  };
  void fit(const GstVideoInfo& input);

  GstVideoInfo input_{};  // of the frames that the converter takes
  GstVideoConverter* converter_ = nullptr;
  OwnFrame aligned_;
  OwnFrame gray_;
};

}  // namespace mtstereo::plugin

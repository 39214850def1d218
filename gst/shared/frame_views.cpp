// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/frame_views.hpp"

#include <algorithm>

namespace mtstereo::plugin {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// gst_video_frame_map() trusts a meta that contradicts the caps, or reports it as a programming
/// error.
std::string meta_problem(GstBuffer* buffer, const GstVideoInfo& expected) {
  const GstVideoMeta* meta = gst_buffer_get_video_meta(buffer);
  if (meta == nullptr) return {};
  const int width = static_cast<int>(meta->width);
  const int height = static_cast<int>(meta->height);
  if (meta->format == GST_VIDEO_INFO_FORMAT(&expected) && width == expected.width &&
      height == expected.height) {
    return {};
  }
  return std::string("its video meta says ") + gst_video_format_to_string(meta->format) + " " +
         size_text(width, height) + ", the caps say " +
         gst_video_format_to_string(GST_VIDEO_INFO_FORMAT(&expected)) + " " +
         size_text(expected.width, expected.height);
}

/// Bytes of a row of a plane, without padding.
std::ptrdiff_t row_bytes(const GstVideoFrame& frame, guint plane) {
  const GstVideoFormatInfo* format = frame.info.finfo;
  if (GST_VIDEO_FORMAT_INFO_IS_COMPLEX(format)) {
    // Pixels share bytes; without a meta the stride is that of the format.
    GstVideoInfo plain;
    gst_video_info_set_format(&plain, GST_VIDEO_FORMAT_INFO_FORMAT(format),
                              static_cast<guint>(frame.info.width),
                              static_cast<guint>(frame.info.height));
    return plain.stride[plane];
  }
  std::ptrdiff_t bytes = 0;
  for (guint i = 0; i < GST_VIDEO_FORMAT_INFO_N_COMPONENTS(format); ++i) {
    if (GST_VIDEO_FORMAT_INFO_PLANE(format, i) != plane) continue;
    const std::ptrdiff_t pixels = GST_VIDEO_FRAME_COMP_WIDTH(&frame, i);
    bytes = std::max(bytes, pixels * GST_VIDEO_FORMAT_INFO_PSTRIDE(format, i));
  }
  return bytes;
}

int plane_height(const GstVideoFrame& frame, guint plane) {
  for (guint i = 0; i < GST_VIDEO_FRAME_N_COMPONENTS(&frame); ++i) {
    if (GST_VIDEO_FORMAT_INFO_PLANE(frame.info.finfo, i) == plane) {
      return GST_VIDEO_FRAME_COMP_HEIGHT(&frame, i);
    }
  }
  return 0;
}

/// The offset and the stride of a meta are unchecked so far: the rows may lie outside the memory.
std::string bounds_problem(const GstVideoFrame& frame, guint plane) {
  const std::ptrdiff_t stride = GST_VIDEO_FRAME_PLANE_STRIDE(&frame, plane);
  const std::ptrdiff_t row = row_bytes(frame, plane);
  if (stride < row) {
    return "its stride is " + std::to_string(stride) + " bytes, a row needs " +
           std::to_string(row) + " bytes";
  }
  // Without a meta all planes are in one mapped range.
  const GstMapInfo& map = frame.map[frame.meta != nullptr ? plane : 0];
  const auto* begin = static_cast<const guint8*>(map.data);
  const auto* data = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, plane));
  const std::ptrdiff_t needed = (data - begin) + stride * (plane_height(frame, plane) - 1) + row;
  if (needed > static_cast<std::ptrdiff_t>(map.size)) {
    return "its buffer has " + std::to_string(map.size) + " bytes, the frame needs " +
           std::to_string(needed) + " bytes";
  }
  return {};
}

/// The same for all planes that are read.
std::string bounds_problem(const GstVideoFrame& frame) {
  const bool luma_only = has_luma_plane(GST_VIDEO_FRAME_FORMAT(&frame));
  const guint planes = luma_only ? 1 : GST_VIDEO_FRAME_N_PLANES(&frame);
  std::string problem;
  for (guint plane = 0; plane < planes && problem.empty(); ++plane) {
    problem = bounds_problem(frame, plane);
  }
  return problem;
}

}  // namespace

MappedFrame::MappedFrame(const GstVideoInfo& info, GstBuffer* buffer, GstMapFlags flags) {
  problem_ = meta_problem(buffer, info);
  if (!problem_.empty()) return;
  // gst_video_frame_map() takes a non-const info but only copies it.
  GstVideoInfo copy = info;
  const auto no_reference =
      static_cast<GstMapFlags>(flags | static_cast<int>(GST_VIDEO_FRAME_MAP_FLAG_NO_REF));
  mapped_ = gst_video_frame_map(&frame_, &copy, buffer, no_reference);
  if (!mapped_) {
    problem_ = "its buffer of " + std::to_string(gst_buffer_get_size(buffer)) +
               " bytes cannot be mapped as " + size_text(info.width, info.height) +
               ", which needs " + std::to_string(info.size) + " bytes";
    return;
  }
  problem_ = bounds_problem(frame_);
  if (!problem_.empty()) {
    gst_video_frame_unmap(&frame_);
    mapped_ = false;
  }
}

MappedFrame::~MappedFrame() {
  if (mapped_) gst_video_frame_unmap(&frame_);
}

GrayView MappedFrame::luma() const { return luma_of(frame_); }

ImageView<std::uint16_t> MappedFrame::gray16() const {
  return {static_cast<std::uint16_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame_, 0)),
          GST_VIDEO_FRAME_WIDTH(&frame_), GST_VIDEO_FRAME_HEIGHT(&frame_),
          GST_VIDEO_FRAME_PLANE_STRIDE(&frame_, 0)};
}

bool has_luma_plane(GstVideoFormat format) {
  if (format == GST_VIDEO_FORMAT_UNKNOWN || format == GST_VIDEO_FORMAT_ENCODED) return false;
  const GstVideoFormatInfo* info = gst_video_format_get_info(format);
  if (!GST_VIDEO_FORMAT_INFO_IS_YUV(info) && !GST_VIDEO_FORMAT_INFO_IS_GRAY(info)) return false;
  if (GST_VIDEO_FORMAT_INFO_IS_TILED(info) || GST_VIDEO_FORMAT_INFO_IS_COMPLEX(info)) return false;
  return GST_VIDEO_FORMAT_INFO_DEPTH(info, 0) == 8 && GST_VIDEO_FORMAT_INFO_PLANE(info, 0) == 0 &&
         GST_VIDEO_FORMAT_INFO_PSTRIDE(info, 0) == 1 && GST_VIDEO_FORMAT_INFO_POFFSET(info, 0) == 0;
}

}  // namespace mtstereo::plugin

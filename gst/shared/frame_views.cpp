// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/frame_views.hpp"

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

/// The offset and the stride of a meta are unchecked so far: the rows may lie outside the memory.
std::string bounds_problem(const GstVideoFrame& frame) {
  const int width = GST_VIDEO_FRAME_WIDTH(&frame);
  const int height = GST_VIDEO_FRAME_HEIGHT(&frame);
  const std::ptrdiff_t stride = GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
  const std::ptrdiff_t row =
      static_cast<std::ptrdiff_t>(width) * GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, 0);
  if (stride < row) {
    return "its stride is " + std::to_string(stride) + " bytes, a row needs " +
           std::to_string(row) + " bytes";
  }
  const auto* begin = static_cast<const guint8*>(frame.map[0].data);
  const auto* plane = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
  const std::ptrdiff_t needed = (plane - begin) + stride * (height - 1) + row;
  if (needed > static_cast<std::ptrdiff_t>(frame.map[0].size)) {
    return "its buffer has " + std::to_string(frame.map[0].size) + " bytes, the frame needs " +
           std::to_string(needed) + " bytes";
  }
  return {};
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

GrayView MappedFrame::luma() const {
  return {static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame_, 0)),
          GST_VIDEO_FRAME_WIDTH(&frame_), GST_VIDEO_FRAME_HEIGHT(&frame_),
          GST_VIDEO_FRAME_PLANE_STRIDE(&frame_, 0)};
}

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

std::string luma_formats() {
  std::string list = "{ GRAY8";  // first: the preferred format
  guint count = 0;
  const GstVideoFormat* formats = gst_video_formats_raw(&count);
  for (guint i = 0; i < count; ++i) {
    if (formats[i] == GST_VIDEO_FORMAT_GRAY8 || !has_luma_plane(formats[i])) continue;
    list += ", ";
    list += gst_video_format_to_string(formats[i]);
  }
  return list + " }";
}

}  // namespace mtstereo::plugin

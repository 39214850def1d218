// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cameras/split_frame.hpp"

#include <algorithm>

namespace mtstereo::plugin {
namespace {

using Holder = std::shared_ptr<SharedFrame>;

/// A plane of a part: from its first byte to its last one.
struct Plane {
  guint8* data = nullptr;
  gsize size = 0;  ///< [bytes]
  int stride = 0;  ///< [bytes]
};

Plane plane_of(const GstVideoFrame& frame, guint plane, const GstVideoInfo& part,
               HalfPosition position) {
  const GstVideoFormatInfo* format = part.finfo;
  Plane result;
  result.stride = GST_VIDEO_FRAME_PLANE_STRIDE(&frame, plane);
  std::ptrdiff_t first = 0;
  std::ptrdiff_t row = 0;
  int rows = 0;
  for (guint i = 0; i < GST_VIDEO_FORMAT_INFO_N_COMPONENTS(format); ++i) {
    if (GST_VIDEO_FORMAT_INFO_PLANE(format, i) != plane) continue;
    const int step = GST_VIDEO_FORMAT_INFO_PSTRIDE(format, i);
    const int x = GST_VIDEO_FORMAT_INFO_SCALE_WIDTH(format, i, position.x);
    const int y = GST_VIDEO_FORMAT_INFO_SCALE_HEIGHT(format, i, position.y);
    first = static_cast<std::ptrdiff_t>(y) * result.stride + static_cast<std::ptrdiff_t>(x) * step;
    row = std::max(row, static_cast<std::ptrdiff_t>(step) * GST_VIDEO_INFO_COMP_WIDTH(&part, i));
    rows = std::max(rows, GST_VIDEO_INFO_COMP_HEIGHT(&part, i));
  }
  result.data = static_cast<guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, plane)) + first;
  result.size = static_cast<gsize>(static_cast<std::ptrdiff_t>(rows - 1) * result.stride + row);
  return result;
}

/// MappedFrame checks the planes that the matcher reads; parts have all.
std::string bounds_problem(const GstVideoFrame& frame) {
  for (guint i = 0; i < GST_VIDEO_FRAME_N_PLANES(&frame); ++i) {
    const Plane plane = plane_of(frame, i, frame.info, {});
    const GstMapInfo& map = frame.map[frame.meta != nullptr ? i : 0];
    const gsize end = static_cast<gsize>(plane.data - map.data) + plane.size;
    if (plane.stride > 0 && end <= map.size) continue;
    return "plane " + std::to_string(i) + " has " + std::to_string(map.size) +
           " bytes, the frame needs " + std::to_string(end) + " bytes";
  }
  return {};
}

void release(gpointer holder) noexcept { delete static_cast<Holder*>(holder); }

/// Memory of a frame that is kept as long as this memory. It is read-only: another part may have
/// bytes between its rows, and other elements may use the frame.
GstMemory* wrap(const Plane& plane, const Holder& holder) {
  return gst_memory_new_wrapped(GST_MEMORY_FLAG_READONLY, plane.data, plane.size, 0, plane.size,
                                new Holder(holder), release);
}

/// GStreamer calls it; it calls C functions only, so that it throws nothing.
gboolean copy_untagged(GstBuffer* from, GstMeta** meta, gpointer to) noexcept {
  const GstMetaInfo* info = (*meta)->info;
  const gchar* const* tags = gst_meta_api_type_get_tags(info->api);
  if (info->transform_func == nullptr || (tags != nullptr && tags[0] != nullptr)) return TRUE;
  GstMetaTransformCopy whole = {FALSE, 0, static_cast<gsize>(-1)};
  info->transform_func(static_cast<GstBuffer*>(to), *meta, from,
                       g_quark_from_static_string("gst-copy"), &whole);
  return TRUE;
}

}  // namespace

SharedFrame::SharedFrame(const GstVideoInfo& info, GstBuffer* frame)
    : frame_(gst_buffer_ref(frame)), mapped_(info, frame, GST_MAP_READ) {
  problem_ = mapped_.mapped() ? bounds_problem(*mapped_.frame()) : mapped_.problem();
}

BufferPointer SharedFrame::part(const std::shared_ptr<SharedFrame>& frame, const GstVideoInfo& info,
                                HalfPosition position) {
  BufferPointer result(gst_buffer_new());
  gsize offsets[GST_VIDEO_MAX_PLANES] = {};
  gint strides[GST_VIDEO_MAX_PLANES] = {};
  gsize size = 0;
  const guint planes = GST_VIDEO_INFO_N_PLANES(&info);
  for (guint i = 0; i < planes; ++i) {
    const Plane plane = plane_of(*frame->mapped_.frame(), i, info, position);
    offsets[i] = size;
    strides[i] = plane.stride;
    size += plane.size;
    gst_buffer_append_memory(result.get(), wrap(plane, frame));
  }
  gst_buffer_add_video_meta_full(result.get(), GST_VIDEO_FRAME_FLAG_NONE,
                                 GST_VIDEO_INFO_FORMAT(&info), static_cast<guint>(info.width),
                                 static_cast<guint>(info.height), planes, offsets, strides);
  return result;
}

void copy_frame_details(GstBuffer* from, GstBuffer* to) {
  gst_buffer_copy_into(
      to, from, static_cast<GstBufferCopyFlags>(GST_BUFFER_COPY_FLAGS | GST_BUFFER_COPY_TIMESTAMPS),
      0, static_cast<gsize>(-1));
  gst_buffer_foreach_meta(from, copy_untagged, to);
}

}  // namespace mtstereo::plugin

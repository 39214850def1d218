// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared/luma.hpp"

#include <new>
#include <stdexcept>

namespace mtstereo::plugin {
namespace {

/// No step changes the luma: no dithering, no use of chroma for YUV.
GstStructure* converter_options() {
  return gst_structure_new("options", GST_VIDEO_CONVERTER_OPT_DITHER_METHOD,
                           GST_TYPE_VIDEO_DITHER_METHOD, GST_VIDEO_DITHER_NONE,
                           GST_VIDEO_CONVERTER_OPT_CHROMA_MODE, GST_TYPE_VIDEO_CHROMA_MODE,
                           GST_VIDEO_CHROMA_MODE_NONE, nullptr);
}

/// A frame of the same size in another format, with the strides of GStreamer.
GstVideoInfo plain_info(const GstVideoInfo& input, GstVideoFormat format) {
  GstVideoInfo info;
  if (!gst_video_info_set_format(&info, format, static_cast<guint>(input.width),
                                 static_cast<guint>(input.height))) {
    throw std::bad_alloc();  // the size overflows
  }
  return info;
}

/// The converter loads whole pixels of up to 8 bytes: it must not get addresses that are not a
/// multiple of that. Only a video meta has such offsets and strides.
bool is_aligned(const GstVideoFrame& frame) {
  for (guint i = 0; i < GST_VIDEO_FRAME_N_COMPONENTS(&frame); ++i) {
    const guint plane = static_cast<guint>(GST_VIDEO_FRAME_COMP_PLANE(&frame, i));
    const guintptr unit = GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, i) >= 8 ? 8 : 4;
    const auto address = reinterpret_cast<guintptr>(GST_VIDEO_FRAME_PLANE_DATA(&frame, plane));
    const auto stride = static_cast<guintptr>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, plane));
    if (address % unit != 0 || stride % unit != 0) return false;
  }
  return true;
}

bool same_stream(const GstVideoInfo& first, const GstVideoInfo& second) {
  return first.finfo == second.finfo && first.width == second.width &&
         first.height == second.height &&
         gst_video_colorimetry_is_equal(&first.colorimetry, &second.colorimetry);
}

void append_format(std::string& list, GstVideoFormat format) {
  list += ", ";
  list += gst_video_format_to_string(format);
}

bool is_deep(const GstVideoFormatInfo& info) { return GST_VIDEO_FORMAT_INFO_DEPTH(&info, 0) > 8; }

}  // namespace

bool is_readable(GstVideoFormat format) {
  if (format == GST_VIDEO_FORMAT_UNKNOWN || format == GST_VIDEO_FORMAT_ENCODED) return false;
  const GstVideoFormatInfo* info = gst_video_format_get_info(format);
  if (GST_VIDEO_FORMAT_INFO_IS_TILED(info) || GST_VIDEO_FORMAT_INFO_HAS_PALETTE(info)) return false;
  return GST_VIDEO_FORMAT_INFO_IS_YUV(info) || GST_VIDEO_FORMAT_INFO_IS_GRAY(info) ||
         GST_VIDEO_FORMAT_INFO_IS_RGB(info);
}

std::string luma_formats() {
  std::string list = "{ GRAY8";
  guint count = 0;
  const GstVideoFormat* formats = gst_video_formats_raw(&count);  // the best quality first
  for (guint i = 0; i < count; ++i) {
    if (formats[i] == GST_VIDEO_FORMAT_GRAY8 || !has_luma_plane(formats[i])) continue;
    append_format(list, formats[i]);
  }
  // Of the others those are preferred that cost least: small ones, and YUV.
  for (const bool rgb : {false, true}) {
    for (const bool deep : {false, true}) {
      for (guint i = count; i-- > 0;) {
        if (!is_readable(formats[i]) || has_luma_plane(formats[i])) continue;
        const GstVideoFormatInfo* info = gst_video_format_get_info(formats[i]);
        if (GST_VIDEO_FORMAT_INFO_IS_RGB(info) == rgb && is_deep(*info) == deep) {
          append_format(list, formats[i]);
        }
      }
    }
  }
  return list + " }";
}

void LumaReader::OwnFrame::fit(const GstVideoInfo& info) {
  clear();
  buffer.reset(gst_buffer_new_allocate(nullptr, info.size, nullptr));
  if (!buffer) throw std::bad_alloc();
  frame.emplace(info, buffer.get(), static_cast<GstMapFlags>(GST_MAP_READWRITE));
  if (!frame->mapped()) throw std::runtime_error(frame->problem());
}

void LumaReader::OwnFrame::clear() {
  frame.reset();  // unmaps the buffer
  buffer.reset();
}

void LumaReader::fit(const GstVideoInfo& input) {
  if (converter_ != nullptr && same_stream(input, input_)) return;
  clear();
  GstVideoInfo from = plain_info(input, GST_VIDEO_INFO_FORMAT(&input));
  GstVideoInfo gray = plain_info(input, GST_VIDEO_FORMAT_GRAY8);
  // The range of YUV is not converted.
  from.colorimetry = input.colorimetry;
  if (!GST_VIDEO_INFO_IS_RGB(&input)) gray.colorimetry = input.colorimetry;
  gray_.fit(gray);
  converter_ = gst_video_converter_new(&from, &gray, converter_options());
  if (converter_ == nullptr) {
    throw std::runtime_error("frames of the format " + std::string(GST_VIDEO_INFO_NAME(&input)) +
                             " cannot be converted");
  }
  input_ = from;
}

GrayView LumaReader::read(const GstVideoFrame& frame) {
  const GstVideoInfo& info = frame.info;
  if (has_luma_plane(GST_VIDEO_INFO_FORMAT(&info))) return luma_of(frame);
  fit(info);
  const GstVideoFrame* source = &frame;
  if (!is_aligned(*source)) {
    if (!aligned_.frame) aligned_.fit(input_);
    gst_video_frame_copy(aligned_.frame->frame(), source);
    source = aligned_.frame->frame();
  }
  gst_video_converter_frame(converter_, source, gray_.frame->frame());
  return gray_.frame->luma();
}

void LumaReader::clear() {
  if (converter_ != nullptr) gst_video_converter_free(converter_);
  converter_ = nullptr;
  gray_.clear();
  aligned_.clear();
}

}  // namespace mtstereo::plugin

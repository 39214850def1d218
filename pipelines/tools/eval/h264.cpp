// SPDX-License-Identifier: LGPL-2.1-or-later

// H.264 by GStreamer's elements.

#include "tools/eval/h264.hpp"

#include <gst/app/gstappsink.h>
#include <gst/app/gstappsrc.h>
#include <gst/gst.h>
#include <gst/video/video.h>

#include <array>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::eval {
namespace {

constexpr int kFrames = 3;  // equal frames; the last one is the result
constexpr std::uint8_t kNoColor = 128;

struct Part {
  const char* element;
  const char* package;
};
constexpr std::array kParts{
    Part{"appsrc", "gstreamer1.0-plugins-base"}, Part{"x264enc", "gstreamer1.0-plugins-ugly"},
    Part{"h264parse", "gstreamer1.0-plugins-bad"}, Part{"avdec_h264", "gstreamer1.0-libav"}};

bool start_gstreamer(std::string& reason) {
  g_autoptr(GError) error = nullptr;
  if (gst_init_check(nullptr, nullptr, &error) != FALSE) return true;
  reason = error != nullptr ? error->message : "unknown error";
  return false;
}

GstVideoInfo info_of(cv::Size size) {
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_I420, static_cast<guint>(size.width),
                            static_cast<guint>(size.height));
  info.fps_n = 25;
  info.fps_d = 1;
  return info;
}

// A frame of the image without color. The encoder's luma is the gray value: no range is converted.
GstBuffer* frame_of(const cv::Mat& image, const GstVideoInfo& info, int index) {
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, info.size, nullptr);
  gst_buffer_memset(buffer, 0, kNoColor, info.size);
  for (int y = 0; y < image.rows; ++y) {
    gst_buffer_fill(buffer, info.offset[0] + static_cast<gsize>(y) * info.stride[0], image.ptr(y),
                    static_cast<gsize>(image.cols));
  }
  GST_BUFFER_DURATION(buffer) = GST_SECOND / 25;
  GST_BUFFER_PTS(buffer) = static_cast<guint64>(index) * GST_BUFFER_DURATION(buffer);
  return buffer;
}

cv::Mat luma_of(GstSample* sample) {
  GstVideoInfo info;
  GstVideoFrame frame;
  if (gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) == FALSE ||
      gst_video_frame_map(&frame, &info, gst_sample_get_buffer(sample), GST_MAP_READ) == FALSE) {
    return {};
  }
  const cv::Mat luma(GST_VIDEO_FRAME_HEIGHT(&frame), GST_VIDEO_FRAME_WIDTH(&frame), CV_8UC1,
                     GST_VIDEO_FRAME_PLANE_DATA(&frame, 0),
                     static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0)));
  cv::Mat result = luma.clone();
  gst_video_frame_unmap(&frame);
  return result;
}

std::string error_text(GstElement* pipeline) {
  g_autoptr(GstBus) bus = gst_element_get_bus(pipeline);
  g_autoptr(GstMessage) message = gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR);
  if (message == nullptr) return "no frame was decoded";
  g_autoptr(GError) error = nullptr;
  gst_message_parse_error(message, &error, nullptr);
  return error->message;
}

// Sends the frames of an even-sized image through the pipeline; empty if none comes out.
cv::Mat last_frame(GstElement* pipeline, const cv::Mat& image) {
  g_autoptr(GstElement) in = gst_bin_get_by_name(GST_BIN(pipeline), "in");
  g_autoptr(GstElement) out = gst_bin_get_by_name(GST_BIN(pipeline), "out");
  const GstVideoInfo info = info_of(image.size());
  g_autoptr(GstCaps) caps = gst_video_info_to_caps(&info);
  gst_app_src_set_caps(GST_APP_SRC(in), caps);
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
  for (int i = 0; i < kFrames; ++i) {
    gst_app_src_push_buffer(GST_APP_SRC(in), frame_of(image, info, i));
  }
  gst_app_src_end_of_stream(GST_APP_SRC(in));
  cv::Mat result;
  while (GstSample* sample = gst_app_sink_pull_sample(GST_APP_SINK(out))) {
    result = luma_of(sample);
    gst_sample_unref(sample);
  }
  return result;
}

}  // namespace

std::optional<std::string> h264_obstacle() {
  if (std::string reason; !start_gstreamer(reason)) {
    return "GStreamer cannot be initialized: " + reason;
  }
  for (const Part& part : kParts) {
    g_autoptr(GstElementFactory) factory = gst_element_factory_find(part.element);
    if (factory == nullptr) {
      return "GStreamer has no element " + std::string(part.element) +
             ": install the Debian package " + part.package;
    }
  }
  return std::nullopt;
}

cv::Mat through_h264(const cv::Mat& image, int quantizer) {
  if (const std::optional<std::string> obstacle = h264_obstacle()) {
    throw UserError("h264: " + *obstacle);
  }
  // The encoder takes even sizes.
  cv::Mat even;
  cv::copyMakeBorder(image, even, 0, image.rows % 2, 0, image.cols % 2, cv::BORDER_REPLICATE);
  const std::string description =
      "appsrc name=in format=time ! x264enc pass=quant quantizer=" + std::to_string(quantizer) +
      " threads=1 key-int-max=250 ! h264parse ! avdec_h264 max-threads=1 ! "
      "appsink name=out sync=false";
  g_autoptr(GError) error = nullptr;
  g_autoptr(GstElement) pipeline =
      gst_parse_launch_full(description.c_str(), nullptr, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (pipeline == nullptr) throw UserError(std::string("h264: ") + error->message);
  gst_object_ref_sink(pipeline);
  const cv::Mat decoded = last_frame(pipeline, even);
  const std::string reason = decoded.empty() ? error_text(pipeline) : "";
  gst_element_set_state(pipeline, GST_STATE_NULL);
  if (decoded.size() != even.size()) throw UserError("h264: the image is not coded: " + reason);
  return decoded(cv::Rect(cv::Point(), image.size())).clone();
}

}  // namespace mtstereo::eval

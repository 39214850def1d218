// SPDX-License-Identifier: LGPL-2.1-or-later
#include "element_matcher.hpp"

#include <gst/check/gstharness.h>
#include <gst/gst.h>
#include <gst/video/video.h>

#include <cstring>
#include <limits>
#include <memory>

namespace mtstereo::tests {
namespace {

struct Teardown {
  void operator()(GstHarness* harness) const { gst_harness_teardown(harness); }
};
using Harness = std::unique_ptr<GstHarness, Teardown>;

GstBuffer* buffer_of(const cv::Mat& image) {
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY8, image.cols, image.rows);
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, info.size, nullptr);
  GstVideoFrame frame;
  if (gst_video_frame_map(&frame, &info, buffer, GST_MAP_WRITE)) {
    auto* plane = static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
    for (int y = 0; y < image.rows; ++y) {
      std::memcpy(plane + y * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0), image.ptr(y), image.cols);
    }
    gst_video_frame_unmap(&frame);
  }
  GST_BUFFER_PTS(buffer) = 0;
  GST_BUFFER_DURATION(buffer) = GST_SECOND / 10;
  return buffer;
}

cv::Mat disparity_of(GstBuffer* buffer, GstCaps* caps) {
  GstVideoInfo info;
  int scale = 0;
  GstVideoFrame frame;
  if (!gst_video_info_from_caps(&info, caps) ||
      !gst_structure_get_int(gst_caps_get_structure(caps, 0), "disparity-scale", &scale) ||
      !gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
    return {};
  }
  cv::Mat disparity(GST_VIDEO_FRAME_HEIGHT(&frame), GST_VIDEO_FRAME_WIDTH(&frame), CV_32FC1);
  const auto* plane = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
  for (int y = 0; y < disparity.rows; ++y) {
    const std::uint8_t* row = plane + y * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    for (int x = 0; x < disparity.cols; ++x) {
      const unsigned value = GST_READ_UINT16_LE(row + 2 * x);
      disparity.at<float>(y, x) = value == 0
                                      ? std::numeric_limits<float>::quiet_NaN()
                                      : static_cast<float>(value) / static_cast<float>(scale);
    }
  }
  gst_video_frame_unmap(&frame);
  return disparity;
}

}  // namespace

cv::Mat match_with_element(const cv::Mat& left, const cv::Mat& right,
                           const std::string& properties) {
  g_autoptr(GError) error = nullptr;
  g_autofree gchar* description = g_strdup_printf("mtstereo %s", properties.c_str());
  g_autoptr(GstElement) element =
      gst_parse_launch_full(description, nullptr, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (element == nullptr) return {};
  gst_object_ref_sink(element);
  const Harness left_side(gst_harness_new_with_element(element, "sink_left", "src"));
  const Harness right_side(gst_harness_new_with_element(element, "sink_right", nullptr));
  g_autofree gchar* caps = g_strdup_printf(
      "video/x-raw,format=GRAY8,width=%d,height=%d,framerate=10/1", left.cols, left.rows);
  gst_harness_set_src_caps_str(left_side.get(), caps);
  gst_harness_set_src_caps_str(right_side.get(), caps);
  if (gst_harness_push(right_side.get(), buffer_of(right)) != GST_FLOW_OK) return {};
  if (gst_harness_push(left_side.get(), buffer_of(left)) != GST_FLOW_OK) return {};
  g_autoptr(GstBuffer) buffer = gst_harness_pull(left_side.get());
  if (buffer == nullptr) return {};
  g_autoptr(GstCaps) out = gst_pad_get_current_caps(left_side->sinkpad);
  return disparity_of(buffer, out);
}

}  // namespace mtstereo::tests

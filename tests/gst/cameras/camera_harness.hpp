// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gst/check/gstharness.h>
#include <gtest/gtest.h>

#include <string>

#include "mtstereo/geometry/calibration.hpp"
#include "support/stereo_harness.hpp"
#include "support/temporary_folder.hpp"

namespace mtstereo::test {

/// A temporary folder with calibration files.
class CalibrationFolder : public TemporaryFolder {
 public:
  /// Writes a file and returns its path.
  std::string write(const StereoCalibration& calibration, const std::string& name = "rig.yaml") {
    const std::string path = this->path(name);
    const Status status = write_calibration(calibration, path);
    EXPECT_TRUE(status.ok()) << status.error().message;
    return path;
  }
  std::string path(const std::string& name) const { return *this / name; }
};

/// An element with one sink pad and one source pad in a harness.
class CameraHarness {
 public:
  CameraHarness(const char* factory, const std::string& properties, const char* source = "src") {
    element_ = make_element(properties, factory);
    bus_ = gst_bus_new();
    gst_element_set_bus(element_, bus_);
    harness_ = gst_harness_new_with_element(element_, "sink", source);
  }
  ~CameraHarness() {
    gst_element_set_bus(element_, nullptr);
    gst_harness_teardown(harness_);
    gst_object_unref(element_);
    gst_object_unref(bus_);
  }
  CameraHarness(const CameraHarness&) = delete;
  CameraHarness& operator=(const CameraHarness&) = delete;

  GstElement* element() const { return element_; }
  GstHarness* harness() const { return harness_; }
  void caps(const std::string& text) { gst_harness_set_src_caps_str(harness_, text.c_str()); }
  GstFlowReturn push(GstBuffer* frame) { return gst_harness_push(harness_, frame); }
  /// The output for a frame; nullptr if it is refused.
  BufferPointer pass(GstBuffer* frame) {
    const GstFlowReturn flow = push(frame);
    EXPECT_EQ(flow, GST_FLOW_OK);
    return BufferPointer(flow == GST_FLOW_OK ? gst_harness_pull(harness_) : nullptr);
  }
  /// The first message of this type; "" if there is none.
  std::string report(GstMessageType type) {
    const MessagePointer message(gst_bus_pop_filtered(bus_, type));
    if (!message) return "";
    GError* error = nullptr;
    if (type == GST_MESSAGE_ERROR) {
      gst_message_parse_error(message.get(), &error, nullptr);
    } else {
      gst_message_parse_warning(message.get(), &error, nullptr);
    }
    std::string text = error->message;
    g_error_free(error);
    return text;
  }
  std::string error() { return report(GST_MESSAGE_ERROR); }
  /// The caps of a pad.
  CapsPointer caps_of(const char* name = "src") const {
    GstPad* pad = gst_element_get_static_pad(element_, name);
    CapsPointer caps(gst_pad_get_current_caps(pad));
    gst_object_unref(pad);
    return caps;
  }

 private:
  GstElement* element_ = nullptr;
  GstBus* bus_ = nullptr;
  GstHarness* harness_ = nullptr;
};

/// The first plane of a frame in these caps, row by row.
inline std::vector<std::uint8_t> pixels_of(GstBuffer* buffer, const GstCaps* caps) {
  std::vector<std::uint8_t> result;
  GstVideoInfo info;
  GstVideoFrame frame;
  if (buffer == nullptr || caps == nullptr || !gst_video_info_from_caps(&info, caps) ||
      !gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
    ADD_FAILURE() << "no frame";
    return result;
  }
  const int bytes = info.width * GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, 0);
  for (int y = 0; y < info.height; ++y) {
    const auto* row = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)) +
                      static_cast<gssize>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0);
    result.insert(result.end(), row, row + bytes);
  }
  gst_video_frame_unmap(&frame);
  return result;
}

}  // namespace mtstereo::test

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cameras/camera_harness.hpp"

namespace mtstereo::test {

/// An mtsplit with a harness at each source pad; the left one also pushes.
class Splitter {
 public:
  explicit Splitter(const std::string& properties = "", bool video_meta = true)
      : left_("mtsplit", properties, "left") {
    right_ = gst_harness_new_with_element(left_.element(), nullptr, "right");
    for (GstHarness* harness : {left_.harness(), right_}) {
      if (video_meta) {
        gst_harness_add_propose_allocation_meta(harness, GST_VIDEO_META_API_TYPE, nullptr);
      }
    }
  }
  ~Splitter() { gst_harness_teardown(right_); }
  Splitter(const Splitter&) = delete;
  Splitter& operator=(const Splitter&) = delete;

  CameraHarness& input() { return left_; }
  GstHarness* side(Side side) { return side == Side::kLeft ? left_.harness() : right_; }
  BufferPointer pull(Side which) { return BufferPointer(gst_harness_pull(side(which))); }
  CapsPointer caps(Side which) const {
    return left_.caps_of(which == Side::kLeft ? "left" : "right");
  }

 private:
  CameraHarness left_;
  GstHarness* right_ = nullptr;
};

}  // namespace mtstereo::test

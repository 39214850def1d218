// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "support/stereo_harness.hpp"

namespace mtstereo::test {

/// The value of a property as text; the nick of an enumeration.
std::string property_text(GstElement* element, const char* name);

/// Tests of an mtstereo without streams.
class ElementTest : public testing::Test {
 protected:
  void SetUp() override { element = make_element(""); }
  void TearDown() override { gst_object_unref(element); }
  GParamSpec* find(const char* name) const {
    return g_object_class_find_property(G_OBJECT_GET_CLASS(element), name);
  }
  void set(const char* name, const char* value) {
    gst_util_set_object_arg(G_OBJECT(element), name, value);
  }
  std::string text(const char* name) const { return property_text(element, name); }

  GstElement* element = nullptr;
};

/// Tests of an mtstereo with two streams of one pair.
class StreamsTest : public testing::Test {
 protected:
  static constexpr int kWidth = 64;
  static constexpr int kHeight = 48;

  void start(const std::string& properties = "max-disparity=16", bool live = false) {
    harness = std::make_unique<StereoHarness>(properties, live);
    harness->caps(raw_caps("GRAY8", pair.left.width, pair.left.height));
  }
  GstFlowReturn push(Side side, GstClockTime time) {
    const auto& image = side == Side::kLeft ? pair.left : pair.right;
    return harness->push(side, frame_buffer(image, time, kFrame));
  }
  GstFlowReturn left(GstClockTime time) { return push(Side::kLeft, time); }
  GstFlowReturn right(GstClockTime time) { return push(Side::kRight, time); }
  /// Matches another pair.
  BufferPointer next() {
    harness->push_pair(pair, count++ * kFrame);
    return harness->pull();
  }
  /// The next map has this time.
  void expect_map_at(GstClockTime time) {
    const BufferPointer map = harness->pull();
    ASSERT_TRUE(map);
    EXPECT_EQ(GST_BUFFER_PTS(map.get()), time);
  }
  /// Matches another pair, and compares the map with that of the library.
  void expect_next(const Parameters& parameters, int scale);
  void set(const char* name, const char* value) {
    gst_util_set_object_arg(G_OBJECT(harness->element()), name, value);
  }
  std::string get(const char* name) { return property_text(harness->element(), name); }

  Pair pair = noise_pair(kWidth, kHeight, 5, 3);
  std::unique_ptr<StereoHarness> harness;
  GstClockTime count = 0;
};

}  // namespace mtstereo::test

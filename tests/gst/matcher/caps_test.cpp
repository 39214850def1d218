// SPDX-License-Identifier: LGPL-2.1-or-later
// The limits and the features of the caps.
#include <gtest/gtest.h>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::caps_test {
namespace {

CapsPointer template_of(const char* factory, const char* pad) {
  GstElement* element = make_element("", factory);
  CapsPointer caps(gst_pad_template_get_caps(gst_element_get_pad_template(element, pad)));
  gst_object_unref(element);
  return caps;
}

bool accepts(const CapsPointer& caps, const std::string& text) {
  const CapsPointer wanted(gst_caps_from_string(text.c_str()));
  return gst_caps_can_intersect(caps.get(), wanted.get()) != FALSE;
}

struct TemplateCase {
  const char* factory;
  const char* pad;
  const char* format;
};

class Template : public testing::TestWithParam<TemplateCase> {};

// Feature: odd sizes
TEST_P(Template, HasTheSizeLimitsOfTheLibrary) {
  const auto [factory, pad, format] = GetParam();
  const CapsPointer caps = template_of(factory, pad);
  const int most = kLargestImageSide;
  EXPECT_TRUE(accepts(caps, raw_caps(format, most, most)));
  EXPECT_TRUE(accepts(caps, raw_caps(format, 1, 1)));
  EXPECT_FALSE(accepts(caps, raw_caps(format, most + 1, 1)));
  EXPECT_FALSE(accepts(caps, raw_caps(format, 1, most + 1)));
}

INSTANTIATE_TEST_SUITE_P(All, Template,
                         testing::Values(TemplateCase{"mtstereo", "sink_left", "GRAY8"},
                                         TemplateCase{"mtstereo", "sink_right", "YUY2"},
                                         TemplateCase{"mtstereo", "src", "GRAY16_LE"},
                                         TemplateCase{"mtcolor", "sink", "GRAY16_LE"},
                                         TemplateCase{"mtcolor", "src", "RGB"},
                                         TemplateCase{"mtconfidence", "sink", "GRAY16_LE"},
                                         TemplateCase{"mtconfidence", "src", "GRAY8"}));

const char* const kOverlay =
    "video/x-raw(memory:SystemMemory,meta:GstVideoOverlayComposition),format=GRAY8,width=64,"
    "height=48,framerate=30/1";

TEST(Features, OfMetasAreInTheTemplate) {
  for (const char* pad : {"sink_left", "sink_right"}) {
    EXPECT_TRUE(accepts(template_of("mtstereo", pad), kOverlay)) << pad;
    EXPECT_FALSE(accepts(template_of("mtstereo", pad),
                         "video/x-raw(memory:GLMemory),format=GRAY8,width=64,height=48"))
        << pad;
  }
}

TEST(Features, OfMetasAreAccepted) {
  for (const std::string caps :
       {kOverlay, "video/x-raw(meta:Unknown),format=GRAY8,width=64,height=48,framerate=30/1"}) {
    StereoHarness harness;
    harness.caps(caps, raw_caps("GRAY8", 64, 48));
    harness.push_pair(noise_pair(64, 48, 4, 1), 0);
    EXPECT_TRUE(harness.pull()) << caps << "\n" << harness.error(0).text;
  }
}

TEST(Features, OfTheViewsAreNotThoseOfTheMap) {
  StereoHarness harness;
  harness.caps(kOverlay);
  const Pair pair = noise_pair(64, 48, 4, 1);
  GstBuffer* left = frame_buffer(pair.left, 0, kFrame);
  GstVideoOverlayComposition* overlay = gst_video_overlay_composition_new(nullptr);
  gst_buffer_add_video_overlay_composition_meta(left, overlay);
  gst_video_overlay_composition_unref(overlay);
  harness.push(Side::kLeft, left);
  harness.push(Side::kRight, frame_buffer(pair.right, 0, kFrame));
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(gst_buffer_get_video_overlay_composition_meta(map.get()), nullptr);
  EXPECT_TRUE(gst_caps_features_is_equal(gst_caps_get_features(harness.output_caps().get(), 0),
                                         GST_CAPS_FEATURES_MEMORY_SYSTEM_MEMORY));
}

TEST(Features, OfOtherMemoryAreRefusedAlsoWithAMeta) {
  StereoHarness harness;
  harness.caps(
      "video/x-raw(memory:GLMemory,meta:GstVideoOverlayComposition),format=GRAY8,width=64,"
      "height=48",
      raw_caps("GRAY8", 64, 48));
  const Report error = harness.error();
  EXPECT_NE(error.text.find("GLMemory"), std::string::npos) << error.text;
  EXPECT_NE(error.text.find("gldownload"), std::string::npos) << error.text;
}

}  // namespace
}  // namespace mtstereo::test::caps_test

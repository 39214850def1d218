// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "support/map_harness.hpp"

namespace mtstereo::test::mtdepth_errors_test {
namespace {

constexpr const char* kRig = ",focal-length=(double)700,baseline=(double)0.5";
constexpr const char* kScale = ",disparity-scale=256,max-disparity=64";

const Map16 kMap = {3, 2, {0, 256, 512, 770, 1, 65535}};

TEST(DepthErrors, OfAStreamAreReportedOnce) {
  // The source tries to negotiate several times.
  Pipeline pipeline(
      "videotestsrc num-buffers=3 ! video/x-raw,format=GRAY16_LE,width=64,height=48 ! mtdepth "
      "name=d ! fakesink");
  EXPECT_EQ(errors_of("d", pipeline), 1);
  pipeline.set_state(GST_STATE_READY);
  EXPECT_EQ(errors_of("d", pipeline), 1) << "when it starts again";
}

TEST(DepthErrors, NameTheWaysToSupplyAGeometry) {
  MapHarness harness("mtdepth", "");
  const std::string error = harness.error_of(kMap, kScale);
  for (const char* word : {"mtrectify", "calibration=FILE", "focal-length=PX", "baseline=METERS",
                           "the focal length and the baseline"}) {
    EXPECT_NE(error.find(word), std::string::npos) << word << " in " << error;
  }
  MapHarness half("mtdepth", "focal-length=700");
  const std::string missing = half.error_of(kMap, kScale);
  EXPECT_NE(missing.find(": the baseline of the cameras is not known"), std::string::npos)
      << missing;
}

TEST(DepthErrors, NameACalibrationFileThatCannotBeRead) {
  MapHarness harness("mtdepth", "calibration=/no/such/file.yaml");
  const std::string error = harness.error_of(kMap, kScale);
  EXPECT_NE(error.find("/no/such/file.yaml"), std::string::npos) << error;
}

TEST(DepthErrors, NameAStreamOfDepths) {
  MapHarness harness("mtdepth", "");
  const std::string error = harness.error_of(kMap, std::string(",depth-unit=0.001") + kRig);
  EXPECT_NE(error.find("depths, not disparities"), std::string::npos) << error;
}

TEST(DepthErrors, NameInvalidCaps) {
  for (const char* caps :
       {",disparity-scale=0", ",disparity-scale=70000", ",disparity-scale=16,disparity-offset=3"}) {
    MapHarness harness("mtdepth", "");
    const std::string error = harness.error_of(kMap, std::string(caps) + kRig);
    EXPECT_NE(error.find("disparity-scale="), std::string::npos) << error;
  }
}

TEST(DepthErrors, NameARangeThatIsNoneAtTheStart) {
  GstElement* element = make_element("near=5 far=5", "mtdepth");
  const auto bus = gst_bus_new();
  gst_element_set_bus(element, bus);
  EXPECT_EQ(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  const std::string error = text_of(next_message(bus, GST_MESSAGE_ERROR));
  EXPECT_NE(error.find("near=5"), std::string::npos) << error;
  gst_element_set_state(element, GST_STATE_NULL);
  gst_element_set_bus(element, nullptr);
  gst_object_unref(element);
  gst_object_unref(bus);
}

TEST(DepthErrors, ARangeThatIsNoneIsRefusedWhilePlaying) {
  MapHarness harness("mtdepth", "near=1 far=20");
  harness.caps(kMap.width, kMap.height, std::string(kScale) + kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  g_object_set(harness.element(), "near", 30.0, nullptr);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  const std::string warning = text_of(next_message(harness.bus(), GST_MESSAGE_WARNING));
  EXPECT_NE(warning.find("near=30"), std::string::npos) << warning;
  double near = 0;
  g_object_get(harness.element(), "near", &near, nullptr);
  EXPECT_EQ(near, 1);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  EXPECT_FALSE(next_message(harness.bus(), GST_MESSAGE_WARNING)) << "once";
}

TEST(DepthErrors, NameFramesThatContradictTheirCaps) {
  MapHarness harness("mtdepth", "");
  const Map16 small = {4, 3, std::vector<std::uint16_t>(12, 256)};
  harness.caps(64, 48, std::string(kScale) + kRig);
  GstBuffer* buffer = map_buffer(small, 0, 4);
  GstPad* pad = gst_element_get_static_pad(harness.element(), "sink");
  EXPECT_EQ(gst_pad_chain(pad, buffer), GST_FLOW_ERROR);
  gst_object_unref(pad);
  const std::string error = text_of(next_message(harness.bus(), GST_MESSAGE_ERROR));
  EXPECT_NE(error.find("GRAY16_LE 4x3"), std::string::npos) << error;
}

}  // namespace
}  // namespace mtstereo::test::mtdepth_errors_test

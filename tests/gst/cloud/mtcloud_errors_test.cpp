// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "cloud/cloud_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtcloud_errors_test {
namespace {

/// The error of an mtcloud that does not start.
std::string error_at_start(const std::string& properties) {
  GstElement* element = make_element(properties, "mtcloud");
  GstBus* bus = gst_bus_new();
  gst_element_set_bus(element, bus);
  EXPECT_EQ(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  const std::string error = text_of(next_message(bus, GST_MESSAGE_ERROR));
  gst_element_set_state(element, GST_STATE_NULL);
  gst_element_set_bus(element, nullptr);
  gst_object_unref(element);
  gst_object_unref(bus);
  return error;
}

TEST(CloudErrors, NameALocationThatIsNotValid) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "location is not set"},
      {"location=/tmp/a%s.ply", "%05d"},
      {"location=/tmp/a%d-%d.ply", "%05d"},
      {"location=/tmp/a%999d.ply", "%05d"},
      {"location=/tmp/a%05.ply", "%05d"},
      {"location=/tmp/cloud%05d", "property format"},
      {"location=/tmp/cloud.xyz", "property format"},
      {"location=/no/such/folder/%d.ply", "/no/such/folder"},
      {"location=/tmp/a.ply near=3 far=2", "near=3"},
  };
  for (const auto& [properties, word] : cases) {
    const std::string error = error_at_start(properties);
    EXPECT_NE(error.find(word), std::string::npos) << properties << ": " << error;
  }
}

/// The error of the first map.
std::string error_of_map(CloudHarness& harness, GstBuffer* buffer) {
  EXPECT_EQ(harness.push_map(buffer), GST_FLOW_ERROR);
  return text_of(next_message(harness.bus(), GST_MESSAGE_ERROR));
}

TEST(CloudErrors, NameAFileThatCannotBeWritten) {
  CloudFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  CloudHarness harness(location(folder, "clouds/%d.ply"), false);
  ASSERT_EQ(harness.push_map(GstClockTime{0}), GST_FLOW_OK);
  std::filesystem::remove_all(folder / "clouds");
  const std::string error = error_of_map(harness, map_buffer(cloud_map(), kFrame));
  EXPECT_NE(error.find((folder / "clouds/1.ply").string()), std::string::npos) << error;
  EXPECT_NE(error.find("No such file or directory"), std::string::npos) << error;
}

TEST(CloudErrors, NameTheSizesOfALeftViewThatDoesNotFit) {
  const CloudFolder folder;
  CloudHarness harness(location(folder));
  gst_harness_set_src_caps_str(harness.left(), raw_caps("GRAY8", 32, 16).c_str());
  gst_harness_push(harness.left(),
                   frame_buffer({32, 16, std::vector<std::uint8_t>(512)}, 0, kFrame));
  const std::string error = error_of_map(harness, map_buffer(cloud_map()));
  EXPECT_NE(error.find("32x16"), std::string::npos) << error;
  EXPECT_NE(error.find("6x4"), std::string::npos) << error;
}

TEST(CloudErrors, NameAMissingConfidence) {
  const CloudFolder folder;
  CloudHarness harness(location(folder) + " min-confidence=1", false);
  const std::string error = error_of_map(harness, map_buffer(cloud_map()));
  EXPECT_NE(error.find("confidence-map=true"), std::string::npos) << error;
}

TEST(CloudErrors, NameAConfidenceThatDoesNotFit) {
  const CloudFolder folder;
  CloudHarness harness(location(folder), false);
  GstBuffer* buffer = map_buffer(cloud_map());
  attach_confidence(buffer, 3, 3, std::vector<std::uint8_t>(9));
  const std::string error = error_of_map(harness, buffer);
  EXPECT_NE(error.find("3x3"), std::string::npos) << error;
}

TEST(CloudErrors, NameTheWaysToSupplyAGeometry) {
  const CloudFolder folder;
  CloudHarness harness(location(folder), false);
  gst_harness_set_src_caps_str(harness.maps(),
                               raw_caps("GRAY16_LE", kCloudWidth, kCloudHeight).c_str());
  harness.push_map(GstClockTime{0});
  const std::string error = text_of(next_message(harness.bus(), GST_MESSAGE_ERROR));
  for (const char* word : {"mtrectify", "calibration=FILE", "focal-length=PX"}) {
    EXPECT_NE(error.find(word), std::string::npos) << error;
  }
}

TEST(CloudErrors, AMapThatWasScaledOrCroppedIsAWarning) {
  const std::string caps = raw_caps("GRAY16_LE", kCloudWidth, kCloudHeight) +
                           ",focal-length=10.0,baseline=0.5,valid-region=(int)<0,0,12,4>";
  for (const std::string properties : {"", " principal-x=2"}) {
    const CloudFolder folder;
    CloudHarness harness(location(folder) + properties, false);
    gst_harness_set_src_caps_str(harness.maps(), caps.c_str());
    harness.push_map(GstClockTime{0});
    const std::string warning = text_of(next_message(harness.bus(), GST_MESSAGE_WARNING));
    EXPECT_EQ(warning.find("scales or crops") != std::string::npos, properties.empty()) << warning;
  }
}

TEST(CloudErrors, OfAStreamAreReportedOnce) {
  // The source tries to negotiate several times.
  const CloudFolder folder;
  Pipeline pipeline(
      "videotestsrc num-buffers=3 ! video/x-raw,format=GRAY16_LE,width=64,height=48 ! mtcloud "
      "name=c " +
      location(folder));
  EXPECT_EQ(errors_of("c", pipeline), 1);
  pipeline.set_state(GST_STATE_READY);
  EXPECT_EQ(errors_of("c", pipeline), 1) << "when it starts again";
}

TEST(CloudErrors, NameAStreamOfDepths) {
  const CloudFolder folder;
  CloudHarness harness(location(folder), false);
  gst_harness_set_src_caps_str(
      harness.maps(),
      (raw_caps("GRAY16_LE", kCloudWidth, kCloudHeight) + ",depth-unit=0.001").c_str());
  harness.push_map(GstClockTime{0});
  const std::string error = text_of(next_message(harness.bus(), GST_MESSAGE_ERROR));
  EXPECT_NE(error.find("depths, not disparities"), std::string::npos) << error;
}

}  // namespace
}  // namespace mtstereo::test::mtcloud_errors_test

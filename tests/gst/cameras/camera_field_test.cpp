// SPDX-License-Identifier: LGPL-2.1-or-later
// mtrectify states of which camera a view is, and mtstereo refuses a view on the wrong pad.
#include <gtest/gtest.h>

#include "cameras/camera_harness.hpp"
#include "geometry/rigs.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::camera_field_test {
namespace {

constexpr int kWidth = 128;
constexpr int kHeight = 64;

std::string caps_of_camera(const std::string& camera) {
  return raw_caps("GRAY8", kWidth, kHeight) + (camera.empty() ? "" : ",camera=" + camera);
}

/// The cameras in the caps of both streams; "": not stated.
struct Cameras {
  const char* left;
  const char* right;
  const char* refused;  ///< pad; nullptr: none
};

TEST(CameraField, OfTheOtherPadIsAnError) {
  for (const Cameras& each :
       {Cameras{"left", "right", nullptr}, Cameras{"", "right", nullptr},
        Cameras{"left", "", nullptr}, Cameras{"", "", nullptr}, Cameras{"front", "", nullptr},
        Cameras{"left", "left", "sink_right"}, Cameras{"right", "right", "sink_left"},
        Cameras{"right", "left", "sink_left"}, Cameras{"right", "", "sink_left"}}) {
    StereoHarness harness;
    harness.caps(caps_of_camera(each.left), caps_of_camera(each.right));
    harness.push_pair(noise_pair(kWidth, kHeight, 6, 3), 0);
    if (each.refused == nullptr) {
      EXPECT_TRUE(harness.pull()) << each.left << " " << each.right;
      continue;
    }
    const Report error = harness.error();
    const std::string refused = each.refused;
    const std::string camera = refused == "sink_left" ? "right" : "left";
    EXPECT_NE(error.text.find("on " + refused + " is from the " + camera + " camera"),
              std::string::npos)
        << error.text;
    EXPECT_NE(error.text.find("mtrectify"), std::string::npos) << error.text;
    EXPECT_NE(error.details.find("camera=(string)" + camera), std::string::npos) << error.details;
    EXPECT_EQ(harness.further_errors(), 0);
  }
}

class RectifiedCameras : public testing::Test {
 protected:
  /// Two views through mtrectify; `after` is between it and the pad.
  std::string launch(const std::string& left, const std::string& right, const std::string& after) {
    const std::string rectify =
        " ! queue ! mtrectify calibration=" + folder_.write(plumb_bob_rig(kWidth, kHeight)) + " ";
    return "videotestsrc num-buffers=3 ! video/x-raw,format=GRAY8,width=256,height=64 ! mtsplit "
           "name=s s.left" +
           rectify + left + after + " ! m.sink_left s.right" + rectify + right + after +
           " ! m.sink_right mtstereo name=m max-disparity=16 ! appsink name=out sync=false "
           "wait-on-eos=false";
  }
  CalibrationFolder folder_;
};

// Feature: rectification
TEST_F(RectifiedCameras, BothLeftByDefaultAreAnError) {
  const std::string error = Pipeline(launch("", "", "")).run();
  EXPECT_NE(error.find("on sink_right is from the left camera"), std::string::npos) << error;
  EXPECT_NE(error.find("set camera=right"), std::string::npos) << error;
}

TEST_F(RectifiedCameras, ExchangedAreAnErrorBehindOtherElements) {
  for (const char* after : {"", " ! tee ! queue", " ! videoconvert", " ! videorate", " ! identity",
                            " ! videoscale ! videoconvert ! video/x-raw,format=I420"}) {
    const std::string error = Pipeline(launch("camera=right", "camera=left", after)).run();
    EXPECT_NE(error.find("camera, as its caps state"), std::string::npos) << after << ": " << error;
  }
}

TEST_F(RectifiedCameras, AreMatchedBehindOtherElements) {
  for (const char* after :
       {"", " ! tee ! queue", " ! videoconvert ! video/x-raw,format=I420", " ! videorate",
        " ! video/x-raw,format=GRAY8,width=128,height=64", " ! videoscale ! videoconvert"}) {
    Pipeline pipeline(launch("", "camera=right", after));
    EXPECT_EQ(pipeline.run(), "") << after;
    EXPECT_EQ(pipeline.samples().size(), 3u) << after;
  }
}

TEST_F(RectifiedCameras, AreNotStatedByTheMap) {
  Pipeline pipeline(launch("", "camera=right", ""));
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_FALSE(samples.empty());
  EXPECT_NE(samples[0].caps.find("focal-length"), std::string::npos);
  EXPECT_EQ(samples[0].caps.find("camera"), std::string::npos) << samples[0].caps;
}

}  // namespace
}  // namespace mtstereo::test::camera_field_test

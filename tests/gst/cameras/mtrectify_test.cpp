// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "cameras/camera_harness.hpp"
#include "geometry/rigs.hpp"
#include "mtstereo/geometry/rectification.hpp"
#include "shared/stereo_geometry.hpp"
#include "shared/valid_columns_meta.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtrectify_test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

GrayImage noise_image(int width = kWidth, int height = kHeight) {
  return noise_pair(width, height, 0, 7).left;
}

/// Stops an element and starts it with a new stream.
void play_again(CameraHarness& harness) {
  gst_element_set_state(harness.element(), GST_STATE_NULL);
  gst_element_set_state(harness.element(), GST_STATE_PLAYING);
  gst_harness_play(harness.harness());
  gst_harness_push_event(harness.harness(), gst_event_new_stream_start("again"));
  harness.caps(raw_caps("GRAY8", kWidth, kHeight));
  GstSegment segment;
  gst_segment_init(&segment, GST_FORMAT_TIME);
  gst_harness_push_event(harness.harness(), gst_event_new_segment(&segment));
}

class MtRectify : public testing::Test {
 protected:
  /// An mtrectify with the calibration of `rig`.
  CameraHarness& make(const std::string& properties, const StereoCalibration& calibration) {
    rig = calibration;
    const std::string file = folder.write(rig);
    harness =
        std::make_unique<CameraHarness>("mtrectify", "calibration=" + file + " " + properties);
    return *harness;
  }
  CameraHarness& make(const std::string& properties = "") {
    return make(properties, plumb_bob_rig(kWidth, kHeight));
  }
  plugin::StereoGeometry geometry() const {
    const CapsPointer caps = harness->caps_of();
    if (!caps) return {};
    return plugin::read_geometry(gst_caps_get_structure(caps.get(), 0))
        .value_or(plugin::StereoGeometry());
  }
  /// What the library makes of an image.
  std::vector<std::uint8_t> expected(const GrayImage& image, const RectificationOptions& options,
                                     Rectifier::Side side, int border = 0) const {
    const Rectification rectification = rectify(rig, options).value();
    Rectifier rectifier = std::move(Rectifier::create(rig, rectification, side).value());
    std::vector<std::uint8_t> out(
        static_cast<std::size_t>(rectification.width * rectification.height));
    EXPECT_TRUE(
        rectifier
            .apply({image.pixels.data(), image.width, image.height, image.width},
                   {out.data(), rectification.width, rectification.height, rectification.width}, 1,
                   static_cast<std::uint8_t>(border))
            .ok());
    return out;
  }
  std::vector<std::uint8_t> output(GstBuffer* frame) {
    const BufferPointer out = harness->pass(frame);
    return pixels_of(out.get(), harness->caps_of().get());
  }

  CalibrationFolder folder;
  StereoCalibration rig;
  std::unique_ptr<CameraHarness> harness;
};

// Feature: rectification
TEST_F(MtRectify, FramesAreThoseOfTheLibrary) {
  const GrayImage image = noise_image();
  for (const bool left : {true, false}) {
    const auto side = left ? Rectifier::Side::kLeft : Rectifier::Side::kRight;
    for (const char* format : {"GRAY8", "I420", "NV12", "Y42B"}) {
      for (const int padding : {0, 12}) {
        make(std::string("border=9 alpha=1 camera=") + (left ? "left" : "right"))
            .caps(raw_caps(format, kWidth, kHeight));
        const Layout layout{
            .format = format, .padding = padding, .offset = padding, .poison = 0xAB};
        EXPECT_EQ(output(frame_buffer(image, 0, kFrame, layout)),
                  expected(image, {.alpha = 1}, side, 9))
            << format << " " << padding;
      }
    }
  }
}

TEST_F(MtRectify, CapsStateTheGeometryOfTheView) {
  for (const bool zero_disparity : {true, false}) {
    for (const bool left : {true, false}) {
      make(std::string("alpha=0.5 camera=") + (left ? "left" : "right") +
           " zero-disparity=" + (zero_disparity ? "true" : "false"))
          .caps(raw_caps("GRAY8", kWidth, kHeight));
      ASSERT_TRUE(harness->pass(frame_buffer(noise_image(), 0, kFrame)));
      const Rectification r =
          rectify(rig, {.alpha = 0.5, .zero_disparity = zero_disparity}).value();
      const plugin::StereoGeometry found = geometry();
      EXPECT_NEAR(found.focal_length, r.focal_length, 1e-6);
      EXPECT_NEAR(found.baseline, r.baseline, 1e-9);
      EXPECT_NEAR(found.principal_offset, r.principal_offset(), 1e-6);
      EXPECT_NEAR(found.principal_x, r.left_center_x, 1e-6);
      EXPECT_NEAR(found.principal_y, r.center_y, 1e-6);
      const Rectifier rectifier = std::move(
          Rectifier::create(rig, r, left ? Rectifier::Side::kLeft : Rectifier::Side::kRight)
              .value());
      EXPECT_EQ(found.valid_region, rectifier.valid_rectangle());
    }
  }
}

TEST_F(MtRectify, SizeIsThatOfThePropertiesOrOfDownstream) {
  make("width=81 height=63").caps(raw_caps("GRAY8", kWidth, kHeight));
  const GrayImage image = noise_image();
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)),
            expected(image, {.width = 81, .height = 63}, Rectifier::Side::kLeft));
  make();
  gst_harness_set_sink_caps_str(harness->harness(), "video/x-raw,width=100,height=75");
  harness->caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)),
            expected(image, {.width = 100, .height = 75}, Rectifier::Side::kLeft));
}

TEST_F(MtRectify, CalibrationIsScaledToTheVideo) {
  make("", plumb_bob_rig(2 * kWidth, 2 * kHeight)).caps(raw_caps("GRAY8", kWidth, kHeight));
  const GrayImage image = noise_image();
  const auto out = output(frame_buffer(image, 0, kFrame));
  rig = scale_calibration(rig, kWidth, kHeight).value();
  EXPECT_EQ(out, expected(image, {}, Rectifier::Side::kLeft));
}

TEST_F(MtRectify, SizeOfTheCalibrationIsPreferred) {
  const std::string file = folder.write(plumb_bob_rig(200, 150));
  Pipeline pipeline("videotestsrc num-buffers=2 ! mtrectify calibration=" + file +
                    " ! appsink name=out wait-on-eos=false sync=false");
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_NE(samples[0].caps.find("width=(int)200, height=(int)150"), std::string::npos)
      << samples[0].caps;
}

TEST_F(MtRectify, RemarksOnTheCalibrationAreWarningsOfTheLeftElement) {
  StereoCalibration long_rig = plumb_bob_rig(kWidth, kHeight);
  long_rig.translation[0] = -3.3;
  std::ifstream in(folder.write(long_rig));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find("length_unit: m"), std::strlen("length_unit: m"), "no_unit: 1");
  std::ofstream(folder.path("rig.yml")) << text;
  for (const bool left : {true, false}) {
    CameraHarness element("mtrectify", "calibration=" + folder.path("rig.yml") +
                                           (left ? " camera=left" : " camera=right"));
    element.caps(raw_caps("GRAY8", kWidth, kHeight));
    ASSERT_TRUE(element.pass(frame_buffer(noise_image(), 0, kFrame)));
    const std::string warning = element.report(GST_MESSAGE_WARNING);
    EXPECT_EQ(warning.find("The baseline is 3.3") == 0, left) << warning;
    // Another value of another property is no reason to repeat it.
    g_object_set(element.element(), "alpha", 0.5, nullptr);
    ASSERT_TRUE(element.pass(frame_buffer(noise_image(), kFrame, kFrame)));
    EXPECT_EQ(element.report(GST_MESSAGE_WARNING), "");
    play_again(element);
    ASSERT_TRUE(element.pass(frame_buffer(noise_image(), 0, kFrame)));
    EXPECT_EQ(element.report(GST_MESSAGE_WARNING).empty(), !left) << "after a stop";
  }
}

TEST_F(MtRectify, AViewThatIsNearlyEmptyIsAWarning) {
  StereoCalibration shifted = plumb_bob_rig(kWidth, kHeight);
  shifted.rectification = rectify(shifted).value();
  shifted.rectification->right_center_x += 0.9 * kWidth;
  make("camera=left", shifted).caps(raw_caps("GRAY8", kWidth, kHeight));
  ASSERT_TRUE(harness->pass(frame_buffer(noise_image(), 0, kFrame)));
  EXPECT_EQ(harness->report(GST_MESSAGE_WARNING), "");
  make("camera=right", shifted).caps(raw_caps("GRAY8", kWidth, kHeight));
  ASSERT_TRUE(harness->pass(frame_buffer(noise_image(), 0, kFrame)));
  const std::string warning = harness->report(GST_MESSAGE_WARNING);
  EXPECT_NE(warning.find("right camera fills only 1"), std::string::npos) << warning;
  EXPECT_NE(warning.find("of 160 columns"), std::string::npos) << warning;
}

TEST_F(MtRectify, VideoOfAnotherShapeIsAnError) {
  make().caps(raw_caps("GRAY8", 100, 100));
  EXPECT_NE(harness->push(frame_buffer(noise_image(100, 100), 0, kFrame)), GST_FLOW_OK);
  const std::string text = harness->error();
  EXPECT_NE(text.find("100x100"), std::string::npos) << text;
  EXPECT_NE(text.find("160x120"), std::string::npos) << text;
}

TEST_F(MtRectify, FileThatCannotBeReadIsAnError) {
  harness = std::make_unique<CameraHarness>("mtrectify", "calibration=/nowhere/rig.yaml");
  harness->caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_NE(harness->push(frame_buffer(noise_image(), 0, kFrame)), GST_FLOW_OK);
  const std::string text = harness->error();
  EXPECT_NE(text.find("/nowhere/rig.yaml"), std::string::npos) << text;
}

TEST_F(MtRectify, StartWithoutACalibrationIsAnError) {
  GstElement* element = gst_element_factory_make("mtrectify", nullptr);
  gst_object_ref_sink(element);
  EXPECT_EQ(gst_element_set_state(element, GST_STATE_PAUSED), GST_STATE_CHANGE_FAILURE);
  gst_element_set_state(element, GST_STATE_NULL);
  gst_object_unref(element);
}

TEST_F(MtRectify, ChangedPropertiesApplyToTheNextFrame) {
  const GrayImage image = noise_image();
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)), expected(image, {}, Rectifier::Side::kLeft));
  const double before = geometry().focal_length;
  g_object_set(harness->element(), "alpha", 1.0, "border", 50, nullptr);
  EXPECT_EQ(output(frame_buffer(image, kFrame, kFrame)),
            expected(image, {.alpha = 1}, Rectifier::Side::kLeft, 50));
  EXPECT_LT(geometry().focal_length, before);
  gst_util_set_object_arg(G_OBJECT(harness->element()), "camera", "right");
  g_object_set(harness->element(), "border", 60, nullptr);
  EXPECT_EQ(output(frame_buffer(image, 2 * kFrame, kFrame)),
            expected(image, {.alpha = 1}, Rectifier::Side::kRight, 60));
  g_object_set(harness->element(), "border", 61, nullptr);
  EXPECT_EQ(output(frame_buffer(image, 3 * kFrame, kFrame)),
            expected(image, {.alpha = 1}, Rectifier::Side::kRight, 61));
  g_object_set(harness->element(), "width", 96, nullptr);
  EXPECT_EQ(output(frame_buffer(image, 4 * kFrame, kFrame)),
            expected(image, {.alpha = 1, .width = 96}, Rectifier::Side::kRight, 61));
}

TEST_F(MtRectify, TheOtherOfTwoEqualCamerasHasMapsOfItsOwn) {
  const GrayImage image = noise_image();
  StereoCalibration equal = plumb_bob_rig(kWidth, kHeight);
  equal.right = equal.left;
  make("", equal).caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)), expected(image, {}, Rectifier::Side::kLeft));
  gst_util_set_object_arg(G_OBJECT(harness->element()), "camera", "right");
  EXPECT_EQ(output(frame_buffer(image, 1, kFrame)), expected(image, {}, Rectifier::Side::kRight));
}

TEST_F(MtRectify, ChangedFileAppliesToTheNextFrame) {
  const GrayImage image = noise_image();
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)), expected(image, {}, Rectifier::Side::kLeft));
  rig = fisheye_rig(kWidth, kHeight);
  const std::string other = folder.write(rig, "other.yaml");
  g_object_set(harness->element(), "calibration", other.c_str(), nullptr);
  EXPECT_EQ(output(frame_buffer(image, 1, kFrame)), expected(image, {}, Rectifier::Side::kLeft));
  // The same name, with other content.
  rig = pinhole_rig(kWidth, kHeight);
  g_object_set(harness->element(), "calibration", folder.write(rig, "other.yaml").c_str(), nullptr);
  EXPECT_EQ(output(frame_buffer(image, 2, kFrame)), expected(image, {}, Rectifier::Side::kLeft));
}

TEST_F(MtRectify, ChangeThatIsNotValidIsRefused) {
  const GrayImage image = noise_image();
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  const auto before = output(frame_buffer(image, 0, kFrame));
  for (const auto& [property, value] : {std::pair("calibration", "/nowhere/rig.yaml"),
                                        std::pair("alpha", "-0.5"), std::pair("calibration", "")}) {
    gst_util_set_object_arg(G_OBJECT(harness->element()), property, value);
    EXPECT_EQ(output(frame_buffer(image, kFrame, kFrame)), before);
    EXPECT_NE(harness->report(GST_MESSAGE_WARNING), "") << property;
    double alpha = 1;
    gchar* calibration = nullptr;
    g_object_get(harness->element(), "alpha", &alpha, "calibration", &calibration, nullptr);
    EXPECT_EQ(alpha, 0);
    EXPECT_EQ(calibration, folder.path("rig.yaml"));
    g_free(calibration);
  }
  EXPECT_EQ(harness->error(), "");
}

TEST_F(MtRectify, NewSizeOfTheVideoMakesNewMaps) {
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  ASSERT_TRUE(harness->pass(frame_buffer(noise_image(), 0, kFrame)));
  harness->caps(raw_caps("GRAY8", 80, 60));
  const GrayImage image = noise_image(80, 60);
  const auto out = output(frame_buffer(image, kFrame, kFrame));
  rig = scale_calibration(rig, 80, 60).value();
  EXPECT_EQ(out, expected(image, {}, Rectifier::Side::kLeft));
}

TEST_F(MtRectify, ColorKeepsTheFormat) {
  for (const char* format : {"RGB", "BGR", "RGBx", "BGRA", "xRGB", "GRAY8"}) {
    make("color=true alpha=1").caps(raw_caps(format, kWidth, kHeight));
    GstVideoInfo info;
    gst_video_info_set_format(&info, gst_video_format_from_string(format), kWidth, kHeight);
    GstBuffer* frame = gst_buffer_new_allocate(nullptr, info.size, nullptr);
    const int channels = GST_VIDEO_INFO_COMP_PSTRIDE(&info, 0);
    // Each channel has an image of its own.
    std::vector<GrayImage> parts;
    for (unsigned c = 0; c < static_cast<unsigned>(channels); ++c) {
      parts.push_back(noise_pair(kWidth, kHeight, 0, 20 + c).left);
    }
    GstMapInfo map;
    gst_buffer_map(frame, &map, GST_MAP_WRITE);
    for (std::size_t i = 0; i < static_cast<std::size_t>(kWidth * kHeight); ++i) {
      const std::size_t at = i / kWidth * static_cast<std::size_t>(info.stride[0]) +
                             i % kWidth * static_cast<std::size_t>(channels);
      for (std::size_t c = 0; c < parts.size(); ++c) map.data[at + c] = parts[c].pixels[i];
    }
    gst_buffer_unmap(frame, &map);
    const auto out = output(frame);
    const CapsPointer caps = harness->caps_of();
    EXPECT_STREQ(gst_structure_get_string(gst_caps_get_structure(caps.get(), 0), "format"), format);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const auto part = expected(parts[c], {.alpha = 1}, Rectifier::Side::kLeft);
      for (std::size_t i = 0; i < part.size(); ++i) {
        ASSERT_EQ(out[i * parts.size() + c], part[i]) << format << " " << i;
      }
    }
  }
}

TEST_F(MtRectify, ColorOfVideoWithoutRgbIsRefused) {
  const GrayImage image = noise_image();
  const Layout layout{.format = "I420"};
  make().caps(raw_caps("I420", kWidth, kHeight));
  const auto before = output(frame_buffer(image, 0, kFrame, layout));
  g_object_set(harness->element(), "color", TRUE, nullptr);
  EXPECT_EQ(output(frame_buffer(image, kFrame, kFrame, layout)), before);
  const std::string text = harness->report(GST_MESSAGE_WARNING);
  EXPECT_NE(text.find("videoconvert"), std::string::npos) << text;
}

TEST_F(MtRectify, FramesCarryTheirValidColumns) {
  make("alpha=1").caps(raw_caps("GRAY8", kWidth, kHeight));
  const BufferPointer first = harness->pass(frame_buffer(noise_image(), 0, kFrame));
  const BufferPointer second = harness->pass(frame_buffer(noise_image(), kFrame, kFrame));
  GBytes* columns = plugin::valid_columns_of(first.get());
  ASSERT_NE(columns, nullptr);
  EXPECT_EQ(columns, plugin::valid_columns_of(second.get()));  // shared
  const Rectification r = rectify(rig, {.alpha = 1}).value();
  const Rectifier rectifier = std::move(Rectifier::create(rig, r, Rectifier::Side::kLeft).value());
  EXPECT_EQ(plugin::unpack_valid_columns(columns, kWidth, kHeight), rectifier.valid_columns());
}

TEST_F(MtRectify, FrameThatDoesNotMatchItsCapsIsAnError) {
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  EXPECT_EQ(harness->push(gst_buffer_new_allocate(nullptr, 100, nullptr)), GST_FLOW_ERROR);
  EXPECT_NE(harness->error().find("100 bytes"), std::string::npos);
}

TEST_F(MtRectify, PlaysAgainAfterAStop) {
  const GrayImage image = noise_image();
  make().caps(raw_caps("GRAY8", kWidth, kHeight));
  const auto before = output(frame_buffer(image, 0, kFrame));
  play_again(*harness);
  EXPECT_EQ(output(frame_buffer(image, 0, kFrame)), before);
}

}  // namespace
}  // namespace mtstereo::test::mtrectify_test

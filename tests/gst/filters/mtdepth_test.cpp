// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>

#include "support/map_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtdepth_test {
namespace {

constexpr const char* kRig = ",focal-length=(double)700,baseline=(double)0.5";
constexpr double kConstant = 700 * 0.5;  // focal length x baseline [px m]
constexpr const char* kScale = ",disparity-scale=256,max-disparity=64";
constexpr int kWidth = 5;
constexpr int kHeight = 3;

const Map16 kMap = {
    kWidth,
    kHeight,
    {0, 256, 512, 1, 65535, 770, 0, 5120, 10240, 12800, 25600, 51200, 776, 1777, 2000}};

/// The depth of a value in mm; 0 if it does not fit.
int depth_mm(int value, double constant = kConstant, double scale = 256, double offset = 0) {
  if (value == 0) return 0;
  const double depth = std::floor(constant / (value / scale + offset) * 1000 + 0.5);
  return depth >= 1 && depth <= 65535 ? static_cast<int>(depth) : 0;
}

/// The depths of a map by a function of the value.
template <typename Function>
std::vector<std::uint16_t> expected(const Map16& map, Function&& depth) {
  std::vector<std::uint16_t> values;
  for (const std::uint16_t value : map.values) {
    values.push_back(static_cast<std::uint16_t>(depth(value)));
  }
  return values;
}

const auto kInMillimeters = [](int value) { return depth_mm(value); };

/// The depths that an mtdepth outputs for kMap.
std::vector<std::uint16_t> depths_of(const std::string& properties, const std::string& caps) {
  MapHarness harness("mtdepth", properties);
  harness.caps(kWidth, kHeight, caps);
  const BufferPointer out = harness.pass(map_buffer(kMap));
  return out ? map_of(out.get(), kWidth, kHeight) : std::vector<std::uint16_t>();
}

void expect_map(const std::vector<std::uint16_t>& depths, const std::vector<std::uint16_t>& actual,
                int width = kWidth) {
  EXPECT_EQ(first_difference(depths, actual, width), "");
}

// Feature: depth in mm
TEST(Depth, IsFocalLengthTimesBaselineOverDisparityForAllValues) {
  Map16 all = {256, 256, std::vector<std::uint16_t>(65536)};
  std::iota(all.values.begin(), all.values.end(), std::uint16_t{0});
  MapHarness harness("mtdepth", "");
  harness.caps(256, 256, std::string(kScale) + kRig);
  const BufferPointer out = harness.pass(map_buffer(all));
  ASSERT_TRUE(out);
  expect_map(expected(all, kInMillimeters), map_of(out.get(), 256, 256), 256);
}

TEST(Depth, CapsHaveTheUnitAndTheGeometryInPlaceOfTheDisparity) {
  MapHarness harness("mtdepth", "");
  harness.caps(kWidth, kHeight,
               std::string(",disparity-scale=256,max-disparity=64,min-disparity=-8,"
                           "disparity-offset=-8,valid-region=(int)<0,0,4,3>") +
                   kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  const std::string caps = harness.output_caps();
  for (const char* field :
       {"format=(string)GRAY16_LE", "depth-unit=(double)0.001", "focal-length=(double)700",
        "baseline=(double)0.5", "principal-offset=(double)0", "principal-x=(double)2,",
        "principal-y=(double)1,", "valid-region", "framerate"}) {
    EXPECT_NE(caps.find(field), std::string::npos) << field << " in " << caps;
  }
  EXPECT_EQ(caps.find("disparity"), std::string::npos) << caps;
}

// Feature: calibration in caps, properties and files
TEST(Depth, PropertiesOverrideTheCaps) {
  expect_map(expected(kMap, [](int value) { return depth_mm(value, 350 * 0.25); }),
             depths_of("focal-length=350 baseline=0.25", std::string(kScale) + kRig));
  expect_map(expected(kMap, [](int value) { return depth_mm(value, 350 * 0.25); }),
             depths_of("focal-length=350 baseline=0.25", kScale));
  MapHarness harness("mtdepth", "baseline=0.25 principal-x=1.5");
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  const std::string caps = harness.output_caps();
  EXPECT_NE(caps.find("baseline=(double)0.25"), std::string::npos) << caps;
  EXPECT_NE(caps.find("principal-x=(double)1.5"), std::string::npos) << caps;
}

TEST(Depth, AddsTheOffsets) {
  const auto depth = [](int value) {
    return value / 256.0 - 2 + 0.5 <= 0 ? 0 : depth_mm(value, kConstant, 256, -2 + 0.5);
  };
  expect_map(
      expected(kMap, depth),
      depths_of("", std::string(kScale) + ",disparity-offset=-2,principal-offset=0.5" + kRig));
  expect_map(expected(kMap, depth),
             depths_of("principal-offset=0.5",
                       std::string(kScale) + ",disparity-offset=-2,principal-offset=3.0" + kRig));
}

TEST(Depth, TakesTheScaleOfTheCapsOrOfTheMetaOrOfTheProperty) {
  const auto scale16 = [](int value) { return depth_mm(value, kConstant, 16); };
  expect_map(expected(kMap, scale16),
             depths_of("disparity-scale=64", std::string(",disparity-scale=16") + kRig));
  expect_map(expected(kMap, scale16), depths_of("disparity-scale=16", kRig));
  MapHarness harness("mtdepth", "disparity-scale=64");
  harness.caps(kWidth, kHeight, kRig);
  GstBuffer* buffer = map_buffer(kMap);
  GstCustomMeta* meta = gst_buffer_add_custom_meta(buffer, "MtStereoDisparityMeta");
  gst_structure_set(gst_custom_meta_get_structure(meta), "disparity-scale", G_TYPE_INT, 16,
                    "max-disparity", G_TYPE_INT, 64, nullptr);
  const BufferPointer out = harness.pass(buffer);
  ASSERT_TRUE(out);
  expect_map(expected(kMap, scale16), map_of(out.get(), kWidth, kHeight));
  EXPECT_EQ(gst_buffer_get_custom_meta(out.get(), "MtStereoDisparityMeta"), nullptr)
      << "the values are no disparities";
}

TEST(Depth, UnitIsThatOfTheProperty) {
  const auto centimeters = [](int value) {
    const double depth = value == 0 ? 0 : kConstant * 256 / value * 100;
    return depth > 65535 ? 0 : static_cast<int>(std::floor(depth + 0.5));
  };
  expect_map(expected(kMap, centimeters), depths_of("unit=10", std::string(kScale) + kRig));
}

TEST(Depth, WhatDoesNotFitIsClampedOrNone) {
  const std::string caps = std::string(kScale) + kRig;
  const auto clamped = [](int value) {
    return value > 0 && kConstant * 256 / value > 65.535 ? 65535 : depth_mm(value);
  };
  expect_map(expected(kMap, kInMillimeters), depths_of("", caps));
  expect_map(expected(kMap, clamped), depths_of("overflow=clamp", caps));
}

TEST(Depth, LeavesOutWhatIsNotInTheRange) {
  const auto in_range = [](int value) {
    const double depth = value == 0 ? 0 : kConstant * 256 / value;
    return depth >= 5 && depth <= 20 ? depth_mm(value) : 0;
  };
  expect_map(expected(kMap, in_range),
             depths_of("near=5 far=20 overflow=clamp", std::string(kScale) + kRig));
}

TEST(Depth, PaddingAndOddAddressesMakeNoDifference) {
  for (const auto& [padding, offset] : {std::pair{4, 0}, {0, 8}, {12, 2}, {3, 0}, {0, 1}, {5, 3}}) {
    MapHarness harness("mtdepth", "");
    harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
    const BufferPointer out = harness.pass(map_buffer(kMap, 0, padding, offset));
    ASSERT_TRUE(out);
    expect_map(expected(kMap, kInMillimeters), map_of(out.get(), kWidth, kHeight));
  }
}

TEST(Depth, IsWrittenInPlaceIfTheMapIsNotShared) {
  MapHarness harness("mtdepth", "");
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  GstBuffer* alone = map_buffer(kMap);
  EXPECT_EQ(harness.pass(alone).get(), alone);
  const BufferPointer shared(map_buffer(kMap));
  const BufferPointer out = harness.pass(gst_buffer_ref(shared.get()));
  EXPECT_NE(out.get(), shared.get());
  expect_map(kMap.values, map_of(shared.get(), kWidth, kHeight));
  expect_map(expected(kMap, kInMillimeters), map_of(out.get(), kWidth, kHeight));
}

TEST(Depth, KeepsTheConfidenceAndTheTimes) {
  const std::vector<std::uint8_t> sure = {0,   1,   2,  99, 100, 101, 0,  200,
                                          254, 255, 50, 60, 70,  80,  255};
  for (const bool shared : {false, true}) {
    MapHarness harness("mtdepth", "");
    harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
    GstBuffer* buffer = map_buffer(kMap, 7 * kFrame);
    attach_confidence(buffer, kWidth, kHeight, sure);
    const BufferPointer other(shared ? gst_buffer_ref(buffer) : nullptr);
    const BufferPointer out = harness.pass(buffer);
    ASSERT_TRUE(out);
    EXPECT_EQ(confidence_of(out.get()), sure);
    EXPECT_EQ(GST_BUFFER_PTS(out.get()), 7 * kFrame);
    EXPECT_EQ(GST_BUFFER_DURATION(out.get()), kFrame);
  }
}

TEST(Depth, PropertiesCanBeChangedWhilePlaying) {
  MapHarness harness("mtdepth", "");
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  g_object_set(harness.element(), "unit", 10.0, "baseline", 0.25, nullptr);
  const BufferPointer out = harness.pass(map_buffer(kMap));
  ASSERT_TRUE(out);
  EXPECT_EQ(map_of(out.get(), kWidth, kHeight)[7],
            static_cast<std::uint16_t>(std::lround(700 * 0.25 / 20 * 100)));
  const std::string caps = harness.output_caps();
  EXPECT_NE(caps.find("depth-unit=(double)0.01"), std::string::npos) << caps;
  EXPECT_NE(caps.find("baseline=(double)0.25"), std::string::npos) << caps;
  g_object_set(harness.element(), "focal-length", 350.0, nullptr);
  EXPECT_EQ(map_of(harness.pass(map_buffer(kMap)).get(), kWidth, kHeight)[7],
            static_cast<std::uint16_t>(std::lround(350 * 0.25 / 20 * 100)));
  g_object_set(harness.element(), "far", 4.0, nullptr);
  EXPECT_EQ(map_of(harness.pass(map_buffer(kMap)).get(), kWidth, kHeight)[7], 0);
}

/// A field of the message about a stream.
double number_of(const MessagePointer& message, const char* name) {
  double value = 0;
  if (!message) {
    ADD_FAILURE() << "no message";
    return value;
  }
  const GstStructure* fields = gst_message_get_structure(message.get());
  EXPECT_STREQ(gst_structure_get_name(fields), "mtstereo-depth");
  EXPECT_TRUE(gst_structure_get_double(fields, name, &value)) << name;
  return value;
}

// Feature: measurable range
TEST(Depth, ReportsTheUncertaintyAtTheFarLimitOnce) {
  MapHarness harness("mtdepth", "far=20");
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  const MessagePointer message = next_message(harness.bus(), GST_MESSAGE_ELEMENT);
  EXPECT_EQ(number_of(message, "far"), 20);
  EXPECT_EQ(number_of(message, "focal-length"), 700);
  EXPECT_DOUBLE_EQ(number_of(message, "depth-step"), 20.0 * 20 / kConstant / 256);
  EXPECT_DOUBLE_EQ(number_of(message, "depth-error"),
                   20.0 * 20 / kConstant * number_of(message, "disparity-error"));
  EXPECT_FALSE(next_message(harness.bus(), GST_MESSAGE_ELEMENT));
}

TEST(Depth, ReportsNoLimitBeyondTheSmallestDisparity) {
  MapHarness harness("mtdepth", "unit=10");
  harness.caps(kWidth, kHeight, std::string(",disparity-scale=1,max-disparity=64") + kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  EXPECT_EQ(number_of(next_message(harness.bus(), GST_MESSAGE_ELEMENT), "far"), kConstant);
}

TEST(Depth, ReportsTheUncertaintyInASentence) {
  MapHarness harness("mtdepth", "");
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  ASSERT_TRUE(harness.pass(map_buffer(kMap)));
  const std::string text = text_of(next_message(harness.bus(), GST_MESSAGE_INFO));
  EXPECT_NE(text.find("At 65.535 m"), std::string::npos) << text;
}

/// A calibration file as KITTI's odometry has it, removed by the destructor.
class CalibrationFile {
 public:
  explicit CalibrationFile(double focal, double baseline) {
    std::ofstream out(path_);
    const auto row = [&](const char* name, double last) {
      out << name << focal << " 0 2.5 " << last << " 0 " << focal << " 1.25 0 0 0 1 0\n";
    };
    row("P0: ", 0);
    row("P1: ", -focal * baseline);
  }
  ~CalibrationFile() { std::filesystem::remove(path_); }
  CalibrationFile(const CalibrationFile&) = delete;
  CalibrationFile& operator=(const CalibrationFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("mtstereo-" + std::to_string(getpid()) + "-calib.txt"))
                          .string();
};

TEST(Depth, TakesTheGeometryOfACalibrationFile) {
  const CalibrationFile file(350, 0.25);
  MapHarness harness("mtdepth", "calibration=" + file.path());
  harness.caps(kWidth, kHeight, std::string(kScale) + kRig);
  const BufferPointer out = harness.pass(map_buffer(kMap));
  ASSERT_TRUE(out);
  expect_map(expected(kMap, [](int value) { return depth_mm(value, 350 * 0.25); }),
             map_of(out.get(), kWidth, kHeight));
  const std::string caps = harness.output_caps();
  for (const char* field : {"focal-length=(double)350", "baseline=(double)0.25",
                            "principal-x=(double)2.5", "principal-y=(double)1.25"}) {
    EXPECT_NE(caps.find(field), std::string::npos) << field << " in " << caps;
  }
  expect_map(expected(kMap, [](int value) { return depth_mm(value, 350 * 0.5); }),
             depths_of("baseline=0.5 calibration=" + file.path(), kScale));
}

TEST(Depth, ReadsTheCalibrationAndReportsTheDepthsAtEveryStart) {
  auto file = std::make_unique<CalibrationFile>(350, 0.25);
  const Pipeline pipeline(
      "videotestsrc num-buffers=1 ! video/x-raw,format=GRAY16_LE,width=64,height=48 ! "
      "mtdepth calibration=" +
      file->path() + " ! fakesink");
  GstBus* bus = gst_element_get_bus(pipeline.element());
  for (const double focal : {350, 400, 400}) {
    file.reset();
    file = std::make_unique<CalibrationFile>(focal, 0.25);
    gst_element_set_state(pipeline.element(), GST_STATE_PLAYING);
    EXPECT_EQ(number_of(next_message(bus, GST_MESSAGE_ELEMENT, 5), "focal-length"), focal);
    gst_element_set_state(pipeline.element(), GST_STATE_READY);
  }
  gst_object_unref(bus);
}

TEST(Depth, AnswersTheCapsQueryOfASourceWithAGeometry) {
  MapHarness harness("mtdepth", "");
  const CapsPointer offered(gst_caps_from_string(
      (std::string("video/x-raw,format=GRAY16_LE,width=5,height=3,framerate=30/1") + kScale + kRig)
          .c_str()));
  GstPad* pad = gst_element_get_static_pad(harness.element(), "sink");
  const CapsPointer accepted(gst_pad_query_caps(pad, offered.get()));
  gst_object_unref(pad);
  EXPECT_TRUE(gst_caps_is_equal(accepted.get(), offered.get()));
}

TEST(Depth, CanBeFilteredByConfidence) {
  // mtconfidence accepts every 16-bit map with a confidence.
  MapHarness harness("mtconfidence", "min-confidence=100");
  harness.caps(kWidth, kHeight, std::string(",depth-unit=0.001") + kRig);
  GstBuffer* buffer = map_buffer(kMap);
  attach_confidence(buffer, kWidth, kHeight, std::vector<std::uint8_t>(15, 99));
  const BufferPointer out = harness.pass(buffer);
  ASSERT_TRUE(out);
  expect_map(std::vector<std::uint16_t>(15, 0), map_of(out.get(), kWidth, kHeight));
  const std::string caps = harness.output_caps();
  EXPECT_NE(caps.find("depth-unit"), std::string::npos) << caps;
}

}  // namespace
}  // namespace mtstereo::test::mtdepth_test

// SPDX-License-Identifier: LGPL-2.1-or-later
// The unit of the disparity maps in a meta: attached, read, copied, transformed.
#include "shared/disparity_meta.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::disparity_meta_test {
namespace {

using plugin::disparity_unit_of;
using plugin::DisparityUnit;

constexpr DisparityUnit kUnit = {
    .scale = 64, .max_disparity = 300, .min_disparity = -20, .offset = -20};

class DisparityMeta : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(plugin::register_disparity_meta());
    map.reset(gst_buffer_new_allocate(nullptr, 96, nullptr));
    plugin::set_disparity_unit(map.get(), kUnit);
  }
  GstStructure* fields() {
    return gst_custom_meta_get_structure(
        gst_buffer_get_custom_meta(map.get(), "MtStereoDisparityMeta"));
  }

  BufferPointer map;
};

// Feature: metric disparity in fixed point
TEST_F(DisparityMeta, HasTheFieldsOfTheCaps) {
  int scale = 0, most = 0, least = 0, offset = 0;
  EXPECT_TRUE(gst_structure_get(fields(), "disparity-scale", G_TYPE_INT, &scale, "max-disparity",
                                G_TYPE_INT, &most, "min-disparity", G_TYPE_INT, &least,
                                "disparity-offset", G_TYPE_INT, &offset, nullptr));
  EXPECT_EQ(scale, 64);
  EXPECT_EQ(most, 300);
  EXPECT_EQ(least, -20);
  EXPECT_EQ(offset, -20);
}

TEST_F(DisparityMeta, TheLastOneReplacesTheOthers) {
  DisparityUnit other = kUnit;
  other.scale = 16;
  plugin::set_disparity_unit(map.get(), other);
  EXPECT_EQ(disparity_unit_of(map.get()), other);
}

TEST_F(DisparityMeta, IsCopiedWithTheWholeBufferOnly) {
  const BufferPointer copy(gst_buffer_copy(map.get()));
  const BufferPointer part(gst_buffer_copy_region(map.get(), GST_BUFFER_COPY_ALL, 16, 32));
  EXPECT_EQ(disparity_unit_of(copy.get()), kUnit);
  EXPECT_EQ(disparity_unit_of(part.get()), std::nullopt);
}

TEST_F(DisparityMeta, IsIgnoredIfItIsNotValid) {
  const BufferPointer none(gst_buffer_new());
  EXPECT_EQ(disparity_unit_of(none.get()), std::nullopt);
  for (const int scale : {0, -1, 65536}) {
    gst_structure_set(fields(), "disparity-scale", G_TYPE_INT, scale, nullptr);
    EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt) << scale;
  }
  gst_structure_set(fields(), "disparity-scale", G_TYPE_STRING, "64", nullptr);
  EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt);
  gst_structure_set(fields(), "disparity-scale", G_TYPE_INT, 64, "max-disparity", G_TYPE_INT, 0,
                    nullptr);
  EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt);
  gst_structure_set(fields(), "max-disparity", G_TYPE_INT, 300, "disparity-offset", G_TYPE_INT, 1,
                    nullptr);
  EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt) << "a positive offset";
  gst_structure_set(fields(), "disparity-offset", G_TYPE_INT, 0, "min-disparity", G_TYPE_INT, 300,
                    nullptr);
  EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt) << "an empty range";
  gst_structure_remove_field(fields(), "max-disparity");
  EXPECT_EQ(disparity_unit_of(map.get()), std::nullopt);
}

// Feature: metric disparity in fixed point
TEST(DisparityUnits, AreOnEveryMapAndFollowTheProperties) {
  StereoHarness harness("max-disparity=16 confidence-map=false");
  harness.caps(raw_caps("GRAY8", 64, 48));
  const Pair pair = noise_pair(64, 48, 4, 1);
  harness.push_pair(pair, 0);
  BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(disparity_unit_of(map.get()), (DisparityUnit{.scale = 256, .max_disparity = 16}));
  g_object_set(harness.element(), "max-disparity", 20, "disparity-scale", 100, nullptr);
  harness.push_pair(pair, kFrame);
  map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(disparity_unit_of(map.get()), (DisparityUnit{.scale = 100, .max_disparity = 20}));
}

/// A number in the output caps; std::nullopt if it is absent.
std::optional<int> caps_field(const StereoHarness& harness, const char* name) {
  const CapsPointer caps = harness.output_caps();
  int value = 0;
  if (!gst_structure_get_int(gst_caps_get_structure(caps.get(), 0), name, &value)) {
    return std::nullopt;
  }
  return value;
}

TEST(DisparityUnits, HaveTheSmallestDisparityAndAnOffsetIfItIsNegative) {
  StereoHarness harness("max-disparity=16 alignment=off");
  harness.caps(raw_caps("GRAY8", 96, 64));
  // The smooth noise is moved to the left in the right view: swapped, its disparity is negative.
  const Pair pair = noise_pair(96, 64, 6, 1);
  const Pair swapped = {pair.right, pair.left};
  GstClockTime time = 0;
  for (const int least : {-12, 3, -7, 0}) {
    g_object_set(harness.element(), "min-disparity", least, nullptr);
    const Pair& views = least < 0 ? swapped : pair;
    harness.push_pair(views, time);
    time += kFrame;
    const BufferPointer map = harness.pull();
    ASSERT_TRUE(map) << harness.error(0).text;
    Parameters parameters;
    ASSERT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
    ASSERT_TRUE(parameters.set(Parameter::kMinDisparity, least).ok());
    const std::vector<std::uint16_t> values = map_of(map.get(), 96, 64);
    EXPECT_EQ(first_difference(library_map(views, parameters, 256), values, 96), "");
    const int offset = std::min(least, 0);
    EXPECT_EQ(disparity_unit_of(map.get()),
              (DisparityUnit{
                  .scale = 256, .max_disparity = 16, .min_disparity = least, .offset = offset}));
    EXPECT_EQ(caps_field(harness, "min-disparity"),
              least != 0 ? std::optional(least) : std::nullopt);
    EXPECT_EQ(caps_field(harness, "disparity-offset"),
              offset != 0 ? std::optional(offset) : std::nullopt);
    long known = 0, near = 0;
    for (const std::uint16_t value : values) {
      known += value != 0;
      near += value != 0 && std::abs(value / 256.0 + offset - (least < 0 ? -6 : 6)) < 1;
    }
    EXPECT_GT(known, 600);
    EXPECT_GT(static_cast<double>(near), 0.9 * static_cast<double>(known)) << least;
  }
  EXPECT_EQ(harness.warnings().size(), 0u);
}

TEST(DisparityUnits, AreKeptIfTheSmallestDisparityExceedsTheLargest) {
  StereoHarness harness("max-disparity=16");
  harness.caps(raw_caps("GRAY8", 64, 48));
  const Pair pair = noise_pair(64, 48, 4, 1);
  harness.push_pair(pair, 0);
  ASSERT_TRUE(harness.pull());
  g_object_set(harness.element(), "min-disparity", 16, nullptr);
  harness.push_pair(pair, kFrame);
  ASSERT_TRUE(harness.pull());
  const std::vector<Report> warnings = harness.warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("min-disparity = 16"), std::string::npos) << warnings[0].text;
  int least = -1;
  g_object_get(harness.element(), "min-disparity", &least, nullptr);
  EXPECT_EQ(least, 0);
}

/// The unit of the maps downstream of `elements`; std::nullopt if there is no meta.
std::optional<DisparityUnit> unit_after(const std::string& elements) {
  GstHarness* harness = gst_harness_new_parse(elements.c_str());
  gst_harness_set_src_caps_str(
      harness, (raw_caps("GRAY16_LE", 16, 8) + ",disparity-scale=64,max-disparity=300").c_str());
  GstBuffer* buffer = gst_buffer_new_allocate(nullptr, 16 * 8 * 2, nullptr);
  GST_BUFFER_PTS(buffer) = 0;
  GST_BUFFER_DURATION(buffer) = kFrame;
  plugin::set_disparity_unit(buffer, kUnit);
  gst_harness_push(harness, buffer);
  const BufferPointer out(gst_harness_pull(harness));
  const auto unit = out ? disparity_unit_of(out.get()) : std::nullopt;
  EXPECT_TRUE(out) << elements;
  gst_harness_teardown(harness);
  return unit;
}

// Feature: metric disparity in fixed point
TEST(DisparityUnits, SurviveWhereThePixelsDo) {
  ASSERT_TRUE(plugin::register_disparity_meta());
  for (const char* elements :
       {"queue", "identity", "videoconvert ! capsfilter caps=video/x-raw,format=GRAY16_BE",
        "capssetter replace=true caps=video/x-raw,format=GRAY16_LE,width=16,height=8,"
        "framerate=30/1"}) {
    EXPECT_EQ(unit_after(elements), kUnit) << elements;
  }
}

TEST(DisparityUnits, AreRemovedFromOtherImages) {
  ASSERT_TRUE(plugin::register_disparity_meta());
  for (const char* elements : {"videoscale ! capsfilter caps=video/x-raw,width=8,height=4",
                               "mtcolor ! capsfilter caps=video/x-raw,format=RGB"}) {
    EXPECT_EQ(unit_after(elements), std::nullopt) << elements;
  }
}

/// The first pixel's color of a map with this value; the caps have these additional fields.
std::array<int, 3> color_of(std::uint16_t value, const std::string& fields, bool meta) {
  GstHarness* harness = gst_harness_new_parse("mtcolor ! capsfilter caps=video/x-raw,format=RGB");
  gst_harness_set_src_caps_str(harness, (raw_caps("GRAY16_LE", 2, 1) + fields).c_str());
  const std::uint16_t values[] = {GUINT16_TO_LE(value), 0};
  GstBuffer* buffer = gst_buffer_new_memdup(values, sizeof values);
  GST_BUFFER_PTS(buffer) = 0;
  if (meta) plugin::set_disparity_unit(buffer, kUnit);
  gst_harness_push(harness, buffer);
  const BufferPointer out(gst_harness_pull(harness));
  guint8 rgb[3] = {};
  gst_buffer_extract(out.get(), 0, rgb, sizeof rgb);
  gst_harness_teardown(harness);
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(DisparityUnits, AreThoseOfMtcolorIfTheCapsHaveNone) {
  ASSERT_TRUE(plugin::register_disparity_meta());
  const std::uint16_t value = 100 * 64;
  const auto expected =
      color_of(value, ",disparity-scale=64,max-disparity=300,disparity-offset=-20", false);
  EXPECT_EQ(expected, color_of(value, ",disparity-scale=64,max-disparity=320", false))
      << "the first color is that of the offset";
  EXPECT_EQ(color_of(value, "", true), expected);
  EXPECT_NE(color_of(value, "", false), expected);
  const auto caps = color_of(value, ",disparity-scale=128,max-disparity=100", false);
  EXPECT_EQ(color_of(value, ",disparity-scale=128,max-disparity=100", true), caps)
      << "the caps take precedence";
}

TEST(DisparityUnits, AreKeptByMtconfidenceOnMapsOnly) {
  for (const bool confidence : {false, true}) {
    StereoHarness harness("max-disparity=16");
    harness.caps(raw_caps("GRAY8", 64, 48));
    harness.push_pair(noise_pair(64, 48, 4, 1), 0);
    BufferPointer map = harness.pull();
    ASSERT_TRUE(map);
    GstHarness* filter = gst_harness_new_parse(confidence ? "mtconfidence output=confidence"
                                                          : "mtconfidence min-confidence=10");
    gst_harness_set_src_caps_str(filter, raw_caps("GRAY16_LE", 64, 48).c_str());
    gst_harness_push(filter, map.release());
    const BufferPointer out(gst_harness_pull(filter));
    ASSERT_TRUE(out);
    EXPECT_EQ(disparity_unit_of(out.get()).has_value(), !confidence);
    gst_harness_teardown(filter);
  }
}

}  // namespace
}  // namespace mtstereo::test::disparity_meta_test

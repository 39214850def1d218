// SPDX-License-Identifier: LGPL-2.1-or-later
// mtcolor on depth maps. mtcolor_test.cpp has the disparity maps.
#include <gtest/gtest.h>

#include <array>

#include "support/map_harness.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtcolor_depth_test {
namespace {

using Color = std::array<int, 3>;
constexpr Color kBlack = {0, 0, 0};
constexpr Color kFirst = {48, 18, 59};  // of Turbo: blue
constexpr Color kLast = {122, 4, 3};    // of Turbo: red

/// The colors of depths in mm.
std::vector<Color> colors_of(MapHarness& harness, const std::vector<std::uint16_t>& depths,
                             const char* unit = "0.001") {
  const int width = static_cast<int>(depths.size());
  harness.caps(width, 1, std::string(",depth-unit=(double)") + unit);
  const BufferPointer out = harness.pass(map_buffer({width, 1, depths}));
  std::vector<Color> colors;
  GstMapInfo map;
  if (!out || !gst_buffer_map(out.get(), &map, GST_MAP_READ)) {
    ADD_FAILURE() << "no image";
    return std::vector<Color>(depths.size());
  }
  for (std::size_t i = 0; i < depths.size(); ++i) {
    colors.push_back({map.data[3 * i], map.data[3 * i + 1], map.data[3 * i + 2]});
  }
  gst_buffer_unmap(out.get(), &map);
  return colors;
}

std::vector<Color> colors_of(const std::string& properties,
                             const std::vector<std::uint16_t>& depths) {
  MapHarness harness("mtcolor", properties);
  return colors_of(harness, depths);
}

TEST(DepthColor, IsRedNearBlueFarAndBlackWithoutADepth) {
  for (const char* scale : {"inverse", "linear", "log"}) {
    const auto colors = colors_of(std::string("near=1 far=20 color-scale=") + scale,
                                  {0, 500, 1000, 20000, 60000, 5000});
    EXPECT_EQ(colors[0], kBlack);
    EXPECT_EQ(colors[1], kLast);
    EXPECT_EQ(colors[2], kLast);
    EXPECT_EQ(colors[3], kFirst);
    EXPECT_EQ(colors[4], kFirst);
    EXPECT_NE(colors[5], kFirst);
    EXPECT_NE(colors[5], kLast);
  }
}

TEST(DepthColor, ScalesHaveTheSameColorInTheirMiddle) {
  const auto inverse = colors_of("near=1 far=4 color-scale=inverse", {1600});  // 1 / 0.625
  const auto linear = colors_of("near=1 far=4 color-scale=linear", {2500});
  const auto log = colors_of("near=1 far=4 color-scale=log", {2000});
  EXPECT_EQ(inverse, linear);
  EXPECT_EQ(linear, log);
}

TEST(DepthColor, UsesTheUnitOfTheCaps) {
  MapHarness harness("mtcolor", "near=1 far=20");
  EXPECT_EQ(colors_of(harness, {5000, 7000}, "0.001"), colors_of(harness, {500, 700}, "0.01"));
}

TEST(DepthColor, DoesNotDependOnTheFrame) {
  MapHarness harness("mtcolor", "");
  EXPECT_EQ(colors_of(harness, {5000, 5000, 5000})[0], colors_of(harness, {5000, 1, 65535})[0]);
}

TEST(DepthColor, RangeCanBeChangedWhilePlaying) {
  MapHarness harness("mtcolor", "near=1 far=20");
  EXPECT_NE(colors_of(harness, {10000})[0], kFirst);
  g_object_set(harness.element(), "far", 10.0, nullptr);
  EXPECT_EQ(colors_of(harness, {10000})[0], kFirst);
  g_object_set(harness.element(), "near", 30.0, nullptr);
  EXPECT_EQ(colors_of(harness, {10000})[0], kFirst) << "the range that is none is refused";
  EXPECT_NE(text_of(next_message(harness.bus(), GST_MESSAGE_WARNING)).find("near=30"),
            std::string::npos);
}

TEST(DepthColor, MayFollowDisparities) {
  MapHarness harness("mtcolor", "near=1 far=20");
  const auto depth = colors_of(harness, {1000, 20000});
  harness.caps(2, 1, ",disparity-scale=256,max-disparity=32");
  const BufferPointer out = harness.pass(map_buffer({2, 1, {0, 32 * 256}}));
  ASSERT_TRUE(out);
  GstMapInfo map;
  ASSERT_TRUE(gst_buffer_map(out.get(), &map, GST_MAP_READ));
  EXPECT_EQ(map.data[3], kLast[0]);
  EXPECT_EQ(map.data[0], 0);
  gst_buffer_unmap(out.get(), &map);
  EXPECT_EQ(colors_of(harness, {1000, 20000}), depth);
}

TEST(DepthColor, ReportsAnInvalidUnit) {
  for (const char* unit : {"0.0", "-1.0"}) {
    MapHarness harness("mtcolor", "");
    const std::string error =
        harness.error_of({1, 1, {1}}, std::string(",depth-unit=(double)") + unit);
    EXPECT_NE(error.find("depth-unit"), std::string::npos) << error;
  }
}

TEST(DepthColor, AcceptsTheOutputOfMtdepth) {
  Pipeline pipeline(
      "videotestsrc num-buffers=3 pattern=smpte ! "
      "video/x-raw,format=GRAY8,width=160,height=120 ! tee name=t "
      "mtstereo name=m max-disparity=32 ! mtdepth focal-length=100 baseline=0.2 ! "
      "mtcolor far=10 ! video/x-raw,format=RGB ! appsink name=out wait-on-eos=false sync=false "
      "t. ! queue ! m.sink_left t. ! queue ! videobox left=4 right=-4 ! m.sink_right");
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].caps.find("depth-unit"), std::string::npos) << samples[0].caps;
}

}  // namespace
}  // namespace mtstereo::test::mtcolor_depth_test

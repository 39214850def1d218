// SPDX-License-Identifier: LGPL-2.1-or-later
// What mtrectify states of the frames arrives downstream of mtstereo.
#include <gtest/gtest.h>

#include <algorithm>

#include "cameras/camera_harness.hpp"
#include "geometry/rigs.hpp"
#include "matcher/engine/view_borders.hpp"
#include "shared/stereo_geometry.hpp"
#include "shared/valid_columns_meta.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::geometry_fields_test {
namespace {

constexpr int kWidth = 128;
constexpr int kHeight = 64;
constexpr int kShift = 6;

std::string caps_with(double focal_length, double baseline = 0.12,
                      PixelRectangle region = {2, 3, 100, 50}) {
  const CapsPointer caps(gst_caps_from_string(raw_caps("GRAY8", kWidth, kHeight).c_str()));
  plugin::write_geometry(gst_caps_get_structure(caps.get(), 0),
                         {focal_length, baseline, 1.5, 63, 31, region});
  gchar* text = gst_caps_to_string(caps.get());
  std::string result = text;
  g_free(text);
  return result;
}

Pair pair() { return noise_pair(kWidth, kHeight, kShift, 3); }

std::optional<plugin::StereoGeometry> geometry_of(const GstCaps* caps) {
  return caps != nullptr ? plugin::read_geometry(gst_caps_get_structure(caps, 0)) : std::nullopt;
}

// Feature: calibration in caps, properties and files
TEST(GeometryFields, AreThoseOfTheLeftStream) {
  StereoHarness harness;
  harness.caps(caps_with(700));
  harness.push_pair(pair(), 0);
  ASSERT_TRUE(harness.pull());
  const auto found = geometry_of(harness.output_caps().get());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->focal_length, 700);
  EXPECT_EQ(found->baseline, 0.12);
  EXPECT_EQ(found->principal_offset, 1.5);
  EXPECT_EQ(found->principal_x, 63);
  EXPECT_EQ(found->valid_region, (PixelRectangle{2, 3, 100, 50}));
}

TEST(GeometryFields, ChangeOfThemAloneChangesTheOutput) {
  StereoHarness harness;
  harness.caps(caps_with(700));
  harness.push_pair(pair(), 0);
  ASSERT_TRUE(harness.pull());
  harness.caps(caps_with(710));
  harness.push_pair(pair(), kFrame);
  ASSERT_TRUE(harness.pull());
  EXPECT_EQ(geometry_of(harness.output_caps().get()).value().focal_length, 710);
  harness.caps(raw_caps("GRAY8", kWidth, kHeight));
  harness.push_pair(pair(), 2 * kFrame);
  ASSERT_TRUE(harness.pull());
  EXPECT_FALSE(geometry_of(harness.output_caps().get()));
  EXPECT_TRUE(harness.warnings().empty());
}

TEST(GeometryFields, TwoRectificationsAreAWarning) {
  StereoHarness harness;
  harness.caps(caps_with(700), caps_with(701));
  harness.push_pair(pair(), 0);
  ASSERT_TRUE(harness.pull());
  harness.push_pair(pair(), kFrame);
  ASSERT_TRUE(harness.pull());
  const auto warnings = harness.warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].text.find("not rectified as a pair"), std::string::npos);
  EXPECT_EQ(geometry_of(harness.output_caps().get()).value().focal_length, 700);
}

TEST(GeometryFields, OfViewsThatWereScaledOrCroppedSinceAreAWarning) {
  for (const PixelRectangle region :
       {PixelRectangle{0, 0, 256, 128}, PixelRectangle{0, 1, 129, 63}}) {
    StereoHarness harness;
    harness.caps(caps_with(700, 0.12, region));
    harness.push_pair(pair(), 0);
    ASSERT_TRUE(harness.pull());
    harness.push_pair(pair(), kFrame);
    ASSERT_TRUE(harness.pull());
    const auto warnings = harness.warnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].text.find("scales or crops"), std::string::npos) << warnings[0].text;
  }
}

/// A frame that is black outside of these columns in every row, with the meta that says so.
GstBuffer* bordered(GrayImage image, ValidColumns columns, bool meta) {
  for (int i = 0; i < kWidth * kHeight; ++i) {
    if (i % kWidth >= columns.begin && i % kWidth < columns.end) continue;
    image.pixels[static_cast<std::size_t>(i)] = 0;
  }
  GstBuffer* frame = frame_buffer(image, 0, kFrame);
  if (!meta) return frame;
  GBytes* bytes = plugin::pack_valid_columns(std::vector<ValidColumns>(kHeight, columns));
  plugin::set_valid_columns(frame, bytes);
  g_bytes_unref(bytes);
  return frame;
}

class Border : public testing::Test {
 protected:
  void match(bool meta, const std::string& properties = "max-disparity=16 mode=dense") {
    StereoHarness harness(properties);
    harness.caps(raw_caps("GRAY8", kWidth, kHeight));
    const Pair views = pair();
    harness.push(Side::kLeft, bordered(views.left, {20, kWidth - 8}, meta));
    harness.push(Side::kRight, bordered(views.right, {24, kWidth - 20}, meta));
    const BufferPointer out = harness.pull();
    ASSERT_TRUE(out);
    map = map_of(out.get(), kWidth, kHeight);
    confidence = confidence_of(out.get());
    density = harness.stats().density;
    EXPECT_EQ(plugin::valid_columns_of(out.get()), nullptr);  // it is of the view, not of the map
  }
  int estimates(int begin, int end) const {
    int count = 0;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (i % kWidth >= begin && i % kWidth < end && map[at] != 0) ++count;
      EXPECT_TRUE(map[at] != 0 || confidence[at] == 0) << i % kWidth << " " << i / kWidth;
    }
    return count;
  }

  std::vector<std::uint16_t> map;
  std::vector<std::uint8_t> confidence;
  double density = 0;
};

TEST_F(Border, PixelsOfTheBorderHaveNoDisparity) {
  match(true);
  // The right view begins at 24: the left pixel of its first pixels is at 30.
  EXPECT_EQ(estimates(0, 24 + kShift), 0);
  EXPECT_EQ(estimates(kWidth - 20 + kShift, kWidth), 0);
  EXPECT_EQ(estimates(kWidth - 8, kWidth), 0);
  const int inside = estimates(0, kWidth);
  EXPECT_GT(inside, 50 * kHeight);
  EXPECT_NEAR(density, static_cast<double>(inside) / (kWidth * kHeight), 1e-6);
}

TEST_F(Border, FramesWithoutTheMetaAreNotChanged) {
  match(false);
  EXPECT_GT(estimates(0, 24 + kShift), 0);
}

TEST(Borders, OfTheSameColumnsFollowTheMargin) {
  const BufferPointer frame(bordered(pair().left, {20, kWidth - 8}, true));
  const int pixels = kWidth * kHeight;
  std::vector<std::uint16_t> map(static_cast<std::size_t>(pixels));
  plugin::Borders borders;
  for (const int margin : {5, 8}) {
    borders.take(frame.get(), frame.get(), {kWidth, kHeight, margin});
    std::fill(map.begin(), map.end(), std::uint16_t{1});
    borders.remove({map.data(), kWidth, kHeight, 2 * kWidth}, {1, 64, 0, 0});
    EXPECT_EQ(std::find(map.begin(), map.end(), 1) - map.begin(), 20 + margin + 1);
  }
}

TEST_F(Border, AppliesWithNegativeDisparitiesToo) {
  match(true, "min-disparity=-4 max-disparity=16 mode=dense");
  EXPECT_EQ(estimates(0, 24 + kShift), 0);
  EXPECT_EQ(estimates(kWidth - 20 + kShift, kWidth), 0);
  EXPECT_GT(estimates(0, kWidth), 50 * kHeight);
}

TEST(Chain, RectifiedPairStatesItsGeometryAndHasNoDisparityInTheBorder) {
  CalibrationFolder folder;
  const StereoCalibration rig = plumb_bob_rig(320, 240);
  const std::string file = folder.write(rig);
  Pipeline pipeline(
      "videotestsrc pattern=smpte75 num-buffers=3 ! video/x-raw,format=GRAY8,width=640,height=240 "
      "! mtsplit name=s s.left ! queue ! mtrectify alpha=1 calibration=" +
      file + " ! m.sink_left s.right ! queue ! mtrectify camera=right alpha=1 calibration=" + file +
      " ! m.sink_right mtstereo name=m mode=dense max-disparity=32 ! appsink name=out "
      "wait-on-eos=false sync=false");
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 3u);
  const Rectification r = rectify(rig, {.alpha = 1}).value();
  const CapsPointer caps(gst_caps_from_string(samples[0].caps.c_str()));
  EXPECT_NEAR(geometry_of(caps.get()).value().focal_length, r.focal_length, 1e-6);
  const auto rectifier = std::move(Rectifier::create(rig, r, Rectifier::Side::kLeft).value());
  int outside = 0;
  for (int y = 0; y < 240; ++y) {
    const ValidColumns& columns = rectifier.valid_columns()[static_cast<std::size_t>(y)];
    for (int x = 0; x < 320; ++x) {
      if (x >= columns.begin && x < columns.end) continue;
      ++outside;
      const std::size_t at = static_cast<std::size_t>(y * 320 + x) * 2;
      ASSERT_EQ(samples[0].bytes[at] + samples[0].bytes[at + 1], 0) << x << " " << y;
    }
  }
  EXPECT_GT(outside, 1000);
}

TEST(Chain, SeeksOfBothViewsAreOne) {
  CalibrationFolder folder;
  const std::string file = folder.write(plumb_bob_rig(160, 120));
  Pipeline pipeline(
      "videotestsrc num-buffers=200 ! video/x-raw,format=GRAY8,width=320,height=120,framerate=30/1 "
      "! mtsplit name=s s.left ! queue ! mtrectify calibration=" +
      file + " ! m.sink_left s.right ! queue ! mtrectify camera=right calibration=" + file +
      " ! m.sink_right mtstereo name=m max-disparity=16 ! appsink name=out wait-on-eos=false "
      "sync=false");
  pipeline.set_state(GST_STATE_PAUSED);
  ASSERT_TRUE(pipeline.wait_until_settled());
  for (const int second : {2, 1, 3}) {
    ASSERT_TRUE(
        pipeline.seek(static_cast<GstClockTime>(second) * GST_SECOND,
                      static_cast<GstSeekFlags>(GST_SEEK_FLAG_FLUSH | GST_SEEK_FLAG_ACCURATE)));
    ASSERT_TRUE(pipeline.wait_until_settled());
  }
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_GT(samples.size(), 10u);
  EXPECT_NEAR(static_cast<double>(samples[0].pts), 3e9, 1e8);
  const Stats stats = stats_of(pipeline.named("m"));
  EXPECT_EQ(stats.dropped_left + stats.dropped_right, 0u);
}

class ValidColumnsMeta : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(plugin::register_valid_columns_meta());
    frame.reset(gst_buffer_new_allocate(nullptr, 96, nullptr));
    columns.reset(plugin::pack_valid_columns({{1, 5}, {0, 7}, {0, 0}}));
    plugin::set_valid_columns(frame.get(), columns.get());
  }
  struct BytesUnref {
    void operator()(GBytes* bytes) const { g_bytes_unref(bytes); }
  };
  BufferPointer frame;
  std::unique_ptr<GBytes, BytesUnref> columns;
};

TEST_F(ValidColumnsMeta, IsCopiedWithTheWholeBufferOnly) {
  const BufferPointer copy(gst_buffer_copy(frame.get()));
  const BufferPointer part(gst_buffer_copy_region(frame.get(), GST_BUFFER_COPY_ALL, 16, 32));
  EXPECT_EQ(plugin::valid_columns_of(copy.get()), columns.get());
  EXPECT_EQ(plugin::valid_columns_of(part.get()), nullptr);
}

TEST_F(ValidColumnsMeta, FitsOnlyItsSize) {
  EXPECT_EQ(plugin::unpack_valid_columns(columns.get(), 7, 3),
            (std::vector<ValidColumns>{{1, 5}, {0, 7}, {0, 0}}));
  EXPECT_TRUE(plugin::unpack_valid_columns(columns.get(), 7, 4).empty());
  EXPECT_TRUE(plugin::unpack_valid_columns(columns.get(), 6, 3).empty());
  EXPECT_TRUE(plugin::unpack_valid_columns(columns.get(), 7, 0).empty());
}

TEST_F(ValidColumnsMeta, OthersReplaceIt) {
  const std::unique_ptr<GBytes, BytesUnref> other(plugin::pack_valid_columns({{2, 3}}));
  plugin::set_valid_columns(frame.get(), other.get());
  EXPECT_EQ(plugin::valid_columns_of(frame.get()), other.get());
  plugin::remove_valid_columns(frame.get());
  EXPECT_EQ(plugin::valid_columns_of(frame.get()), nullptr);
}

}  // namespace
}  // namespace mtstereo::test::geometry_fields_test

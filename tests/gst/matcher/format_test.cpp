// SPDX-License-Identifier: LGPL-2.1-or-later
// Input frames and output maps: formats, layouts and caps.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::format_test {
namespace {

Parameters small_range() {
  Parameters parameters;
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, 16).ok());
  return parameters;
}

/// The disparity map of one pair, computed by the element.
std::vector<std::uint16_t> through_element(const Pair& pair, const Layout& left,
                                           const Layout& right,
                                           const std::string& properties = "max-disparity=16") {
  StereoHarness harness(properties);
  const int width = pair.left.width;
  const int height = pair.left.height;
  harness.caps(raw_caps(left.format, width, height), raw_caps(right.format, width, height));
  harness.push_pair(pair, 0, left, right);
  const BufferPointer map = harness.pull();
  if (!map) {
    ADD_FAILURE() << "no map: " << harness.error(1).text;
    return {};
  }
  return map_of(map.get(), width, height);
}

// Feature: metric disparity in fixed point
TEST(Output, HasTheDisparityOfThePair) {
  const Pair pair = noise_pair(128, 96, 6, 4);
  const auto map = through_element(pair, {}, {});
  std::vector<std::uint16_t> known;
  std::copy_if(map.begin(), map.end(), std::back_inserter(known), [](auto v) { return v != 0; });
  ASSERT_GT(known.size(), map.size() / 10) << "too few disparities";
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2),
                   known.end());
  EXPECT_NEAR(known[known.size() / 2] / 256.0, 6.0, 0.5);
}

// Feature: odd sizes
// Feature: gray input
TEST(Output, EqualsThatOfTheLibrary) {
  const Pair pair = noise_pair(128, 96, 6, 5);
  const auto expected = library_map(pair, small_range(), 256);
  EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](auto v) { return v != 0; }), 0);
  for (const char* threads : {"1", "2", "4"}) {
    const auto map =
        through_element(pair, {}, {}, std::string("max-disparity=16 threads=") + threads);
    EXPECT_EQ(first_difference(expected, map, 128), "") << threads << " threads";
  }
}

// Feature: 8-bit disparity
// Feature: documented scale that can be selected
TEST(Output, UsesTheScale) {
  const Pair pair = noise_pair(128, 96, 6, 6);
  for (const int scale : {1, 16, 1000}) {
    const auto map =
        through_element(pair, {}, {}, "max-disparity=16 disparity-scale=" + std::to_string(scale));
    EXPECT_EQ(first_difference(library_map(pair, small_range(), scale), map, 128), "")
        << "scale " << scale;
  }
}

// Feature: metric disparity in fixed point
TEST(Output, CapsHaveSizeFramerateAndScale) {
  StereoHarness harness("max-disparity=16 disparity-scale=64");
  harness.caps(
      "video/x-raw,format=GRAY8,width=64,height=48,framerate=25/2,"
      "pixel-aspect-ratio=4/3",
      raw_caps("NV12", 64, 48, "12/1"));
  harness.push_pair(noise_pair(64, 48, 4, 7), 0, {}, {.format = "NV12"});
  ASSERT_TRUE(harness.pull());
  const CapsPointer caps = harness.output_caps();
  const CapsPointer expected(gst_caps_from_string(
      "video/x-raw,format=GRAY16_LE,width=64,height=48,framerate=25/2,pixel-aspect-ratio=4/3,"
      "interlace-mode=progressive,disparity-scale=64,max-disparity=16"));
  EXPECT_TRUE(gst_caps_is_equal(caps.get(), expected.get()))
      << std::unique_ptr<gchar, decltype(&g_free)>(gst_caps_to_string(caps.get()), g_free).get();
}

class LumaFormat : public testing::TestWithParam<const char*> {};

// Feature: planar YUV without a copy
TEST_P(LumaFormat, HasTheSameMapAsGray8) {
  const Pair pair = noise_pair(96, 64, 5, 8);
  const auto expected = through_element(pair, {}, {});
  // The matcher ignores chroma: its value must not change the result.
  for (const std::uint8_t chroma : {0, 255}) {
    const Layout layout{.format = GetParam(), .poison = chroma};
    EXPECT_EQ(first_difference(expected, through_element(pair, layout, layout), 96), "")
        << "chroma " << int{chroma};
  }
  EXPECT_EQ(first_difference(expected, through_element(pair, {.format = GetParam()}, {}), 96), "")
      << "with GRAY8 on the right";
}

INSTANTIATE_TEST_SUITE_P(All, LumaFormat,
                         testing::Values("GRAY8", "I420", "YV12", "Y42B", "Y444", "Y41B", "YUV9",
                                         "YVU9", "NV12", "NV21", "NV16", "NV61", "NV24", "A420"),
                         [](const auto& info) { return std::string(info.param); });

struct OddCase {
  int width;
  int height;
  int padding;
  int offset;
};

class FrameLayout : public testing::TestWithParam<OddCase> {};

// Feature: any stride and offset
// Feature: planar YUV without a copy
TEST_P(FrameLayout, IsReadInPlaceAndNotModified) {
  const auto [width, height, padding, offset] = GetParam();
  const Pair pair = noise_pair(width, height, 3, 9);
  const auto expected = library_map(pair, small_range(), 256);
  for (const std::uint8_t poison : {0, 255}) {
    for (const char* format : {"GRAY8", "I420"}) {
      const Layout layout{format, padding, offset, poison};
      StereoHarness harness;
      harness.caps(raw_caps(format, width, height));
      GstBuffer* left = frame_buffer(pair.left, 0, kFrame, layout);
      GstBuffer* right = frame_buffer(pair.right, 0, kFrame, layout);
      const BufferPointer untouched_left(gst_buffer_copy_deep(left));
      const BufferPointer untouched_right(gst_buffer_copy_deep(right));
      const BufferPointer left_keeper(gst_buffer_ref(left));
      const BufferPointer right_keeper(gst_buffer_ref(right));
      harness.push(Side::kLeft, left);
      harness.push(Side::kRight, right);
      const BufferPointer map = harness.pull();
      ASSERT_TRUE(map) << harness.error(1).text;
      EXPECT_EQ(first_difference(expected, map_of(map.get(), width, height), width), "")
          << format << " poison " << int{poison};
      for (const auto& [used, original] : {std::pair(left_keeper.get(), untouched_left.get()),
                                           std::pair(right_keeper.get(), untouched_right.get())}) {
        GstMapInfo bytes;
        ASSERT_TRUE(gst_buffer_map(original, &bytes, GST_MAP_READ));
        EXPECT_EQ(gst_buffer_memcmp(used, 0, bytes.data, bytes.size), 0) << "an input was modified";
        gst_buffer_unmap(original, &bytes);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, FrameLayout,
                         testing::Values(OddCase{64, 48, 0, 0}, OddCase{64, 48, 13, 0},
                                         OddCase{64, 48, 0, 37}, OddCase{61, 47, 3, 5},
                                         OddCase{33, 17, 1, 1}, OddCase{17, 1, 7, 0}));

/// Answers an allocation query with a pool whose rows have padding, and stores the pool.
GstPadProbeReturn offer_padded_pool(GstPad*, GstPadProbeInfo* probe, gpointer stored) noexcept {
  GstQuery* query = GST_PAD_PROBE_INFO_QUERY(probe);
  if (GST_QUERY_TYPE(query) != GST_QUERY_ALLOCATION) return GST_PAD_PROBE_OK;
  GstCaps* caps = nullptr;
  gst_query_parse_allocation(query, &caps, nullptr);
  GstVideoInfo info;
  gst_video_info_from_caps(&info, caps);
  GstVideoAlignment alignment;
  gst_video_alignment_reset(&alignment);
  alignment.padding_right = 11;
  alignment.padding_top = 3;
  GstBufferPool* pool = gst_video_buffer_pool_new();
  GstStructure* config = gst_buffer_pool_get_config(pool);
  gst_buffer_pool_config_set_params(config, caps, static_cast<guint>(info.size), 2, 0);
  gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_META);
  gst_buffer_pool_config_add_option(config, GST_BUFFER_POOL_OPTION_VIDEO_ALIGNMENT);
  gst_buffer_pool_config_set_video_alignment(config, &alignment);
  EXPECT_TRUE(gst_buffer_pool_set_config(pool, config));
  gst_query_add_allocation_pool(query, pool, static_cast<guint>(info.size), 2, 0);
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr);
  *static_cast<GstBufferPool**>(stored) = pool;
  gst_object_unref(pool);  // the query holds it, later the element
  return GST_PAD_PROBE_HANDLED;
}

// Feature: buffer pools of downstream
TEST(Output, UsesThePoolAndTheStrideOfDownstream) {
  const Pair pair = noise_pair(61, 47, 3, 10);
  GstBufferPool* pool = nullptr;
  StereoHarness harness;
  gst_pad_add_probe(harness.output()->sinkpad, GST_PAD_PROBE_TYPE_QUERY_DOWNSTREAM,
                    offer_padded_pool, &pool, nullptr);
  harness.caps(raw_caps("GRAY8", 61, 47));
  harness.push_pair(pair, 0);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  const GstVideoMeta* meta = gst_buffer_get_video_meta(map.get());
  ASSERT_NE(meta, nullptr);
  EXPECT_EQ(map->pool, pool);
  EXPECT_GE(meta->stride[0], 2 * (61 + 11));
  EXPECT_GT(meta->offset[0], 0u);
  EXPECT_EQ(first_difference(library_map(pair, small_range(), 256), map_of(map.get(), 61, 47), 61),
            "");
}

/// Answers an allocation query with an allocator that aligns memory to 128 bytes.
GstPadProbeReturn offer_alignment(GstPad*, GstPadProbeInfo* probe, gpointer) noexcept {
  GstQuery* query = GST_PAD_PROBE_INFO_QUERY(probe);
  if (GST_QUERY_TYPE(query) != GST_QUERY_ALLOCATION) return GST_PAD_PROBE_OK;
  GstAllocationParams parameters;
  gst_allocation_params_init(&parameters);
  parameters.align = 127;
  gst_query_add_allocation_param(query, nullptr, &parameters);
  return GST_PAD_PROBE_HANDLED;
}

// Feature: buffer pools of downstream
TEST(Output, HasTheMemoryAlignmentOfDownstream) {
  StereoHarness harness;
  gst_pad_add_probe(harness.output()->sinkpad, GST_PAD_PROBE_TYPE_QUERY_DOWNSTREAM, offer_alignment,
                    nullptr, nullptr);
  harness.caps(raw_caps("GRAY8", 61, 47));
  harness.push_pair(noise_pair(61, 47, 3, 10), 0);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_GE(gst_buffer_peek_memory(map.get(), 0)->align, 127u);
}

// Feature: any stride and offset
TEST(Input, ProposesVideoMetaSoThatNoFrameIsCopied) {
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(noise_pair(64, 48, 3, 11), 0);
  ASSERT_TRUE(harness.pull());
  const CapsPointer caps(gst_caps_from_string(raw_caps("GRAY8", 64, 48).c_str()));
  for (const char* name : {"sink_left", "sink_right"}) {
    GstPad* pad = gst_element_get_static_pad(harness.element(), name);
    GstQuery* query = gst_query_new_allocation(caps.get(), TRUE);
    EXPECT_TRUE(gst_pad_query(pad, query)) << name;
    EXPECT_TRUE(gst_query_find_allocation_meta(query, GST_VIDEO_META_API_TYPE, nullptr)) << name;
    gst_query_unref(query);
    gst_object_unref(pad);
  }
}

TEST(Input, CapsPreferTheSizeOfTheOtherStream) {
  StereoHarness harness;
  harness.caps(Side::kLeft, raw_caps("NV12", 200, 100));
  GstPad* pad = gst_element_get_static_pad(harness.element(), "sink_right");
  CapsPointer caps(gst_pad_query_caps(pad, nullptr));
  caps.reset(gst_caps_fixate(caps.release()));
  gst_object_unref(pad);
  GstVideoInfo info;
  ASSERT_TRUE(gst_video_info_from_caps(&info, caps.get()));
  EXPECT_EQ(info.width, 200);
  EXPECT_EQ(info.height, 100);
  EXPECT_EQ(GST_VIDEO_INFO_FORMAT(&info), GST_VIDEO_FORMAT_GRAY8);
}

TEST(Input, CapsRestrictTheSizeToThatOfDownstream) {
  StereoHarness harness;
  gst_harness_set_sink_caps_str(harness.output(), "video/x-raw,width=320,height=200");
  for (const char* name : {"sink_left", "sink_right"}) {
    GstPad* pad = gst_element_get_static_pad(harness.element(), name);
    const CapsPointer caps(gst_pad_query_caps(pad, nullptr));
    gst_object_unref(pad);
    const CapsPointer fits(gst_caps_from_string(raw_caps("GRAY8", 320, 200).c_str()));
    const CapsPointer other(gst_caps_from_string(raw_caps("GRAY8", 321, 200).c_str()));
    EXPECT_TRUE(gst_caps_can_intersect(caps.get(), fits.get())) << name;
    EXPECT_FALSE(gst_caps_can_intersect(caps.get(), other.get())) << name;
  }
}

}  // namespace
}  // namespace mtstereo::test::format_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "cameras/splitter.hpp"
#include "support/pipeline.hpp"

namespace mtstereo::test::mtsplit_test {
namespace {

/// The bytes of all planes of a frame, without padding.
std::vector<std::uint8_t> bytes_of(const GstVideoFrame& frame) {
  std::vector<std::uint8_t> bytes;
  for (guint p = 0; p < GST_VIDEO_FRAME_N_PLANES(&frame); ++p) {
    int row = 0;
    int rows = 0;
    for (guint c = 0; c < GST_VIDEO_FRAME_N_COMPONENTS(&frame); ++c) {
      if (static_cast<guint>(GST_VIDEO_FRAME_COMP_PLANE(&frame, c)) != p) continue;
      row = std::max(
          row, GST_VIDEO_FRAME_COMP_WIDTH(&frame, c) * GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, c));
      rows = std::max(rows, GST_VIDEO_FRAME_COMP_HEIGHT(&frame, c));
    }
    for (int y = 0; y < rows; ++y) {
      const auto* from = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, p)) +
                         static_cast<gssize>(y) * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, p);
      bytes.insert(bytes.end(), from, from + row);
    }
  }
  return bytes;
}

struct MappedBytes {
  std::vector<std::uint8_t> bytes;
  const guint8* first = nullptr;  ///< address of the first plane
};

MappedBytes read(GstBuffer* buffer, const GstCaps* caps) {
  MappedBytes result;
  GstVideoInfo info;
  GstVideoFrame frame;
  if (buffer == nullptr || caps == nullptr || !gst_video_info_from_caps(&info, caps) ||
      !gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ)) {
    ADD_FAILURE() << "no frame";
    return result;
  }
  result.bytes = bytes_of(frame);
  result.first = static_cast<const guint8*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0));
  gst_video_frame_unmap(&frame);
  return result;
}

/// The bytes of a part by GStreamer's own copy of a cropped frame.
std::vector<std::uint8_t> cropped(GstBuffer* whole, const GstVideoInfo& info, int x, int y,
                                  int width, int height) {
  GstVideoInfo copy = info;
  GstVideoFrame frame;
  EXPECT_TRUE(gst_video_frame_map(&frame, &copy, whole, GST_MAP_READ));
  GstVideoFrame part = frame;
  for (guint c = 0; c < GST_VIDEO_FRAME_N_COMPONENTS(&frame); ++c) {
    const auto plane = static_cast<guint>(GST_VIDEO_FRAME_COMP_PLANE(&frame, c));
    const int column = x >> GST_VIDEO_FORMAT_INFO_W_SUB(info.finfo, c);
    const int row = y >> GST_VIDEO_FORMAT_INFO_H_SUB(info.finfo, c);
    part.data[plane] = static_cast<guint8*>(frame.data[plane]) +
                       row * GST_VIDEO_FRAME_PLANE_STRIDE(&frame, plane) +
                       column * GST_VIDEO_FRAME_COMP_PSTRIDE(&frame, c);
  }
  part.info.width = width;
  part.info.height = height;
  auto bytes = bytes_of(part);
  gst_video_frame_unmap(&frame);
  return bytes;
}

GstBuffer* random_frame(const GstVideoInfo& info, unsigned seed) {
  const GrayImage noise = noise_pair(static_cast<int>(info.size), 1, 0, seed).left;
  return gst_buffer_new_memdup(noise.pixels.data(), info.size);
}

struct Case {
  const char* format;
  bool side_by_side;
  int width;  ///< of the whole frame
  int height;
};

class Formats : public testing::TestWithParam<Case> {};

// Feature: side-by-side and top-bottom streams
TEST_P(Formats, HalvesAreThoseOfTheFrameAndNoPixelIsCopied) {
  const Case c = GetParam();
  for (const bool swap : {false, true}) {
    Splitter splitter(std::string("layout=") + (c.side_by_side ? "side-by-side" : "top-bottom") +
                      (swap ? " swap=true" : ""));
    splitter.input().caps(raw_caps(c.format, c.width, c.height));
    GstVideoInfo info;
    gst_video_info_set_format(&info, gst_video_format_from_string(c.format),
                              static_cast<guint>(c.width), static_cast<guint>(c.height));
    const BufferPointer frame(random_frame(info, 3));
    GST_BUFFER_PTS(frame.get()) = 5 * kFrame;
    GST_BUFFER_DURATION(frame.get()) = kFrame;
    ASSERT_EQ(splitter.input().push(gst_buffer_ref(frame.get())), GST_FLOW_OK);
    GstMapInfo map;
    gst_buffer_map(frame.get(), &map, GST_MAP_READ);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const bool second = (side == Side::kRight) != swap;
      const int width = c.side_by_side ? c.width / 2 : c.width;
      const int height = c.side_by_side ? c.height : c.height / 2;
      const BufferPointer half = splitter.pull(side);
      const CapsPointer caps = splitter.caps(side);
      const MappedBytes found = read(half.get(), caps.get());
      EXPECT_EQ(found.bytes, cropped(frame.get(), info, second && c.side_by_side ? width : 0,
                                     second && !c.side_by_side ? height : 0, width, height));
      EXPECT_GE(found.first, map.data);
      EXPECT_LT(found.first, map.data + map.size);
      EXPECT_EQ(GST_BUFFER_PTS(half.get()), 5 * kFrame);
      EXPECT_EQ(GST_BUFFER_DURATION(half.get()), kFrame);
    }
    gst_buffer_unmap(frame.get(), &map);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Formats,
                         testing::Values(Case{"GRAY8", true, 62, 33}, Case{"GRAY8", false, 31, 34},
                                         Case{"I420", true, 64, 30}, Case{"I420", false, 30, 64},
                                         Case{"NV12", true, 68, 22}, Case{"NV12", false, 22, 68},
                                         Case{"YUY2", true, 44, 21}, Case{"YUY2", false, 22, 42},
                                         Case{"UYVY", true, 40, 9}, Case{"RGB", true, 38, 11},
                                         Case{"RGB", false, 19, 22}, Case{"BGRx", true, 18, 5},
                                         Case{"GRAY16_LE", true, 34, 7}, Case{"Y444", true, 26, 9},
                                         Case{"Y42B", false, 26, 18},
                                         Case{"P010_10LE", true, 24, 10}));

TEST(MtSplit, ReadsPaddingAndOffset) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  const Pair pair = noise_pair(64, 48, 3, 5);
  const Layout layout{.format = "GRAY8", .padding = 9, .offset = 5, .poison = 0xAB};
  ASSERT_EQ(splitter.input().push(frame_buffer(pair.left, 0, kFrame, layout)), GST_FLOW_OK);
  const MappedBytes right =
      read(splitter.pull(Side::kRight).get(), splitter.caps(Side::kRight).get());
  for (std::size_t i = 0; i < right.bytes.size(); ++i) {
    ASSERT_EQ(right.bytes[i], pair.left.pixels[i / 32 * 64 + 32 + i % 32]);
  }
}

TEST(MtSplit, CopiesForConsumersThatReadNoVideoMeta) {
  Splitter splitter("", false);
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  ASSERT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
  const BufferPointer right = splitter.pull(Side::kRight);
  EXPECT_EQ(gst_buffer_get_video_meta(right.get()), nullptr);
  GstMapInfo map;
  gst_buffer_map(right.get(), &map, GST_MAP_READ);
  ASSERT_EQ(map.size, 32u * 48);
  for (std::size_t i = 0; i < map.size; ++i) {
    ASSERT_EQ(map.data[i], image.pixels[i / 32 * 64 + 32 + i % 32]);
  }
  gst_buffer_unmap(right.get(), &map);
}

TEST(MtSplit, CopiesForAConsumerThatTakesThePlaceOfAnother) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  ASSERT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
  EXPECT_NE(gst_buffer_get_video_meta(splitter.pull(Side::kRight).get()), nullptr);
  GstHarness* right = splitter.side(Side::kRight);
  gst_pad_set_query_function(
      right->sinkpad, +[](GstPad*, GstObject*, GstQuery*) { return FALSE; });
  gst_harness_push_upstream_event(right, gst_event_new_reconfigure());
  ASSERT_EQ(splitter.input().push(frame_buffer(image, kFrame, kFrame)), GST_FLOW_OK);
  EXPECT_EQ(gst_buffer_get_video_meta(splitter.pull(Side::kRight).get()), nullptr);
}

TEST(MtSplit, HalvesHaveTheTimesAndFlagsOfTheFrame) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  GstBuffer* frame = frame_buffer(noise_pair(64, 48, 0, 5).left, 7 * kFrame, kFrame);
  GST_BUFFER_FLAG_SET(frame, GST_BUFFER_FLAG_DISCONT | GST_BUFFER_FLAG_CORRUPTED);
  ASSERT_EQ(splitter.input().push(frame), GST_FLOW_OK);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const BufferPointer half = splitter.pull(side);
    EXPECT_EQ(GST_BUFFER_PTS(half.get()), 7 * kFrame);
    EXPECT_EQ(GST_BUFFER_DURATION(half.get()), kFrame);
    EXPECT_TRUE(GST_BUFFER_IS_DISCONT(half.get()));
    EXPECT_TRUE(GST_BUFFER_FLAG_IS_SET(half.get(), GST_BUFFER_FLAG_CORRUPTED));
  }
}

TEST(MtSplit, AWriterDoesNotChangeTheOtherHalf) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  ASSERT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
  BufferPointer left = splitter.pull(Side::kLeft);
  const BufferPointer right = splitter.pull(Side::kRight);
  const CapsPointer caps = splitter.caps(Side::kRight);
  const auto before = read(right.get(), caps.get()).bytes;
  left.reset(gst_buffer_make_writable(left.release()));
  gst_buffer_memset(left.get(), 0, 0, gst_buffer_get_size(left.get()));
  EXPECT_EQ(read(left.get(), caps.get()).bytes, std::vector<std::uint8_t>(32 * 48, 0));
  EXPECT_EQ(read(right.get(), caps.get()).bytes, before);
}

TEST(MtSplit, FramesReturnToTheirPool) {
  Splitter splitter;
  splitter.input().caps(raw_caps("I420", 64, 48));
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_I420, 64, 48);
  GstBufferPool* pool = gst_video_buffer_pool_new();
  const CapsPointer caps(gst_video_info_to_caps(&info));
  GstStructure* config = gst_buffer_pool_get_config(pool);
  gst_buffer_pool_config_set_params(config, caps.get(), static_cast<guint>(info.size), 0, 0);
  gst_buffer_pool_set_config(pool, config);
  gst_buffer_pool_set_active(pool, TRUE);
  std::set<GstMemory*> memories;
  for (int i = 0; i < 20; ++i) {
    GstBuffer* frame = nullptr;
    gst_buffer_pool_acquire_buffer(pool, &frame, nullptr);
    memories.insert(gst_buffer_peek_memory(frame, 0));
    ASSERT_EQ(splitter.input().push(frame), GST_FLOW_OK);
    splitter.pull(Side::kRight);
    splitter.pull(Side::kLeft);
  }
  EXPECT_EQ(memories.size(), 1u);
  gst_buffer_pool_set_active(pool, FALSE);
  gst_object_unref(pool);
}

TEST(MtSplit, HalvesThatAreNotWholeAreErrors) {
  for (const auto& [properties, caps, word] :
       {std::tuple("", raw_caps("GRAY8", 641, 480), "width must be even"),
        std::tuple("layout=top-bottom", raw_caps("GRAY8", 640, 481), "height must be even"),
        std::tuple("", raw_caps("I420", 642, 480), "-pix_fmt gray"),
        std::tuple("layout=top-bottom", raw_caps("NV12", 640, 482), "format=GRAY8"),
        std::tuple("", raw_caps("YUY2", 642, 480), "format=GRAY8")}) {
    Splitter splitter(properties);
    splitter.input().caps(caps);
    GstVideoInfo info;
    const CapsPointer parsed(gst_caps_from_string(caps.c_str()));
    gst_video_info_from_caps(&info, parsed.get());
    EXPECT_NE(splitter.input().push(gst_buffer_new_allocate(nullptr, info.size, nullptr)),
              GST_FLOW_OK);
    const std::string text = splitter.input().error();
    EXPECT_NE(text.find(word), std::string::npos) << caps << ": " << text;
  }
}

TEST(MtSplit, FrameThatIsTooSmallIsAnError) {
  Splitter splitter;
  splitter.input().caps(raw_caps("I420", 64, 48));
  EXPECT_EQ(splitter.input().push(gst_buffer_new_allocate(nullptr, 64 * 48, nullptr)),
            GST_FLOW_ERROR);
  EXPECT_NE(splitter.input().error().find("bytes"), std::string::npos);
}

TEST(MtSplit, SizeOfAHalfIsNegotiatedWithUpstream) {
  Pipeline pipeline(
      "videotestsrc num-buffers=2 ! mtsplit name=s "
      "s.left ! queue ! video/x-raw,format=GRAY8,width=160,height=100 ! appsink name=out "
      "wait-on-eos=false sync=false "
      "s.right ! queue ! fakesink");
  EXPECT_EQ(pipeline.run(), "");
  const auto samples = pipeline.samples();
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_NE(samples[0].caps.find("width=(int)160, height=(int)100"), std::string::npos);
}

TEST(MtSplit, OddWidthInAPipelineIsAClearError) {
  Pipeline pipeline(
      "videotestsrc num-buffers=2 ! video/x-raw,width=321 ! mtsplit name=s s.left ! queue ! "
      "fakesink "
      "s.right ! queue ! fakesink");
  EXPECT_NE(pipeline.run().find("width must be even"), std::string::npos);
}

// Feature: side-by-side and top-bottom streams
TEST(MtSplit, MatcherTakesBothViewsWithoutQueues) {
  for (const char* format : {"GRAY8", "NV12", "YUY2"}) {
    Pipeline pipeline(
        std::string("videotestsrc num-buffers=5 ! video/x-raw,format=") + format +
        ",width=320,height=100 ! mtsplit name=s s.left ! m.sink_left s.right ! "
        "m.sink_right mtstereo name=m max-disparity=16 ! appsink name=out wait-on-eos=false "
        "sync=false");
    EXPECT_EQ(pipeline.run(), "");
    EXPECT_EQ(pipeline.samples().size(), 5u);
  }
}

TEST(MtSplit, LayoutAndSwapChangeBetweenFrames) {
  Splitter splitter;
  splitter.input().caps(raw_caps("GRAY8", 64, 48));
  const GrayImage image = noise_pair(64, 48, 0, 5).left;
  ASSERT_EQ(splitter.input().push(frame_buffer(image, 0, kFrame)), GST_FLOW_OK);
  splitter.pull(Side::kLeft);
  splitter.pull(Side::kRight);
  gst_util_set_object_arg(G_OBJECT(splitter.input().element()), "layout", "top-bottom");
  g_object_set(splitter.input().element(), "swap", TRUE, nullptr);
  ASSERT_EQ(splitter.input().push(frame_buffer(image, kFrame, kFrame)), GST_FLOW_OK);
  const MappedBytes left = read(splitter.pull(Side::kLeft).get(), splitter.caps(Side::kLeft).get());
  EXPECT_EQ(left.bytes,
            std::vector<std::uint8_t>(image.pixels.begin() + 64 * 24, image.pixels.end()));
}

}  // namespace
}  // namespace mtstereo::test::mtsplit_test

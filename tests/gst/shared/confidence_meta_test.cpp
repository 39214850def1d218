// SPDX-License-Identifier: LGPL-2.1-or-later
// The meta alone: what happens to it when a buffer is copied or transformed.
#include "shared/confidence_meta.hpp"

#include <gtest/gtest.h>

#include <set>
#include <thread>
#include <vector>

#include "shared/confidence_pool.hpp"
#include "support/stereo_harness.hpp"

namespace mtstereo::test::confidence_meta_test {
namespace {

constexpr gsize kBytes = 8 * 6 * 2;

GstVideoInfo disparity_info(guint width, guint height) {
  GstVideoInfo info;
  gst_video_info_set_format(&info, GST_VIDEO_FORMAT_GRAY16_LE, width, height);
  return info;
}

class ConfidenceMeta : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(plugin::register_confidence_meta());
    ASSERT_TRUE(pool.fit(disparity_info(8, 6)));
    buffer = disparity(3);
  }

  /// A disparity map with this confidence at every pixel.
  BufferPointer disparity(int value) {
    BufferPointer map(gst_buffer_new_allocate(nullptr, kBytes, nullptr));
    plugin::BufferPointer confidence = pool.acquire();
    gst_buffer_memset(confidence.get(), 0, static_cast<guint8>(value), pool.info().size);
    const plugin::SamplePointer sample = pool.finish(std::move(confidence), map.get());
    plugin::set_confidence(map.get(), sample.get());
    return map;
  }

  /// A buffer to which the transform function of the meta has been applied.
  BufferPointer transformed(const char* type, gpointer data) {
    BufferPointer to(gst_buffer_new_allocate(nullptr, kBytes, nullptr));
    GstMeta* meta = reinterpret_cast<GstMeta*>(
        gst_buffer_get_custom_meta(buffer.get(), plugin::kConfidenceMeta));
    meta->info->transform_func(to.get(), meta, buffer.get(), g_quark_from_string(type), data);
    return to;
  }

  plugin::ConfidencePool pool;
  BufferPointer buffer;
};

// Feature: metas of the left frame are kept, and own metas can be read without headers
TEST_F(ConfidenceMeta, IsRegisteredOnceByTheFirstCaller) {
  std::vector<std::thread> threads;
  std::vector<int> results(8, 0);
  for (int& result : results) {
    threads.emplace_back([&result] { result = plugin::register_confidence_meta() ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(results, std::vector<int>(8, 1));
  // The plugin, which has its own registration code, uses the existing registration.
  GstElement* element = make_element("");
  ASSERT_NE(element, nullptr);
  gst_object_unref(element);
}

TEST_F(ConfidenceMeta, IsNotAttachedByDefault) {
  const BufferPointer other(gst_buffer_new());
  EXPECT_EQ(plugin::confidence_of(other.get()), nullptr);
  EXPECT_TRUE(confidence_of(other.get()).empty());
}

TEST_F(ConfidenceMeta, TheLastOneReplacesTheOthers) {
  const BufferPointer other = disparity(7);
  plugin::set_confidence(buffer.get(), plugin::confidence_of(other.get()));
  EXPECT_EQ(gst_buffer_get_n_meta(buffer.get(), g_type_from_name("MtStereoConfidenceMeta-api")),
            1u);
  EXPECT_EQ(confidence_of(buffer.get()), std::vector<std::uint8_t>(48, 7));
}

TEST_F(ConfidenceMeta, CopiesShareTheMap) {
  const BufferPointer copy(gst_buffer_copy(buffer.get()));
  const BufferPointer deep(gst_buffer_copy_deep(buffer.get()));
  EXPECT_EQ(plugin::confidence_of(copy.get()), plugin::confidence_of(buffer.get()));
  EXPECT_EQ(confidence_of(deep.get()), std::vector<std::uint8_t>(48, 3));
}

TEST_F(ConfidenceMeta, CopiesKeepTheMapAfterTheOriginalIsFreed) {
  const BufferPointer copy(gst_buffer_copy(buffer.get()));
  buffer.reset();
  const BufferPointer next = disparity(9);
  EXPECT_EQ(confidence_of(copy.get()), std::vector<std::uint8_t>(48, 3));
}

TEST_F(ConfidenceMeta, IsNotCopiedToAPartOfTheBuffer) {
  const BufferPointer part(
      gst_buffer_copy_region(buffer.get(), GST_BUFFER_COPY_ALL, 16, kBytes - 16));
  EXPECT_TRUE(confidence_of(part.get()).empty());
}

TEST_F(ConfidenceMeta, IsKeptIfOnlyTheFormatChanges) {
  GstVideoInfo from = disparity_info(8, 6);
  GstVideoInfo to = disparity_info(8, 6);
  GstVideoMetaTransform same = {&from, &to};
  EXPECT_FALSE(confidence_of(transformed("gst-video-scale", &same).get()).empty());
}

TEST_F(ConfidenceMeta, IsRemovedByASizeChangeOrAnUnknownChange) {
  GstVideoInfo from = disparity_info(8, 6);
  for (const auto& [width, height] : {std::pair(16u, 6u), {8u, 12u}, {4u, 3u}}) {
    GstVideoInfo to = disparity_info(width, height);
    GstVideoMetaTransform scale = {&from, &to};
    EXPECT_TRUE(confidence_of(transformed("gst-video-scale", &scale).get()).empty());
  }
  EXPECT_TRUE(confidence_of(transformed("some-other-change", nullptr).get()).empty());
}

TEST_F(ConfidenceMeta, IsIgnoredAndNotCopiedWithoutItsField) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(buffer.get(), plugin::kConfidenceMeta);
  GstStructure* structure = gst_custom_meta_get_structure(meta);
  gst_structure_remove_field(structure, "confidence");
  EXPECT_EQ(plugin::confidence_of(buffer.get()), nullptr);
  const BufferPointer copy(gst_buffer_copy(buffer.get()));
  EXPECT_EQ(gst_buffer_get_custom_meta(copy.get(), plugin::kConfidenceMeta), nullptr);
  gst_structure_set(structure, "confidence", G_TYPE_STRING, "high", nullptr);
  EXPECT_EQ(plugin::confidence_of(buffer.get()), nullptr);
}

TEST_F(ConfidenceMeta, IsReadOnly) {
  const plugin::SamplePointer held(gst_sample_ref(plugin::confidence_of(buffer.get())));
  EXPECT_FALSE(gst_buffer_is_writable(gst_sample_get_buffer(held.get())));
}

class ConfidenceMemory : public ConfidenceMeta {
 protected:
  static const void* memory(GstBuffer* disparity) {
    return gst_buffer_peek_memory(gst_sample_get_buffer(plugin::confidence_of(disparity)), 0);
  }
};

TEST_F(ConfidenceMemory, IsReusedAfterTheLastReference) {
  buffer.reset();
  std::set<const void*> places;
  for (int i = 0; i < 50; ++i) places.insert(memory(disparity(i).get()));
  EXPECT_EQ(places.size(), 1u);
}

TEST_F(ConfidenceMemory, IsNotReusedWhileACopyRefersToIt) {
  const BufferPointer copy(gst_buffer_copy(buffer.get()));
  const void* held = memory(buffer.get());
  buffer.reset();
  for (int i = 0; i < 5; ++i) EXPECT_NE(memory(disparity(i).get()), held);
}

TEST_F(ConfidenceMemory, OutlivesThePool) {
  pool.clear();
  EXPECT_EQ(confidence_of(buffer.get()), std::vector<std::uint8_t>(48, 3));
}

TEST_F(ConfidenceMemory, IsKeptWhileTheStreamIsUnchanged) {
  const void* before = memory(buffer.get());
  buffer.reset();
  ASSERT_TRUE(pool.fit(disparity_info(8, 6)));
  EXPECT_EQ(memory(disparity(1).get()), before);
  ASSERT_TRUE(pool.fit(disparity_info(9, 6)));
  EXPECT_EQ(pool.info().width, 9);
}

}  // namespace
}  // namespace mtstereo::test::confidence_meta_test

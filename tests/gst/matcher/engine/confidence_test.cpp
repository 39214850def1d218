// SPDX-License-Identifier: LGPL-2.1-or-later
// The confidence map of the disparity maps of mtstereo.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/stereo_harness.hpp"

namespace mtstereo::test::confidence_test {
namespace {

constexpr const char* kMeta = "MtStereoConfidenceMeta";

Parameters parameters() {
  Parameters result;
  EXPECT_TRUE(result.set(Parameter::kMaxDisparity, 16).ok());
  return result;
}

void expect_library_confidence(GstBuffer* map, const Pair& pair) {
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(library_confidence(pair, parameters()), confidence_of(map));
}

/// The sample in the meta; the buffer owns it.
GstSample* sample_of(GstBuffer* map) {
  GstCustomMeta* meta = gst_buffer_get_custom_meta(map, kMeta);
  if (meta == nullptr) return nullptr;
  return gst_value_get_sample(
      gst_structure_get_value(gst_custom_meta_get_structure(meta), "confidence"));
}

class ConfidenceSize : public testing::TestWithParam<std::pair<int, int>> {};

// Feature: confidence for each pixel
// Feature: odd sizes
TEST_P(ConfidenceSize, EqualsThatOfTheLibrary) {
  const auto [width, height] = GetParam();
  const Pair pair = noise_pair(width, height, 4, 1);
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", width, height));
  harness.push_pair(pair, 0);
  const BufferPointer map = harness.pull();
  expect_library_confidence(map.get(), pair);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ConfidenceSize,
                         testing::Values(std::pair(64, 48), std::pair(97, 31), std::pair(65, 1),
                                         std::pair(130, 67)),
                         [](const auto& info) {
                           return std::to_string(info.param.first) + "x" +
                                  std::to_string(info.param.second);
                         });

TEST(Confidence, EqualsThatOfTheLibraryForPaddedFrames) {
  const Pair pair = noise_pair(67, 49, 4, 2);
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 67, 49), raw_caps("I420", 67, 49));
  harness.push_pair(pair, 0, {.padding = 29, .offset = 3, .poison = 0xEE},
                    {.format = "I420", .padding = 5, .poison = 0xEE});
  const BufferPointer map = harness.pull();
  expect_library_confidence(map.get(), pair);
}

// Feature: 0 marks unknown
TEST(Confidence, IsZeroExactlyWithoutADisparity) {
  const Pair pair = noise_pair(97, 61, 4, 3);
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 97, 61));
  harness.push_pair(pair, 0);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  const auto disparity = map_of(map.get(), 97, 61);
  const auto confidence = confidence_of(map.get());
  ASSERT_EQ(confidence.size(), disparity.size());
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    ASSERT_EQ(confidence[i] == 0, disparity[i] == 0) << i;
  }
  EXPECT_TRUE(std::ranges::any_of(confidence, [](int value) { return value > 0; }));
}

TEST(Confidence, HasTheCapsAndTimesOfItsDisparityMap) {
  StereoHarness harness;
  const std::string caps =
      raw_caps("GRAY8", 66, 48, "25/2") + ",pixel-aspect-ratio=4/3";  // 66: rows are padded
  harness.caps(caps);
  harness.push_pair(noise_pair(66, 48, 4, 4), 7 * kFrame);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  GstSample* sample = sample_of(map.get());
  ASSERT_NE(sample, nullptr);
  const CapsPointer expected(gst_caps_from_string(caps.c_str()));
  EXPECT_TRUE(gst_caps_is_subset(gst_sample_get_caps(sample), expected.get()));
  GstBuffer* confidence = gst_sample_get_buffer(sample);
  EXPECT_EQ(GST_BUFFER_PTS(confidence), 7 * kFrame);
  EXPECT_EQ(GST_BUFFER_DURATION(confidence), kFrame);
  EXPECT_EQ(gst_buffer_get_size(confidence), 68u * 48) << "the stride is that of the caps";
}

TEST(Confidence, IsNotAttachedIfDisabled) {
  StereoHarness harness("max-disparity=16 confidence-map=false");
  harness.caps(raw_caps("GRAY8", 64, 48));
  harness.push_pair(noise_pair(64, 48, 4, 5), 0);
  const BufferPointer map = harness.pull();
  ASSERT_TRUE(map);
  EXPECT_EQ(gst_buffer_get_custom_meta(map.get(), kMeta), nullptr);
  EXPECT_TRUE(confidence_of(map.get()).empty());
}

TEST(Confidence, CanBeEnabledAndDisabledWhilePlaying) {
  const Pair pair = noise_pair(64, 48, 4, 6);
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 64, 48));
  for (int i = 0; i < 6; ++i) {
    const bool on = i % 2 == 0;
    g_object_set(harness.element(), "confidence-map", on, nullptr);
    harness.push_pair(pair, static_cast<GstClockTime>(i) * kFrame);
    const BufferPointer map = harness.pull();
    ASSERT_TRUE(map) << i;
    EXPECT_EQ(!confidence_of(map.get()).empty(), on) << i;
    EXPECT_EQ(first_difference(library_map(pair, parameters(), 256), map_of(map.get(), 64, 48), 64),
              "");
  }
}

TEST(Confidence, OfMapsInUseIsNotOverwritten) {
  StereoHarness harness;
  harness.caps(raw_caps("GRAY8", 65, 47));
  std::vector<Pair> pairs;
  std::vector<BufferPointer> held;
  for (unsigned i = 0; i < 6; ++i) {
    pairs.push_back(noise_pair(65, 47, 3 + static_cast<int>(i), 10 + i));
    harness.push_pair(pairs.back(), i * kFrame);
    held.push_back(harness.pull());
  }
  EXPECT_NE(confidence_of(held[0].get()), confidence_of(held[1].get()));
  for (std::size_t i = 0; i < pairs.size(); ++i) expect_library_confidence(held[i].get(), pairs[i]);
}

TEST(Confidence, FollowsSizeChangesAndKeepsEarlierMaps) {
  StereoHarness harness;
  std::vector<Pair> pairs;
  std::vector<BufferPointer> held;
  GstClockTime time = 0;
  for (const auto& [width, height] : {std::pair(64, 48), {97, 31}, {33, 70}, {64, 48}}) {
    harness.caps(raw_caps("GRAY8", width, height));
    for (int i = 0; i < 2; ++i, time += kFrame) {
      pairs.push_back(noise_pair(width, height, 4, static_cast<unsigned>(pairs.size())));
      harness.push_pair(pairs.back(), time);
      held.push_back(harness.pull());
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) expect_library_confidence(held[i].get(), pairs[i]);
}

TEST(Confidence, OutlivesTheElement) {
  const Pair pair = noise_pair(64, 48, 4, 7);
  BufferPointer map;
  {
    StereoHarness harness;
    harness.caps(raw_caps("GRAY8", 64, 48));
    harness.push_pair(pair, 0);
    map = harness.pull();
  }
  expect_library_confidence(map.get(), pair);
}

TEST(Confidence, OfALeftFrameIsNotCopiedToTheMap) {
  const Pair pair = noise_pair(64, 48, 4, 8);
  for (const bool on : {false, true}) {
    StereoHarness harness(on ? "max-disparity=16" : "max-disparity=16 confidence-map=false");
    harness.caps(raw_caps("GRAY8", 64, 48));
    GstBuffer* left = frame_buffer(pair.left, 0, kFrame);
    ASSERT_NE(gst_buffer_add_custom_meta(left, kMeta), nullptr);
    harness.push(Side::kLeft, left);
    harness.push(Side::kRight, frame_buffer(pair.right, 0, kFrame));
    const BufferPointer map = harness.pull();
    ASSERT_TRUE(map);
    EXPECT_EQ(gst_buffer_get_custom_meta(map.get(), kMeta) != nullptr, on);
    if (on) expect_library_confidence(map.get(), pair);
  }
}

}  // namespace
}  // namespace mtstereo::test::confidence_test

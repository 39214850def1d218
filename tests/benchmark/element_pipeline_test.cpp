// SPDX-License-Identifier: LGPL-2.1-or-later
#include "element_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "outcome.hpp"
#include "support/error_of.hpp"

namespace mtstereo::bench::element_pipeline_test {
namespace {

using test::error_of;

constexpr int kWidth = 130;  // rows are padded
constexpr int kHeight = 60;
constexpr int kDisparities = 16;
constexpr const char* kProperties = "max-disparity=16";

PairList moments(int count) {
  PairList pairs;
  for (int i = 0; i < count; ++i) {
    pairs.push_back(std::make_unique<PairBuffers>(render_street(kWidth, kHeight, 1 + i)));
  }
  return pairs;
}

cv::Mat expected_map(Matcher& matcher, const PairBuffers& pair) {
  const auto result = matcher.compute(pair.left.view(), pair.right.view());
  if (!result) throw std::runtime_error(result.error().message);
  cv::Mat map(kHeight, kWidth, CV_16UC1);
  const Status status = write_disparity16(result->disparity, 256,
                                          {map.ptr<std::uint16_t>(), kWidth, kHeight, kWidth * 2});
  if (!status) throw std::runtime_error(status.error().message);
  return map;
}

TEST(GrayBuffer, HasTheImageInPaddedRows) {
  const Pair pair = render_street(kWidth, kHeight);
  const GrayBuffer buffer(pair.left);
  const GrayView view = buffer.view();
  ASSERT_EQ(kWidth, view.width);
  ASSERT_EQ(kHeight, view.height);
  EXPECT_EQ(132, view.stride);
  for (int y = 0; y < kHeight; ++y) {
    ASSERT_TRUE(std::equal(view.row(y), view.row(y) + kWidth, pair.left.ptr(y))) << y;
  }
}

TEST(GrayBuffer, StampedBuffersShareItsMemory) {
  const GrayBuffer buffer(render_street(kWidth, kHeight).left);
  const BufferPointer stamped = buffer.stamped(3 * GST_SECOND, GST_SECOND);
  EXPECT_EQ(3 * GST_SECOND, GST_BUFFER_PTS(stamped.get()));
  GstMapInfo map;
  ASSERT_TRUE(gst_buffer_map(stamped.get(), &map, GST_MAP_READ));
  EXPECT_EQ(buffer.view().data, map.data);
  gst_buffer_unmap(stamped.get(), &map);
}

TEST(ElementPipeline, ReturnsTheLibrarysMapsInTheOrderOfThePairs) {
  const PairList pairs = moments(3);
  ElementPipeline pipeline(kProperties, kWidth, kHeight);
  const std::vector<cv::Mat> maps = pipeline.maps(pairs);
  ASSERT_EQ(pairs.size(), maps.size());
  Matcher matcher = make_matcher(parameters_of("default", "semi-dense", kDisparities, 1));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    EXPECT_EQ(0, cv::countNonZero(maps[i] != expected_map(matcher, *pairs[i]))) << i;
  }
  EXPECT_GT(cv::countNonZero(maps[0] != maps[1]), 0);
}

TEST(ElementPipeline, ReturnsTheTimesOfAllMapsRepeatedly) {
  const PairList pairs = moments(2);
  ElementPipeline pipeline(kProperties, kWidth, kHeight);
  for (const int count : {5, 1, 3}) {
    const auto times = pipeline.match(pairs, count);
    ASSERT_EQ(static_cast<std::size_t>(count), times.size());
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  }
}

TEST(ElementPipeline, FrameThatTheElementRejectsIsAnErrorAndDoesNotHang) {
  const PairList pairs = moments(1);
  const std::string problem = error_of([&] {
    ElementPipeline pipeline("max-disparity=500", kWidth, kHeight);
    pipeline.match(pairs, 3);
  });
  EXPECT_NE(std::string::npos, problem.find("max-disparity")) << problem;
}

TEST(ElementPipeline, FrameOfAnotherSizeIsAnError) {
  const PairList pairs = moments(1);
  EXPECT_NE("", error_of([&] {
              ElementPipeline pipeline(kProperties, 2 * kWidth, kHeight);
              pipeline.match(pairs, 1);
            }));
}

TEST(ElementPipeline, InvalidPropertiesAreErrorsThatNameThem) {
  for (const std::string property : {"speed=1", "mode=fair", "max-disparity=much"}) {
    const std::string name = property.substr(0, property.find('='));
    const std::string problem = error_of([&] { ElementPipeline(property, kWidth, kHeight); });
    EXPECT_NE(std::string::npos, problem.find(name)) << problem;
    EXPECT_EQ(std::string::npos, problem.find("GST_PLUGIN_PATH")) << problem;
  }
}

}  // namespace
}  // namespace mtstereo::bench::element_pipeline_test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  gst_init(&argc, &argv);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/frame_memory.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "support/matching.hpp"

namespace mtstereo::frame_memory_test {
namespace {

Settings settings_of(std::initializer_list<std::pair<const char*, std::string>> values) {
  return Settings(test::parameters(values));
}

constexpr FrameSize kFull = {{101, 51}, {101, 51}, {101, 51}, 2};
constexpr FrameSize kHalf = {{101, 51}, {101, 51}, {51, 26}, 3};

TEST(FrameMemory, HasTheBuffersOfNodesAndPixels) {
  FrameMemory memory;
  memory.resize(settings_of({{"preset", "paper"}, {"outlier-radius", "0"}}), kFull);
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(101, memory.nodes.preprocessed[side].level.width());
    EXPECT_EQ(101, memory.nodes.preprocessed[side].gray.width());
    EXPECT_EQ(0, memory.views.census[side].bits.height());
    EXPECT_EQ(0, memory.views.halves[side].width());
  }
  EXPECT_EQ(2, memory.nodes.level_count);
  EXPECT_EQ(101, memory.maps.disparity.width());
  EXPECT_EQ(0, memory.nodes.votes.disparity.width());
  EXPECT_EQ(0, memory.result.enlarged.width());
  EXPECT_EQ(2u, memory.views.scratch.size());
  EXPECT_EQ(2u, memory.nodes.scratch.size());
  EXPECT_EQ(2u, memory.costs.scratch.size());
  EXPECT_EQ(2u, memory.maps.scratch.size());
}

TEST(FrameMemory, HoldsRightViewsThatAreWiderThanTheMap) {
  FrameMemory memory;
  memory.resize(settings_of({{"mode", "dense"}, {"min-disparity", "-700"}}),
                {{101, 51}, {801, 51}, {801, 51}, 1});
  EXPECT_GE(memory.buffers.rating.scratch[0].clues.right.size(), 801u);
  EXPECT_EQ(801, memory.views.extended[1].width());
}

TEST(FrameMemory, HasACostVolumeForTheGradientCostOnly) {
  FrameMemory memory;
  memory.resize(settings_of({{"preset", "paper"}}), kFull);
  EXPECT_GT(memory.costs.volume.cells.size(), 0u);
  EXPECT_EQ(0, memory.views.census[0].bits.width());
  EXPECT_EQ(2, memory.nodes.level_count);
  EXPECT_GT(memory.nodes.votes.disparity.width(), 101);
}

TEST(FrameMemory, HasMapsOfBothSizesAtHalfResolution) {
  FrameMemory memory;
  memory.resize(settings_of({{"preset", "fast"}}), kHalf);
  EXPECT_EQ(51, memory.views.halves[1].width());
  EXPECT_EQ(51, memory.maps.disparity.width());
  EXPECT_EQ(101, memory.result.enlarged.width());
  EXPECT_EQ(51, memory.result.refined.width());
  EXPECT_EQ(101, memory.views.input_census[0].bits.width());
  EXPECT_EQ(memory.maps.disparity.height(), memory.views.input_census[0].bits.height());
  EXPECT_EQ(3u, memory.result.scratch.size());
}

TEST(FrameMemory, HasCorrectedViewsForACorrectionOnly) {
  Settings settings = settings_of({{"preset", "fast"}});
  FrameMemory memory;
  memory.resize(settings, kHalf);
  EXPECT_EQ(0, memory.views.aligned.width());
  settings.correction.rows.offset = 1;
  memory.resize(settings, kHalf);
  EXPECT_EQ(101, memory.views.aligned.width());
  EXPECT_EQ(0, memory.views.blurred[1].width());
  settings.correction = {};
  settings.correction.right_blur = 1;
  memory.resize(settings, kHalf);
  EXPECT_EQ(0, memory.views.blurred[0].width());
  EXPECT_EQ(101, memory.views.blurred[1].width());
}

TEST(FrameMemory, KeepsItsBuffersIfNothingLargerIsNeeded) {
  FrameMemory memory;
  memory.resize(settings_of({}), kFull);
  const std::int32_t* map = memory.maps.disparity.row(0);
  const std::uint32_t* census = memory.views.census[0].bits.row(0);
  memory.resize(settings_of({{"max-disparity", "20"}, {"mode", "dense"}}), kFull);
  memory.resize(settings_of({{"preset", "fast"}}), kHalf);
  memory.resize(settings_of({}), kFull);
  EXPECT_EQ(map, memory.maps.disparity.row(0));
  EXPECT_EQ(census, memory.views.census[0].bits.row(0));
}

TEST(FrameMemory, PlacesBuffersOfSuccessiveStepsInTheMemoryOfTheCensus) {
  FrameMemory memory;
  memory.resize(settings_of({}), kFull);
  const void* const census = memory.views.census[0].bits.row(0);
  EXPECT_EQ(census, memory.pyramid.support.disparity.row(0));
  EXPECT_EQ(census, memory.maps.support.disparity.row(0));
  EXPECT_EQ(census, memory.maps.smoothed.row(0));
  EXPECT_EQ(census, memory.buffers.edges.disparity.row(0));
  EXPECT_EQ(census, memory.buffers.rating.clues.disparity.row(0));
}

TEST(FrameMemory, PlacesOnlyWhatNoLaterPairNeedsInTheMemoryOfTheCensus) {
  FrameMemory memory;
  memory.resize(settings_of({{"temporal", "filter"}}), {{640, 200}, {640, 200}, {640, 200}, 1});
  const auto is_reused = [&](const void* buffer) {
    const std::less_equal<> up_to;
    return up_to(memory.views.census[0].bits.row(0), buffer) &&
           up_to(buffer, memory.views.census[1].bits.row(199));
  };
  for (int side = 0; side < 2; ++side) {
    const PastViews::View& view = memory.past.views[side];
    EXPECT_TRUE(is_reused(view.moved.filtered.row(199)) && is_reused(view.moved.rests.row(99)));
    EXPECT_TRUE(is_reused(view.blocks.change.row(0)) && is_reused(view.moves.x.row(0)));
    EXPECT_FALSE(is_reused(memory.past.means[side].filtered.row(0)));
    EXPECT_FALSE(is_reused(memory.past.means[side].rests.row(0)));
    EXPECT_FALSE(is_reused(memory.past.means[side].frames.row(0)));
  }
  for (const ViewPyramid* present : {&memory.past.present, &memory.last.present}) {
    EXPECT_TRUE(is_reused(present->levels[0].row(0)));
  }
  for (const ViewPyramid* last : {&memory.past.last, &memory.last.view}) {
    EXPECT_FALSE(is_reused(last->levels[0].row(0)));
  }
  EXPECT_FALSE(is_reused(memory.last.disparity.row(0)));
}

}  // namespace
}  // namespace mtstereo::frame_memory_test

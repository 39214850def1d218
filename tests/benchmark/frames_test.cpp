// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frames.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lib/outputs/user_error.hpp"

namespace mtstereo::bench::frames_test {
namespace {

TEST(Frames, QuickRunHasOneSize) {
  const auto quick = frames(true, nullptr);
  ASSERT_EQ(1U, quick.size());
  EXPECT_EQ("street-640x480-64", quick.front()->name());
  EXPECT_EQ(64, quick.front()->disparities());
  EXPECT_EQ(quick.front(), main_frame(quick));
}

TEST(Frames, FullRunStartsWithTheMainSizeAndHasUniqueNames) {
  const auto all = frames(false, nullptr);
  std::set<std::string> names;
  for (const FramePointer& frame : all) names.insert(frame->name());
  EXPECT_EQ(all.size(), names.size());
  EXPECT_EQ(5U, all.size());
  EXPECT_EQ("street-1242x375-100", main_frame(all)->name());
}

TEST(Frames, FolderWithoutTheRealPairGivesOnlyRenderedOnes) {
  const std::string empty = testing::TempDir() + "no-such-folder";
  EXPECT_EQ(5U, frames(false, empty.c_str()).size());
  EXPECT_EQ(5U, frames(false, "").size());
}

TEST(Frames, RealPairThatIsMissingIsAnError) {
  EXPECT_THROW(Frame::kitti(testing::TempDir() + "no-such-folder", "000046_10", 100),
               mtstereo::UserError);
}

TEST(Frames, RenderedPairHasItsSizeAndTwoDifferentViews) {
  const Frame frame(64, 48, 16);
  const Pair& pair = frame.images();
  EXPECT_EQ(cv::Size(64, 48), pair.left.size());
  EXPECT_EQ(cv::Size(64, 48), pair.right.size());
  EXPECT_EQ(CV_8UC1, pair.left.type());
  EXPECT_GT(cv::countNonZero(pair.left != pair.right), 0);
  EXPECT_DOUBLE_EQ(64 * 48 * 1e-6, frame.megapixels());
  EXPECT_EQ(pair.left.data, frame.images().left.data) << "it is rendered only once";
}

}  // namespace
}  // namespace mtstereo::bench::frames_test

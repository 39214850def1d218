// SPDX-License-Identifier: LGPL-2.1-or-later

// Which pairs become views, what they cover, and what is missing.

#include "programs/calibrate/view_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support.hpp"

namespace mtstereo::calibrate::view_choice_test {
namespace {

using testing::board_poses;
using testing::corners_of;
using ::testing::HasSubstr;
using testing::observe;
using testing::plumb_bob_rig;

const cv::Size kSize(640, 480);

Pose at(double x, double y, double z) {
  Pose pose;
  pose.translation = {x - 0.126, y - 0.084, z};
  return pose;
}

class Choosing : public ::testing::Test {
 protected:
  CornerPair see(const Pose& pose, double noise = 0.1) {
    return corners_of(observe(rig_, {pose}, board_, noise, seed_++).at(0));
  }
  BoardOptions board_;
  Rig rig_ = plumb_bob_rig();
  std::uint32_t seed_ = 1;
};

TEST_F(Choosing, TakesABoardThatHasComeToRestOnce) {
  ViewChoice choice(board_, kSize, kSize, Choice::kVideo);
  EXPECT_EQ(choice.offer(see(at(0, 0, 0.6)), 0), Verdict::kMoving) << "nothing is known yet";
  EXPECT_EQ(choice.offer(see(at(0, 0, 0.6)), 0.033), Verdict::kTaken);
  EXPECT_EQ(choice.offer(see(at(0, 0, 0.6)), 0.067), Verdict::kSimilar);
  EXPECT_EQ(choice.offer(see(at(0.09, 0.05, 0.6)), 0.1), Verdict::kMoving);
  EXPECT_EQ(choice.offer(see(at(0.09, 0.05, 0.6)), 0.133), Verdict::kTaken);
  EXPECT_EQ(choice.offer({}, 0.167), Verdict::kNoBoard);
  EXPECT_EQ(choice.offer(see(at(-0.05, 0.06, 0.6)), 0.2), Verdict::kMoving);
}

TEST_F(Choosing, ASlowDriftIsMotionAtAnyFrameRate) {
  for (const double step : {0.2, 1.0 / 30, 1.0 / 120}) {
    ViewChoice choice(board_, kSize, kSize, Choice::kVideo);
    for (int i = 0; i < 8; ++i) {
      // 10 cm/s at 60 cm are 87 px/s.
      EXPECT_EQ(choice.offer(see(at(0.1 * i * step, 0, 0.6)), i * step), Verdict::kMoving) << step;
    }
  }
}

TEST_F(Choosing, ImagesNeedNoRestAndOnlyRepetitionsAreLeftOut) {
  ViewChoice choice(board_, kSize, kSize, Choice::kStills);
  EXPECT_EQ(choice.offer(see(at(0, 0, 0.6)), 0), Verdict::kTaken);
  EXPECT_EQ(choice.offer(see(at(0, 0, 0.6)), 1), Verdict::kSimilar);
  EXPECT_EQ(choice.offer(see(at(0.02, 0.01, 0.58)), 2), Verdict::kTaken);
}

TEST_F(Choosing, StatesWhatIsMissing) {
  Coverage coverage(board_, kSize, kSize);
  EXPECT_FALSE(coverage.missing().empty());
  coverage.add(see(at(0, 0, 0.6)));
  EXPECT_THAT(coverage.missing(), HasSubstr("board"));
  EXPECT_FALSE(coverage.progress().complete());
  const auto views = observe(rig_, board_poses(rig_, board_, 60), board_, 0.1);
  for (const BoardView& view : views) coverage.add(corners_of(view));
  EXPECT_TRUE(coverage.progress().complete()) << coverage.missing();
  EXPECT_EQ(coverage.missing(), "");
}

TEST_F(Choosing, NamesTheEmptyCorner) {
  Coverage coverage(board_, kSize, kSize);
  for (const BoardView& view : observe(rig_, board_poses(rig_, board_, 80), board_, 0.1)) {
    const CornerPair corners = corners_of(view);
    const auto in_corner = [](const cv::Point2f& p) { return p.x < 240 && p.y > 300; };
    const auto& left = corners.left.pixels;
    const auto& right = corners.right.pixels;
    if (std::none_of(left.begin(), left.end(), in_corner) &&
        std::none_of(right.begin(), right.end(), in_corner)) {
      coverage.add(corners);
    }
  }
  EXPECT_THAT(coverage.missing(), HasSubstr("further to the lower left"));
}

TEST_F(Choosing, APlacementKnowsDistanceAndTilt) {
  const Placement near = placement_of(see(at(0, 0, 0.4)).left, board_, kSize);
  const Placement far = placement_of(see(at(0, 0, 0.8)).left, board_, kSize);
  EXPECT_GT(near.size, 1.7 * far.size);
  EXPECT_LT(far.skew, 0.1);
  EXPECT_NEAR(far.turn_x, 0, 0.05);
  Eigen::Matrix<double, 6, 1> turn;
  turn << 0, 0.5, 0, 0, 0, 0;
  Pose tilted = Pose().moved(turn);
  tilted.translation = at(0, 0, 0.6).translation;
  EXPECT_GT(std::abs(placement_of(see(tilted).left, board_, kSize).turn_x), 0.1);
}

TEST(Movement, WithoutSharedCornersIsUnknown) {
  EXPECT_FALSE(movement({{1, 2}, {{0, 0}, {1, 1}}, 0}, {{3}, {{0, 0}}, 0}));
  EXPECT_EQ(*movement({{1, 2}, {{0, 0}, {1, 1}}, 0}, {{2, 3}, {{4, 5}, {0, 0}}, 0}), 5);
}

}  // namespace
}  // namespace mtstereo::calibrate::view_choice_test

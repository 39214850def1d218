// SPDX-License-Identifier: LGPL-2.1-or-later

// What a calibration states about itself: held-out views, uncertainty, warnings.

#include "programs/calibrate/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/outputs/user_error.hpp"
#include "support.hpp"

namespace mtstereo::calibrate::quality_test {
namespace {

using testing::board_poses;
using ::testing::Contains;
using testing::corners_of;
using testing::fisheye_rig;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::observe;
using testing::plumb_bob_rig;
using ::testing::ThrowsMessage;
using testing::views_of;

const cv::Size kSize(640, 480);
const BoardOptions kBoard;

std::vector<std::string> names_of(const Quality& quality) {
  std::vector<std::string> names;
  for (const Warning& each : quality.warnings) names.push_back(each.name);
  return names;
}

struct Judged {
  Calibrated calibrated;
  Coverage coverage;
  Quality quality;
};

Judged judge_views(const std::vector<BoardView>& views) {
  Coverage coverage(kBoard, kSize, kSize);
  for (const BoardView& view : views) coverage.add(corners_of(view));
  Judged result{calibrate(Model::kPlumbBob, kSize, kSize, views), coverage, {}};
  result.quality = judge(result.calibrated, coverage, std::nullopt);
  return result;
}

/// Of many different views.
const Judged& good() {
  static const Judged found = judge_views(views_of(plumb_bob_rig(), 35, 0.1));
  return found;
}

TEST(Quality, ManyDifferentViewsAreGoodWithoutAWarning) {
  const Judged& found = good();
  EXPECT_THAT(names_of(found.quality), IsEmpty());
  EXPECT_EQ(found.quality.grade, Grade::kGood);
  ASSERT_TRUE(found.calibrated.held_out);
  EXPECT_LT(quantile(found.calibrated.held_out->fit.rows, 0.5), 0.2);
  EXPECT_EQ(found.calibrated.held_out->fit.views,
            static_cast<int>(found.calibrated.solution.views.size()) / 5);
}

TEST(Quality, TheTrueErrorIsWithinThreeStandardDeviations) {
  const Rig truth = plumb_bob_rig();
  int inside = 0;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const auto views =
        observe(truth, board_poses(truth, kBoard, 15, seed), kBoard, 0.2, 100 + seed);
    const Solution solution = solve(Model::kPlumbBob, kSize, kSize, views);
    const auto known = uncertainty_of(solution);
    ASSERT_TRUE(known);
    EXPECT_LT(std::abs(solution.rig.left.focal() - truth.left.focal()), 4 * known->left_focal);
    EXPECT_LT(std::abs(solution.rig.baseline() - truth.baseline()), 4 * known->baseline);
    inside += std::abs(solution.rig.baseline() - truth.baseline()) < known->baseline ? 1 : 0;
    EXPECT_GT(*depth_uncertainty(solution, 5), 4 * *depth_uncertainty(solution, 1));
  }
  EXPECT_GE(inside, 1) << "the standard deviations are too small";
}

TEST(Quality, FewViewsAreNamed) {
  const Rig truth = plumb_bob_rig();
  const Judged found = judge_views(views_of(truth, 8, 0.1));
  EXPECT_THAT(names_of(found.quality), Contains("few-views"));
  EXPECT_THAT(names_of(found.quality), Contains("nothing-held-out"));
  EXPECT_NE(found.quality.grade, Grade::kGood);
}

/// The board nearly parallel to the cameras, always at the same distance.
std::vector<Pose> similar_poses(int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    Eigen::Matrix<double, 6, 1> step;
    step << 0.03 * std::sin(i), 0.03 * std::cos(2 * i), 0, 0, 0, 0;
    Pose pose = Pose().moved(step);
    pose.translation = {-0.1 + 0.01 * (i % 5), -0.08 + 0.01 * (i % 4), 0.6};
    poses.push_back(pose);
  }
  return poses;
}

TEST(Quality, SimilarViewsAreNamed) {
  const Judged found = judge_views(observe(plumb_bob_rig(), similar_poses(20), kBoard, 0.1));
  EXPECT_THAT(names_of(found.quality), Contains("similar-views"));
  EXPECT_THAT(names_of(found.quality), Contains("uncovered-image"));
  EXPECT_THAT(names_of(found.quality), Contains("uncertain-focal-length"));
}

TEST(Quality, ResultsThatDependOnTheChoiceOfViewsAreNamed) {
  const Judged found = judge_views(observe(plumb_bob_rig(), similar_poses(12), kBoard, 0.3));
  EXPECT_THAT(names_of(found.quality), Contains("unstable"));
  EXPECT_THAT(names_of(found.quality), Contains("uncertain-baseline"));
}

TEST(Quality, InaccurateCornersAreNamed) {
  const Rig truth = plumb_bob_rig();
  const Judged found = judge_views(views_of(truth, 15, 1.5));
  EXPECT_THAT(names_of(found.quality), Contains("high-reprojection-error"));
  EXPECT_THAT(names_of(found.quality), Contains("high-row-error"));
  EXPECT_EQ(found.quality.grade, Grade::kPoor);
}

TEST(Quality, CamerasThatMovedAreNamed) {
  const Rig truth = plumb_bob_rig();
  const auto poses = board_poses(truth, kBoard, 30);
  auto views = observe(truth, poses, kBoard, 0.1);
  Rig moved = truth;
  moved.right_from_left.translation.y() += 0.01;
  const auto later = observe(moved, poses, kBoard, 0.1);
  std::copy(later.begin(), later.begin() + 9, views.begin());
  const Judged found = judge_views(views);
  EXPECT_THAT(names_of(found.quality), Contains("contradictory-views"));
  EXPECT_NE(found.quality.grade, Grade::kGood);
  EXPECT_NEAR(found.calibrated.solution.rig.baseline(), truth.baseline(), 0.001);
}

TEST(Quality, ParametersThatTheViewsDoNotDetermineAreNamed) {
  Calibrated calibrated = good().calibrated;
  // What a solution has whose equations are singular.
  calibrated.solution.result.covariance.resize(0, 0);
  const Quality quality = judge(calibrated, Coverage(kBoard, kSize, kSize), std::nullopt);
  EXPECT_THAT(names_of(quality), Contains("undetermined"));
  EXPECT_EQ(quality.grade, Grade::kPoor);
}

TEST(Quality, AModelThatDoesNotFitIsNotGood) {
  const Rig truth = fisheye_rig();
  const auto views = views_of(truth, 20, 0.05);
  const Judged found = judge_views(views);
  EXPECT_THAT(names_of(found.quality), Contains("wild-distortion"));
  EXPECT_NE(found.quality.grade, Grade::kGood);
}

TEST(Quality, SwappedViewsAreExchanged) {
  const Rig truth = plumb_bob_rig();
  auto views = views_of(truth, 20, 0.1);
  for (BoardView& view : views) std::swap(view.left, view.right);
  const Judged found = judge_views(views);
  EXPECT_TRUE(found.calibrated.swapped);
  EXPECT_THAT(names_of(found.quality), Contains("swapped-inputs"));
  EXPECT_NEAR(found.calibrated.solution.rig.right_from_left.translation.x(), -0.12, 0.001);
  EXPECT_NEAR(found.calibrated.solution.rig.left.values[0], truth.left.values[0], 2);
}

TEST(Quality, CamerasOneAboveTheOtherAreRefused) {
  Rig truth = plumb_bob_rig();
  truth.right_from_left.translation = {0.003, -0.1, 0};
  const auto views = views_of(truth, 20, 0.1);
  EXPECT_THAT([&] { judge_views(views); },
              ThrowsMessage<UserError>(HasSubstr("one is above the other")));
}

TEST(Quality, ABoardInMetersInsteadOfMillimetersIsRefused) {
  const Rig truth = plumb_bob_rig();
  auto views = views_of(truth, 12, 0.1);
  for (BoardView& view : views) {
    for (Observation& each : view.left) each.point *= 1000;
    for (Observation& each : view.right) each.point *= 1000;
  }
  EXPECT_THAT([&] { judge_views(views); },
              ThrowsMessage<UserError>(HasSubstr("is the square size, in mm, right?")));
}

TEST(Quality, OneCameraOnBothSidesIsNamed) {
  auto views = views_of(plumb_bob_rig(), 12, 0.1);
  for (BoardView& view : views) view.right = view.left;
  EXPECT_THAT([&] { judge_views(views); },
              ThrowsMessage<UserError>(HasSubstr("both sides show the images of one camera")));
}

TEST(Quality, CamerasOutOfStepAreNamed) {
  const Quality late = judge(good().calibrated, good().coverage, TimeOffset{0.0121, 0.0004, 60});
  EXPECT_THAT(names_of(late), Contains("not-synchronized"));
  EXPECT_THAT(late.warnings.back().text, HasSubstr("the right one exposes about 12 ms later"));
  const Quality fine = judge(good().calibrated, good().coverage, TimeOffset{0.0004, 0.0004, 60});
  EXPECT_THAT(names_of(fine), Not(Contains("not-synchronized")));
}

}  // namespace
}  // namespace mtstereo::calibrate::quality_test

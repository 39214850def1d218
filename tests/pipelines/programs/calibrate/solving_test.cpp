// SPDX-License-Identifier: LGPL-2.1-or-later

// The cameras that are found from exact and from noisy corners, and from some that are wrong.

#include "programs/calibrate/solving.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>

#include "lib/outputs/user_error.hpp"
#include "support.hpp"

namespace mtstereo::calibrate::solving_test {
namespace {

using testing::fisheye_rig;
using testing::plumb_bob_rig;
using testing::views_of;

const cv::Size kSize(640, 480);

double relative(double found, double truth) { return std::abs(found / truth - 1); }

void expect_close(const Rig& found, const Rig& truth, double focal, double baseline) {
  EXPECT_LT(relative(found.left.values[0], truth.left.values[0]), focal);
  EXPECT_LT(relative(found.left.values[1], truth.left.values[1]), focal);
  EXPECT_LT(relative(found.right.values[0], truth.right.values[0]), focal);
  EXPECT_LT(relative(found.right.values[1], truth.right.values[1]), focal);
  EXPECT_LT(relative(found.baseline(), truth.baseline()), baseline);
}

TEST(Solving, ExactCornersGiveTheExactCameras) {
  const Rig truth = plumb_bob_rig();
  const auto views = views_of(truth, 12, 0);
  const Solution solution = solve(Model::kPlumbBob, kSize, kSize, views);
  expect_close(solution.rig, truth, 1e-6, 1e-6);
  EXPECT_LT(solution.result.rms, 1e-5);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(solution.rig.left.values[i], truth.left.values[i], 1e-3) << i;
    EXPECT_NEAR(solution.rig.right.values[i], truth.right.values[i], 1e-3) << i;
  }
  EXPECT_TRUE(solution.removed.empty());
}

TEST(Solving, FortyNoisyViewsGiveFocalLengthAndBaseline) {
  for (const auto& [model, truth] :
       {std::pair(Model::kPlumbBob, plumb_bob_rig()), {Model::kFisheye, fisheye_rig()}}) {
    const Solution solution = solve(model, kSize, kSize, views_of(truth, 40, 0.1));
    expect_close(solution.rig, truth, 0.002, 0.005);
    EXPECT_NEAR(solution.result.rms, 0.1 * std::sqrt(2), 0.01);
  }
}

TEST(Solving, RationalModelFitsAWideLens) {
  const Rig truth = fisheye_rig();
  const auto views = views_of(truth, 25, 0.05);
  const Solution solution = solve(Model::kRational, kSize, kSize, views);
  EXPECT_LT(solution.result.rms, 0.2);
  EXPECT_LT(relative(solution.rig.baseline(), truth.baseline()), 0.005);
}

TEST(Solving, EqualsOpenCvOnTheSameCorners) {
  const Rig truth = plumb_bob_rig();
  const auto views = views_of(truth, 15, 0.1);
  const Solution solution = solve(Model::kPlumbBob, kSize, kSize, views);
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> lefts, rights;
  for (const BoardView& view : solution.views) {
    points.emplace_back();
    lefts.emplace_back();
    rights.emplace_back();
    for (const Observation& left : view.left) {
      for (const Observation& right : view.right) {
        if (left.id != right.id) continue;
        points.back().emplace_back(left.point.x(), left.point.y(), 0);
        lefts.back().emplace_back(left.pixel.x(), left.pixel.y());
        rights.back().emplace_back(right.pixel.x(), right.pixel.y());
      }
    }
  }
  const auto matrix = [](const Camera& camera) -> cv::Mat {
    const auto& v = camera.values;
    return (cv::Mat_<double>(3, 3) << v[0], 0, v[2], 0, v[1], v[3], 0, 0, 1);
  };
  cv::Mat k1 = matrix(truth.left), k2 = matrix(truth.right), d1, d2, r, t, e, f;
  cv::stereoCalibrate(points, lefts, rights, k1, d1, k2, d2, kSize, r, t, e, f,
                      cv::CALIB_USE_INTRINSIC_GUESS);
  // OpenCV takes only the corners that both cameras see.
  EXPECT_LT(relative(solution.rig.left.values[0], k1.at<double>(0, 0)), 0.002);
  EXPECT_LT(relative(solution.rig.right.values[0], k2.at<double>(0, 0)), 0.002);
  EXPECT_LT(relative(solution.rig.baseline(), cv::norm(t)), 0.002);
}

TEST(Solving, WrongCornersAreRemoved) {
  const Rig truth = plumb_bob_rig();
  auto views = views_of(truth, 25, 0.1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].left[i % views[i].left.size()].pixel.x() += 9;
    views[i].right[i % views[i].right.size()].pixel.y() -= 15;
  }
  const Solution solution = solve(Model::kPlumbBob, kSize, kSize, views);
  expect_close(solution.rig, truth, 0.003, 0.005);
  EXPECT_GE(solution.removed_corners, 2 * views.size());
  EXPECT_LT(solution.removed_corners, 2 * views.size() + 20);
  EXPECT_TRUE(solution.removed.empty());
}

TEST(Solving, WrongViewsAreRemovedAndNamed) {
  const Rig truth = plumb_bob_rig();
  auto views = views_of(truth, 25, 0.1);
  // The right camera of two views saw another moment.
  std::swap(views[3].right, views[11].right);
  const Solution solution = solve(Model::kPlumbBob, kSize, kSize, views);
  EXPECT_EQ(solution.removed, (std::vector<std::size_t>{3, 11}));
  expect_close(solution.rig, truth, 0.003, 0.005);
}

TEST(Solving, TooFewViewsAreRefused) {
  const Rig truth = plumb_bob_rig();
  const auto views = views_of(truth, 4, 0.1);
  EXPECT_THROW(solve(Model::kPlumbBob, kSize, kSize, views), UserError);
  EXPECT_THROW(solve(Model::kPlumbBob, kSize, kSize, {}), UserError);
}

TEST(Solving, ViewsThatDoNotFitAreRefused) {
  const Rig truth = plumb_bob_rig();
  auto views = views_of(truth, 12, 0.1);
  std::mt19937 random(3);
  for (BoardView& view : views) {
    for (Observation& each : view.right) {
      each.pixel = {static_cast<double>(random() % 640), static_cast<double>(random() % 480)};
    }
  }
  EXPECT_THROW(solve(Model::kPlumbBob, kSize, kSize, views), UserError);
}

}  // namespace
}  // namespace mtstereo::calibrate::solving_test

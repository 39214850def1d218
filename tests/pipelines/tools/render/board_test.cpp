// SPDX-License-Identifier: LGPL-2.1-or-later
// Boards: the image, the poses, and corners at their projected places.
#include "tools/render/board.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "support/temporary_folder.hpp"
#include "tools/render/clip_writer.hpp"
#include "tools/render/lens.hpp"

namespace mtstereo::render::board_test {
namespace {

using test::read_text;
using test::TemporaryFolder;

constexpr int kColumns = 8, kRows = 6;  // squares
constexpr double kSquare = 0.05;        // [m]
constexpr double kWidth = (kColumns + 2) * kSquare, kHeight = (kRows + 2) * kSquare;

Settings camera() {
  Settings s;
  s.width = 480, s.height = 360, s.samples = 3, s.focal = 400, s.baseline = 0.1;
  return s;
}

std::shared_ptr<const ImageTexture> image() {
  return std::make_shared<const ImageTexture>(checkerboard(kColumns, kRows, kSquare));
}

TEST(ImageTexture, MeanIsThatOfTheSquare) {
  const ImageTexture p(2, 2, {0, 255, 255, 0}, 10);  // pixels of 0.1 m
  EXPECT_DOUBLE_EQ(p.width(), 0.2);
  EXPECT_NEAR(p.mean(-0.05, -0.05, 0.02), 0, 1e-9);
  EXPECT_NEAR(p.mean(0.05, -0.05, 0.02), 1, 1e-9);
  EXPECT_NEAR(p.mean(0, -0.05, 0.04), 0.5, 1e-9);
  EXPECT_NEAR(p.mean(0.01, -0.05, 0.04), 0.75, 1e-9);
  EXPECT_NEAR(p.mean(0, 0, 0.2), 0.5, 1e-9);
  EXPECT_NEAR(p.mean(0, 0, 0.4), 0.875, 1e-9);  // white around it
  EXPECT_NEAR(p.mean(5, 5, 0.1), 1, 1e-9);
}

TEST(ImageTexture, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(ImageTexture(2, 2, {0, 1, 2}, 10), std::invalid_argument);
  EXPECT_THROW(ImageTexture(0, 2, {}, 10), std::invalid_argument);
  EXPECT_THROW(ImageTexture(1, 1, {0}, 0), std::invalid_argument);
  EXPECT_THROW(checkerboard(1, 5, 0.1), std::invalid_argument);
}

Eigen::Vector3d corner(int column, int row) {
  return {(column + 1 - kColumns / 2.0) * kSquare, (row + 1 - kRows / 2.0) * kSquare, 0};
}

// Adds the distances from the projected places to the detected corners [px].
void add_errors(const cv::Mat& image, const Camera& camera, const Eigen::Isometry3d& pose,
                std::vector<cv::Point2d>& errors) {
  std::vector<cv::Point2f> corners;
  const cv::Size inner(kColumns - 1, kRows - 1);
  ASSERT_TRUE(cv::findChessboardCorners(image, inner, corners));
  cv::cornerSubPix(image, corners, cv::Size(4, 4), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 100, 1e-4));
  for (int row = 0; row < inner.height; ++row) {
    for (int column = 0; column < inner.width; ++column) {
      const cv::Point2d at = camera.pixel_of(pose * corner(column, row));
      cv::Point2d nearest(1e9, 1e9);  // the board may be detected in the other direction
      for (const cv::Point2f& found : corners) {
        const cv::Point2d error = cv::Point2d(found) - at;
        if (cv::norm(error) < cv::norm(nearest)) nearest = error;
      }
      errors.push_back(nearest);
    }
  }
}

class Corners : public ::testing::TestWithParam<std::string> {};

TEST_P(Corners, AreAtTheirProjectedPlaces) {
  Settings s = camera();
  s.noise = 0, s.blur = 0.8;
  const RawRig rig(built_in_rig(GetParam(), s));
  BoardPoses options;
  options.count = 2, options.tilt = 30;
  const auto poses = choose_poses(options, kWidth, kHeight, rig);
  const Scene scene = make_board(image(), poses, {}, 1);
  std::vector<cv::Point2d> errors;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const RawFrame f = render_raw(scene, static_cast<double>(i), s, rig);
    add_errors(f.left, rig.left, poses[i], errors);
    add_errors(f.right, rig.right, poses[i], errors);
  }
  cv::Point2d sum(0, 0);
  double squares = 0, largest = 0;
  for (const cv::Point2d& error : errors) {
    sum += error;
    squares += error.dot(error);
    largest = std::max(largest, cv::norm(error));
  }
  const auto count = static_cast<double>(errors.size());
  EXPECT_EQ(errors.size(), 4U * (kColumns - 1) * (kRows - 1));
  // The rest is the error of the detection.
  EXPECT_LT(cv::norm(sum) / count, 0.01);
  EXPECT_LT(std::sqrt(squares / count), 0.05);
  EXPECT_LT(largest, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Rigs, Corners, ::testing::ValuesIn(rig_names()),
                         [](const auto& info) { return info.param; });

TEST(Board, PosesAreVisibleTiltedAndCoverTheImage) {
  const RawRig rig(built_in_rig("wide", camera()));
  const BoardPoses options;
  const auto poses = choose_poses(options, kWidth, kHeight, rig);
  ASSERT_EQ(poses.size(), 40U);
  double left = 1e9, right = 0, top = 1e9, bottom = 0, steepest = 0;
  for (const Eigen::Isometry3d& pose : poses) {
    for (const double u : {-0.5, 0.0, 0.5}) {
      for (const double v : {-0.5, 0.0, 0.5}) {
        const cv::Point2d at =
            rig.left.pixel_of(pose * Eigen::Vector3d(u * kWidth, v * kHeight, 0));
        const cv::Point2d other =
            rig.right.pixel_of(pose * Eigen::Vector3d(u * kWidth, v * kHeight, 0));
        EXPECT_TRUE(at.x > 0 && at.y > 0 && at.x < 479 && at.y < 359) << at;
        EXPECT_TRUE(other.x > 0 && other.y > 0 && other.x < 479 && other.y < 359) << other;
        left = std::min(left, at.x), right = std::max(right, at.x);
        top = std::min(top, at.y), bottom = std::max(bottom, at.y);
      }
    }
    const Eigen::Vector3d normal = pose.linear().col(2), ray = pose.translation().normalized();
    EXPECT_GT(normal.z(), 0) << "its face is not towards the camera";
    steepest = std::max(steepest, std::acos(normal.dot(ray)) * 180 / std::numbers::pi);
  }
  EXPECT_GT(steepest, 35);
  EXPECT_LT(steepest, 45.001);
  EXPECT_LT(left, 80);
  EXPECT_GT(right, 455);
  EXPECT_LT(top, 25);
  EXPECT_GT(bottom, 335);
}

TEST(Board, PartOfTheBoardMayBeOutside) {
  const RawRig rig(built_in_rig("wide", camera()));
  BoardPoses options;
  options.visible = 0.6;
  int outside = 0;
  for (const Eigen::Isometry3d& pose : choose_poses(options, kWidth, kHeight, rig)) {
    const auto seen = [&](double u, double v) {
      return rig.left.lens->sees(pose * Eigen::Vector3d(u * kWidth / 2, v * kHeight / 2, 0));
    };
    if (!(seen(-1, -1) && seen(1, -1) && seen(-1, 1) && seen(1, 1))) ++outside;
  }
  EXPECT_GT(outside, 10);
  EXPECT_LT(outside, 40);
}

TEST(Board, PosesDependOnTheSeedOnly) {
  const RawRig rig(built_in_rig("wide", camera()));
  BoardPoses options;
  options.count = 4;
  const auto first = choose_poses(options, kWidth, kHeight, rig);
  const auto again = choose_poses(options, kWidth, kHeight, rig);
  options.seed = 2;
  const auto other = choose_poses(options, kWidth, kHeight, rig);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].matrix(), again[i].matrix());
    EXPECT_NE(first[i].matrix(), other[i].matrix());
  }
}

TEST(Board, RefusesABaselineThatLeavesNoCommonView) {
  Settings s = camera();
  s.baseline = 5;
  const RawRig rig(built_in_rig("wide", s));
  EXPECT_THROW(choose_poses(BoardPoses(), kWidth, kHeight, rig), std::invalid_argument);
}

TEST(Board, RestsAndMoves) {
  std::vector<Eigen::Isometry3d> poses(3, Eigen::Isometry3d::Identity());
  poses[0].translation() = Eigen::Vector3d(0, 0, 1);
  poses[1].translation() = Eigen::Vector3d(0, 0, 2);
  poses[1].linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
  poses[2].translation() = Eigen::Vector3d(0, 0, 4);
  const Path path{poses, 0.2, 0.4};
  for (const double time : {0.0, 0.1, 0.2, 0.6, 0.8, 1.2, 9.0}) {
    EXPECT_TRUE(path.rests_at(time)) << time;
  }
  for (const double time : {0.3, 0.59, 0.81, 1.1}) EXPECT_FALSE(path.rests_at(time)) << time;
  EXPECT_NEAR(path.at(0.2).translation().z(), 1, 1e-9);
  EXPECT_NEAR(path.at(0.4).translation().z(), 1.5, 1e-9);
  EXPECT_NEAR(Eigen::AngleAxisd(path.at(0.4).linear()).angle(), 0.25, 1e-9);
  EXPECT_NEAR(path.at(0.6).translation().z(), 2, 1e-9);
  EXPECT_NEAR(path.at(9).translation().z(), 4, 1e-9);
}

TEST(Board, FramesAtThePosesRest) {
  // As the program does: 3 frames at each pose, 2 between.
  const double rate = 24;
  const Path path{std::vector<Eigen::Isometry3d>(40, Eigen::Isometry3d::Identity()), 2 / rate,
                  3 / rate};
  for (int i = 0; i < 39 * 5; ++i) EXPECT_EQ(path.rests_at(i / rate), i % 5 < 3) << "frame " << i;
}

TEST(Board, PosesAreWrittenForEachFrame) {
  const TemporaryFolder folder;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.25, -0.5, 1.5);
  pose.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
  write_poses(folder / "poses.txt", {{true, pose}, {false, pose}});
  const std::string text = read_text(folder / "poses.txt");
  EXPECT_NE(text.find("\n0 1 0 0.5 0 0.25 -0.5 1.5\n1 0 0 0.5 0 0.25 -0.5 1.5\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace mtstereo::render::board_test

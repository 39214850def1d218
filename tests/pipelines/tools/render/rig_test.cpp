// SPDX-License-Identifier: LGPL-2.1-or-later
// A rig that is out of line: geometry of the right view, and truth that stays that of the aligned
// one.
#include "tools/render/rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "tools/render/render.hpp"
#include "tools/render/scene.hpp"

namespace mtstereo::render::rig_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Settings camera() {
  Settings s;
  s.width = 161, s.height = 91, s.noise = 0;
  s.focal = 140, s.baseline = 0.1;
  return s;
}

Rig crooked() {
  Rig rig;
  rig.roll = 1, rig.pitch = -0.7, rig.yaw = 0.6, rig.focal_ratio = 1.02, rig.row_offset = 2.5;
  return rig;
}

TEST(Rig, DefaultIsAligned) {
  EXPECT_TRUE(Rig().aligned());
  EXPECT_EQ(right_pixel(camera(), 12.25, 7.5), cv::Point2d(12.25, 7.5));
}

TEST(Rig, SkyStaysInPlaceWhenTheRightCameraPitches) {
  const Scene empty = SceneBuilder("empty", 1).scene();
  Settings s = camera();
  const int aligned = render(empty, 0, s).right.at<std::uint8_t>(50, 50);
  s.rig.pitch = -10;
  EXPECT_LT(render(empty, 0, s).right.at<std::uint8_t>(50, 50), aligned);
}

TEST(Rig, EveryErrorIsOutOfLine) {
  for (double Rig::*error :
       {&Rig::roll, &Rig::pitch, &Rig::yaw, &Rig::focal_ratio, &Rig::row_offset}) {
    Rig rig;
    rig.*error += 0.01;
    EXPECT_FALSE(rig.aligned());
  }
}

TEST(Rig, RowOffsetLowersTheRightImage) {
  Settings s = camera();
  s.rig.row_offset = 1.5;
  EXPECT_NEAR(right_pixel(s, 30, 20).x, 30, 1e-9);
  EXPECT_NEAR(right_pixel(s, 30, 20).y, 21.5, 1e-9);
}

TEST(Rig, ClockwiseRollRaisesTheRightRim) {
  Settings s = camera();
  s.rig.roll = 0.5;
  EXPECT_NEAR(right_pixel(s, 160, 45).y - 45, -80 * std::sin(0.5 * kDegree), 1e-9);
  EXPECT_NEAR(right_pixel(s, 0, 45).y - 45, 80 * std::sin(0.5 * kDegree), 1e-9);
}

TEST(Rig, DownwardPitchRaisesTheImage) {
  Settings s = camera();
  s.rig.pitch = 1;
  EXPECT_NEAR(right_pixel(s, 80, 45).y - 45, -140 * std::tan(kDegree), 1e-9);
}

TEST(Rig, YawToTheRightMovesTheImageLeft) {
  Settings s = camera();
  s.rig.yaw = 1;
  EXPECT_NEAR(right_pixel(s, 80, 45).x - 80, -140 * std::tan(kDegree), 1e-9);
  EXPECT_NEAR(right_pixel(s, 80, 45).y, 45, 1e-9);
}

TEST(Rig, FocalRatioScalesAboutTheCenter) {
  Settings s = camera();
  s.rig.focal_ratio = 1.02;
  EXPECT_NEAR(right_pixel(s, 80, 95).y, 96, 1e-9);
  EXPECT_NEAR(right_pixel(s, 30, 45).x, 29, 1e-9);
}

TEST(Rig, IdealPixelInvertsRightPixel) {
  Settings s = camera();
  s.rig = crooked();
  for (const double y : {-3.0, 40.5, 90.0}) {
    for (const double x : {0.0, 77.25, 160.0}) {
      const cv::Point2d there = right_pixel(s, x, y), back = ideal_pixel(s, there.x, there.y);
      EXPECT_NEAR(back.x, x, 1e-9);
      EXPECT_NEAR(back.y, y, 1e-9);
    }
  }
}

TEST(Rig, ChangesOnlyTheRightImage) {
  const Scene scene = make_scene("street", 1);
  Settings s = camera();
  const StereoFrame aligned = render(scene, 0.5, s);
  s.rig = crooked();
  const StereoFrame bent = render(scene, 0.5, s);
  EXPECT_EQ(cv::norm(aligned.left, bent.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(aligned.occluded, bent.occluded, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(aligned.truth != bent.truth), 0);
  EXPECT_GT(cv::norm(aligned.right, bent.right, cv::NORM_L1), 5.0 * 161 * 91);
}

TEST(Rig, WholeRowOffsetShiftsTheRowsExactly) {
  const Scene scene = make_scene("garden", 1);
  Settings s = camera();
  const cv::Mat aligned = render(scene, 0, s).right;
  s.rig.row_offset = 3;
  const cv::Mat lower = render(scene, 0, s).right;
  cv::Mat difference;
  cv::absdiff(lower.rowRange(3, 91), aligned.rowRange(0, 88), difference);
  // The sample positions are sums of the same numbers in another order: gray values may round
  // differently, and a ray may pass the other side of an edge.
  EXPECT_LT(cv::countNonZero(difference > 1), difference.rows * difference.cols / 1000);
}

// Linear interpolation between four pixels.
double sample(const cv::Mat& image, cv::Point2d at) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  const double u = at.x - x, v = at.y - y;
  const auto value = [&](int i, int j) -> double { return image.at<std::uint8_t>(y + j, x + i); };
  return (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) +
         v * ((1 - u) * value(0, 1) + u * value(1, 1));
}

// Mean |left - right| at the places where the truth and the displacement field expect the point.
double difference_along_the_field(const StereoFrame& f, const Settings& field) {
  double sum = 0;
  int count = 0;
  for (int y = 8; y < f.left.rows - 8; ++y) {
    for (int x = 8; x < f.left.cols - 8; ++x) {
      const double d = f.truth.at<float>(y, x);
      if (!std::isfinite(d) || f.occluded.at<std::uint8_t>(y, x) != 0) continue;
      const cv::Point2d at = right_pixel(field, x - d, y);
      if (at.x < 1 || at.y < 1 || at.x > f.right.cols - 2 || at.y > f.right.rows - 2) continue;
      sum += std::abs(f.left.at<std::uint8_t>(y, x) - sample(f.right, at));
      ++count;
    }
  }
  EXPECT_GT(count, f.left.rows * f.left.cols / 2);
  return sum / count;
}

TEST(Rig, FieldLeadsFromTheTruthToTheRightImage) {
  const Scene scene = make_scene("room", 1);
  Settings s = complete(scene, camera());
  s.samples = 3;
  s.rig = crooked();
  const StereoFrame f = render(scene, 0, s);
  const double exact = difference_along_the_field(f, s);
  Settings wrong = s;
  wrong.rig.row_offset += 1;
  Settings aligned = s;
  aligned.rig = Rig();
  EXPECT_LT(exact, 4);
  EXPECT_GT(difference_along_the_field(f, wrong), 1.2 * exact);
  EXPECT_GT(difference_along_the_field(f, aligned), 1.5 * exact);
}

}  // namespace
}  // namespace mtstereo::render::rig_test

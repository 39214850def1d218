// SPDX-License-Identifier: LGPL-2.1-or-later

// The time offset of two cameras, from a board in motion.

#include "programs/calibrate/synchronization.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support.hpp"

namespace mtstereo::calibrate::synchronization_test {
namespace {

using testing::fisheye_rig;
using testing::observe;
using testing::plumb_bob_rig;

const BoardOptions kBoard;

// A board that is waved in front of the cameras.
Pose wave(double time, double amplitude) {
  Eigen::Matrix<double, 6, 1> turn;
  turn << 0.2 * std::sin(3 * time), 0.2 * std::cos(2 * time), 0, 0, 0, 0;
  Pose pose = Pose().moved(turn);
  pose.translation = {-0.1 + amplitude * std::sin(5 * time),
                      -0.08 + amplitude * std::sin(4 * time + 1), 0.7};
  return pose;
}

Track film(const Rig& rig, double offset, double amplitude, double noise) {
  Track track;
  std::mt19937 random(7);
  for (int i = 0; i < 90; ++i) {
    const double time = i / 30.0;
    BoardView view;
    view.left = observe(rig.left, wave(time, amplitude), kBoard, noise, random);
    view.right = observe(rig.right, rig.right_from_left * wave(time + offset, amplitude), kBoard,
                         noise, random);
    track.add(time, view);
  }
  return track;
}

TEST(Synchronization, FindsTheOffsetOfEitherSign) {
  for (const Rig& rig : {plumb_bob_rig(), fisheye_rig()}) {
    for (const double offset : {0.012, -0.005, 0.03}) {
      const auto found = estimate_offset(rig, film(rig, offset, 0.06, 0.1));
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->seconds, offset, 0.001);
      EXPECT_TRUE(found->significant()) << offset;
    }
  }
}

TEST(Synchronization, SynchronizedCamerasGiveNoWarning) {
  const Rig rig = plumb_bob_rig();
  const auto found = estimate_offset(rig, film(rig, 0, 0.06, 0.2));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->seconds, 0, 0.001);
  EXPECT_FALSE(found->significant());
}

TEST(Synchronization, ABoardAtRestStatesNothing) {
  const Rig rig = plumb_bob_rig();
  Track track;
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    BoardView view;
    view.left = observe(rig.left, wave(0, 0.06), kBoard, 0.1, random);
    view.right = observe(rig.right, rig.right_from_left * wave(0, 0.06), kBoard, 0.1, random);
    track.add(i / 30.0, view);
  }
  EXPECT_FALSE(estimate_offset(rig, track));
  EXPECT_FALSE(estimate_offset(rig, Track()));
}

TEST(Synchronization, SwappedViewsAreExchanged) {
  const Rig rig = plumb_bob_rig();
  const Track track = film(rig, 0.012, 0.06, 0.1);
  Track swapped;
  for (const Moment& each : track.moments()) {
    swapped.add(each.time, {each.view.right, each.view.left, {}});
  }
  const auto found = estimate_offset(rig, swapped, true);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->seconds, 0.012, 0.001);
}

}  // namespace
}  // namespace mtstereo::calibrate::synchronization_test

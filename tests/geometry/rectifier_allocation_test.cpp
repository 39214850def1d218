// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "mtstereo/geometry/rectification.hpp"
#include "rigs.hpp"
#include "support/counting_allocator.hpp"
#include "support/random.hpp"

namespace mtstereo::test::rectifier_allocation_test {
namespace {

TEST(RectifierAllocation, FramesAllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const StereoCalibration rig = fisheye_rig();
  const Rectification rectification = rectify(rig, {.alpha = 1}).value();
  Rectifier rectifier =
      std::move(Rectifier::create(rig, rectification, Rectifier::Side::kLeft).value());
  const GrayPlane in = noise(640 * 4, 480, 1);
  GrayPlane out(640 * 4, 480);
  for (const int channels : {1, 3, 4}) {
    count_allocations();
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(rectifier
                      .apply({in.pixels.data(), 640, 480, 640 * 4},
                             {out.pixels.data(), 640, 480, 640 * 4}, channels)
                      .ok());
    }
    EXPECT_EQ(allocations(), 0) << channels;
  }
}

TEST(RectifierAllocation, MissingMemoryIsAnError) {
  if (!allocations_are_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const StereoCalibration rig = plumb_bob_rig(64, 48);
  const Rectification rectification = rectify(rig).value();
  bool failed = true;
  for (int successes = 0; failed; ++successes) {
    ASSERT_LT(successes, 100);
    fail_allocation_after(successes);
    const auto result = Rectifier::create(rig, rectification, Rectifier::Side::kRight);
    failed = allocation_has_failed();
    fail_allocation_after(-1);
    if (!failed) {
      EXPECT_TRUE(result.ok());
    } else {
      ASSERT_FALSE(result.ok());
      EXPECT_EQ(result.error().code, ErrorCode::kOutOfMemory);
    }
  }
}

}  // namespace
}  // namespace mtstereo::test::rectifier_allocation_test

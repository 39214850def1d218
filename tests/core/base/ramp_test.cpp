// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/ramp.hpp"

#include <gtest/gtest.h>

namespace mtstereo::ramp_test {
namespace {

TEST(Ramp, RisesFromNoneToAll) {
  EXPECT_EQ(ramp(2, 4, 1), 0);
  EXPECT_EQ(ramp(2, 4, 2), 0);
  EXPECT_EQ(ramp(2, 4, 2.5F), 0.25F);
  EXPECT_EQ(ramp(2, 4, 4), 1);
  EXPECT_EQ(ramp(2, 4, 9), 1);
}

TEST(Ramp, AllMayBeTheSmallerOne) {
  EXPECT_EQ(ramp(9, 5, 10), 0);
  EXPECT_EQ(ramp(9, 5, 8), 0.25F);
  EXPECT_EQ(ramp(9, 5, 4), 1);
}

}  // namespace
}  // namespace mtstereo::ramp_test

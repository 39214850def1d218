// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/progress_line.hpp"

#include <gtest/gtest.h>

namespace mtstereo::run::progress_line_test {
namespace {

TEST(ProgressText, HasSpeedAndTimeLeft) {
  EXPECT_EQ(progress_text(120, 480, 40, 0.97),
            "120 of 480 pairs (25 %), 40.0 pairs/s, the matcher works 97 % of the time, 9 s left");
}

TEST(ProgressText, RoundsTheTimeLeftUp) {
  EXPECT_NE(progress_text(1, 3601, 10, 1).find(", 6 min left"), std::string::npos);
  EXPECT_NE(progress_text(1, 360'001, 10, 1).find(", 10 h 0 min left"), std::string::npos);
  EXPECT_NE(progress_text(9, 10, 10, 1).find(", 1 s left"), std::string::npos);
}

TEST(ProgressText, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(progress_text(1, 10, 0, 0), "1 of 10 pairs (10 %)");
  EXPECT_EQ(progress_text(10, 10, 20, 1),
            "10 of 10 pairs (100 %), 20.0 pairs/s, the matcher works 100 % of the time");
}

}  // namespace
}  // namespace mtstereo::run::progress_line_test

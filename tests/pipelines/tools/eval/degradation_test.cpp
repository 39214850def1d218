// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/degradation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lib/outputs/user_error.hpp"
#include "support/error_of.hpp"

namespace mtstereo::eval::degradation_test {
namespace {

TEST(DegradationText, IsReadBack) {
  for (const char* text :
       {"noise=5", "jpeg=20", "h264=35", "dark=0.15", "bright=1.8", "blur-right=1.5",
        "lower-right=-0.5", "roll-right=0.2", "gain-right=0.8", "gamma-right=1.3", "blur=0.7",
        "rim", "soft2x", "soft1.5x", "cam", "cam2x", "cam1.5x", "rimcam", "camh264=28"}) {
    EXPECT_EQ(degradation_text(parse_degradation(text)), text);
  }
}

TEST(DegradationText, IsRefusedByNameIfItIsWrong) {
  const auto message_of = [](const char* text) {
    return test::error_of<UserError>([&] { parse_degradation(text); });
  };
  EXPECT_THAT(message_of("fog=1"), ::testing::HasSubstr("the kinds are noise, jpeg"));
  EXPECT_THAT(message_of(""), ::testing::HasSubstr("the kinds are"));
  EXPECT_THAT(message_of("noise"), ::testing::HasSubstr("noise=0 .. 100"));
  EXPECT_THAT(message_of("noise="), ::testing::HasSubstr("noise=0 .. 100"));
  EXPECT_THAT(message_of("jpeg=0"), ::testing::HasSubstr("jpeg=1 .. 100"));
  EXPECT_THAT(message_of("jpeg=20.5"), ::testing::HasSubstr("whole number; use jpeg=1 .. 100"));
  EXPECT_THAT(message_of("h264=51"), ::testing::HasSubstr("h264=1 .. 50"));
  EXPECT_THAT(message_of("blur-right=-1"), ::testing::HasSubstr("blur-right=0 .. 10"));
  EXPECT_THAT(message_of("dark=nan"), ::testing::HasSubstr("dark=0 .. 1"));
  EXPECT_THAT(message_of("roll-right=1x"), ::testing::HasSubstr("roll-right=-45 .. 45"));
  EXPECT_THAT(message_of("blur"), ::testing::HasSubstr("has no amount; use blur=0 .. 10"));
  EXPECT_THAT(message_of("camh264"), ::testing::HasSubstr("has no amount; use camh264=1 .. 50"));
  EXPECT_THAT(message_of("camh264=0"), ::testing::HasSubstr("camh264=1 .. 50"));
  EXPECT_THAT(message_of("cam=3"), ::testing::HasSubstr("'cam=3' takes no amount; use cam"));
  EXPECT_THAT(message_of("soft2x="), ::testing::HasSubstr("takes no amount; use soft2x"));
  EXPECT_THAT(message_of("soft3x"), ::testing::HasSubstr("soft2x, soft1.5x, cam, cam2x"));
  EXPECT_THAT(message_of("Cam"), ::testing::HasSubstr("the kinds are"));
  EXPECT_THAT(message_of("cam "), ::testing::HasSubstr("the kinds are"));
  EXPECT_THAT(message_of("clean"), ::testing::HasSubstr("the kinds are"));
}

TEST(DegradationText, ListOfKindsHasTheirAmounts) {
  EXPECT_THAT(degradation_kinds(),
              ::testing::HasSubstr("blur=0 .. 10, rim, soft2x, soft1.5x, cam, "));
}

}  // namespace
}  // namespace mtstereo::eval::degradation_test

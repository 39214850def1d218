// SPDX-License-Identifier: LGPL-2.1-or-later
#include "eval/degrade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "eval/input_error.hpp"

namespace mtstereo::eval {
namespace {

/// A smooth image that has no two equal rows or columns.
cv::Mat slopes(int width, int height) {
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(20 + 2 * y + x);
    }
  }
  return image;
}

struct Pair {
  cv::Mat left = slopes(61, 47);
  cv::Mat right = slopes(61, 47);
};

Pair degraded(const std::string& text) {
  Pair pair;
  degrade(parse_degradation(text), pair.left, pair.right);
  return pair;
}

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Degradation, TextIsReadBack) {
  for (const char* text :
       {"noise=5", "jpeg=20", "dark=0.15", "bright=1.8", "blur-right=1.5", "lower-right=-0.5",
        "roll-right=0.2", "gain-right=0.8", "gamma-right=1.3"}) {
    EXPECT_EQ(degradation_text(parse_degradation(text)), text);
  }
}

TEST(Degradation, WrongTextIsRefusedByName) {
  const auto message_of = [](const char* text) -> std::string {
    try {
      parse_degradation(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message_of("fog=1"), testing::HasSubstr("the kinds are noise, jpeg"));
  EXPECT_THAT(message_of(""), testing::HasSubstr("the kinds are"));
  EXPECT_THAT(message_of("noise"), testing::HasSubstr("noise=0 .. 100"));
  EXPECT_THAT(message_of("noise="), testing::HasSubstr("noise=0 .. 100"));
  EXPECT_THAT(message_of("jpeg=0"), testing::HasSubstr("jpeg=1 .. 100"));
  EXPECT_THAT(message_of("dark=nan"), testing::HasSubstr("dark=0 .. 1"));
  EXPECT_THAT(message_of("roll-right=1x"), testing::HasSubstr("roll-right=-45 .. 45"));
}

TEST(Degradation, AmountsWithoutEffectLeaveThePairAlone) {
  for (const char* text : {"noise=0", "bright=1", "blur-right=0", "lower-right=0", "roll-right=0",
                           "gain-right=1", "gamma-right=1"}) {
    const Pair pair = degraded(text);
    EXPECT_EQ(difference(pair.left, Pair().left), 0) << text;
    EXPECT_EQ(difference(pair.right, Pair().right), 0) << text;
  }
}

TEST(Degradation, RightViewOnly) {
  for (const char* text :
       {"blur-right=1", "lower-right=1", "roll-right=1", "gain-right=0.5", "gamma-right=2"}) {
    const Pair pair = degraded(text);
    EXPECT_EQ(difference(pair.left, Pair().left), 0) << text;
    EXPECT_GT(difference(pair.right, Pair().right), 0) << text;
  }
}

TEST(Degradation, NoiseHasItsDeviationAndDiffersBetweenTheViews) {
  Pair pair;
  pair.left = pair.right = cv::Mat(200, 200, CV_8UC1, cv::Scalar(128));
  degrade(parse_degradation("noise=5"), pair.left, pair.right);
  cv::Scalar mean, deviation;
  cv::meanStdDev(pair.left, mean, deviation);
  EXPECT_NEAR(mean[0], 128, 0.2);
  EXPECT_NEAR(deviation[0], 5, 0.1);
  EXPECT_GT(difference(pair.left, pair.right), 5);
  EXPECT_EQ(difference(degraded("noise=5").left, degraded("noise=5").left), 0);
}

TEST(Degradation, LowerMovesTheContentDown) {
  const Pair pair = degraded("lower-right=2");
  EXPECT_EQ(pair.right.at<std::uint8_t>(20, 30), Pair().right.at<std::uint8_t>(18, 30));
}

TEST(Degradation, RollTurnsClockwise) {
  // The slope of the columns is 1, that of the rows 2: to the right of the center, the content
  // comes from above.
  const Pair pair = degraded("roll-right=5");
  EXPECT_LT(pair.right.at<std::uint8_t>(23, 55), Pair().right.at<std::uint8_t>(23, 55));
  EXPECT_EQ(pair.right.at<std::uint8_t>(23, 30), Pair().right.at<std::uint8_t>(23, 30));
}

TEST(Degradation, BrightSaturates) {
  const Pair pair = degraded("bright=4");
  EXPECT_EQ(pair.left.at<std::uint8_t>(40, 40), 255);
  EXPECT_EQ(pair.left.at<std::uint8_t>(0, 0), 80);
}

}  // namespace
}  // namespace mtstereo::eval

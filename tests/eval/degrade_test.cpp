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
       {"noise=5", "jpeg=20", "h264=35", "dark=0.15", "bright=1.8", "blur-right=1.5",
        "lower-right=-0.5", "roll-right=0.2", "gain-right=0.8", "gamma-right=1.3"}) {
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
  EXPECT_THAT(message_of("jpeg=20.5"), testing::HasSubstr("whole number; use jpeg=1 .. 100"));
  EXPECT_THAT(message_of("h264=51"), testing::HasSubstr("h264=1 .. 50"));
  EXPECT_THAT(message_of("blur-right=-1"), testing::HasSubstr("blur-right=0 .. 10"));
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

TEST(Degradation, NoiseOfTheTwoViewsIsUncorrelated) {
  cv::Mat left(400, 400, CV_8UC1, cv::Scalar(128)), right = left.clone();
  degrade(parse_degradation("noise=10"), left, right);
  cv::Mat a, b;
  left.convertTo(a, CV_64F, 1, -128);
  right.convertTo(b, CV_64F, 1, -128);
  EXPECT_NEAR(a.dot(b) / (cv::norm(a) * cv::norm(b)), 0, 0.01);
}

TEST(Degradation, DarkScalesBothViewsAndAddsNoise) {
  cv::Mat left(200, 200, CV_8UC1, cv::Scalar(200)), right = left.clone();
  degrade(parse_degradation("dark=0.15"), left, right);
  for (const cv::Mat& view : {left, right}) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(view, mean, deviation);
    EXPECT_NEAR(mean[0], 30, 0.1);
    EXPECT_NEAR(deviation[0], 2, 0.1);
  }
}

void expect_compression(const char* good, const char* bad) {
  const Pair little = degraded(good), much = degraded(bad);
  for (cv::Mat Pair::*view : {&Pair::left, &Pair::right}) {
    const cv::Mat original = Pair().*view;
    ASSERT_EQ((little.*view).size(), original.size()) << good;
    EXPECT_LT(cv::norm(little.*view, original), cv::norm(much.*view, original)) << bad;
    EXPECT_LT(difference(little.*view, original), 16) << good;
  }
  EXPECT_EQ(difference(degraded(bad).left, much.left), 0) << bad;
}

TEST(Degradation, JpegChangesBothViewsMoreAtLowerQuality) {
  expect_compression("jpeg=90", "jpeg=10");
}

/// Needs GStreamer's elements.
class H264 : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto obstacle = degradation_obstacle(parse_degradation("h264=20"))) {
      GTEST_SKIP() << *obstacle;
    }
  }
};

TEST_F(H264, ChangesBothViewsMoreWithACoarserQuantizer) {
  expect_compression("h264=20", "h264=45");
}

TEST_F(H264, KeepsTheGrayValues) {
  cv::Mat left(33, 35, CV_8UC1, cv::Scalar(0)), right(33, 35, CV_8UC1, cv::Scalar(255));
  degrade(parse_degradation("h264=10"), left, right);
  EXPECT_LE(difference(left, cv::Mat(33, 35, CV_8UC1, cv::Scalar(0))), 1);
  EXPECT_LE(difference(right, cv::Mat(33, 35, CV_8UC1, cv::Scalar(255))), 1);
}

TEST(Degradation, BlurKeepsAConstantAndSmoothsAnEdge) {
  Pair pair;
  pair.right = cv::Mat::zeros(40, 40, CV_8UC1);
  pair.right.colRange(20, 40).setTo(200);
  degrade(parse_degradation("blur-right=1"), pair.left, pair.right);
  EXPECT_EQ(pair.right.at<std::uint8_t>(20, 5), 0);
  EXPECT_EQ(pair.right.at<std::uint8_t>(20, 35), 200);
  // The integral of the Gaussian from the edge to half a pixel: 0.69 and 0.31 of the step.
  EXPECT_NEAR(pair.right.at<std::uint8_t>(20, 20), 138, 3);
  EXPECT_NEAR(pair.right.at<std::uint8_t>(20, 19), 62, 3);
}

TEST(Degradation, GainAndGammaAreExact) {
  EXPECT_EQ(degraded("gain-right=0.5").right.at<std::uint8_t>(20, 30), 45);
  EXPECT_EQ(degraded("gamma-right=2").right.at<std::uint8_t>(20, 30), 32);  // 255 (90 / 255)^2
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

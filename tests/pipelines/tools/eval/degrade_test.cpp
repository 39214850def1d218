// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/degrade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace mtstereo::eval::degrade_test {
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

LoadedPair pair_of(const cv::Mat& left, const cv::Mat& right) { return {left, right, {}}; }

LoadedPair original() { return pair_of(slopes(61, 47), slopes(61, 47)); }

LoadedPair degraded(const std::string& text, const LoadedPair& pair = original()) {
  return degrade(parse_degradation(text), pair, 16).images;
}

/// Two equal views of one gray value.
LoadedPair constant(int size, double value) {
  const cv::Mat view(size, size, CV_8UC1, cv::Scalar(value));
  return pair_of(view, view);
}

/// Two equal views, 0 to the left of the middle and 200 to the right.
LoadedPair edge() {
  cv::Mat view = cv::Mat::zeros(40, 40, CV_8UC1);
  view.colRange(20, 40).setTo(200);
  return pair_of(view, view);
}

/// Of an edge from 0 to 200 that is blurred by 1.2 px, half a pixel beside the edge: the integral
/// of the Gaussian up to there is 0.66.
constexpr double kBesideSoftEdge = 132;

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Degradation, AmountsWithoutEffectLeaveThePairAlone) {
  for (const char* text : {"noise=0", "bright=1", "blur=0", "blur-right=0", "lower-right=0",
                           "roll-right=0", "gain-right=1", "gamma-right=1"}) {
    const LoadedPair pair = degraded(text);
    EXPECT_EQ(difference(pair.left, original().left), 0) << text;
    EXPECT_EQ(difference(pair.right, original().right), 0) << text;
  }
}

TEST(Degradation, RightViewOnly) {
  for (const char* text :
       {"blur-right=1", "lower-right=1", "roll-right=1", "gain-right=0.5", "gamma-right=2"}) {
    const LoadedPair pair = degraded(text);
    EXPECT_EQ(difference(pair.left, original().left), 0) << text;
    EXPECT_GT(difference(pair.right, original().right), 0) << text;
  }
}

TEST(Degradation, NoiseHasItsDeviationAndDiffersBetweenTheViews) {
  const LoadedPair pair = degraded("noise=5", constant(200, 128));
  cv::Scalar mean, deviation;
  cv::meanStdDev(pair.left, mean, deviation);
  EXPECT_NEAR(mean[0], 128, 0.2);
  EXPECT_NEAR(deviation[0], 5, 0.1);
  EXPECT_GT(difference(pair.left, pair.right), 5);
  EXPECT_EQ(difference(degraded("noise=5").left, degraded("noise=5").left), 0);
}

TEST(Degradation, NoiseOfTheTwoViewsIsUncorrelated) {
  const LoadedPair pair = degraded("noise=10", constant(400, 128));
  cv::Mat a, b;
  pair.left.convertTo(a, CV_64F, 1, -128);
  pair.right.convertTo(b, CV_64F, 1, -128);
  EXPECT_NEAR(a.dot(b) / (cv::norm(a) * cv::norm(b)), 0, 0.01);
}

TEST(Degradation, DarkScalesBothViewsAndAddsNoise) {
  const LoadedPair pair = degraded("dark=0.15", constant(200, 200));
  for (const cv::Mat& view : {pair.left, pair.right}) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(view, mean, deviation);
    EXPECT_NEAR(mean[0], 30, 0.1);
    EXPECT_NEAR(deviation[0], 2, 0.1);
  }
}

void expect_compression(const char* good, const char* bad) {
  const LoadedPair little = degraded(good), much = degraded(bad);
  for (cv::Mat LoadedPair::*view : {&LoadedPair::left, &LoadedPair::right}) {
    const cv::Mat before = original().*view;
    ASSERT_EQ((little.*view).size(), before.size()) << good;
    EXPECT_LT(cv::norm(little.*view, before), cv::norm(much.*view, before)) << bad;
    EXPECT_LT(difference(little.*view, before), 16) << good;
  }
  EXPECT_EQ(difference(degraded(bad).left, much.left), 0) << bad;
}

TEST(Degradation, JpegChangesBothViewsMoreAtLowerQuality) {
  expect_compression("jpeg=90", "jpeg=10");
}

/// Needs GStreamer's elements.
class H264 : public ::testing::Test {
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
  const cv::Mat black(33, 35, CV_8UC1, cv::Scalar(0)), white(33, 35, CV_8UC1, cv::Scalar(255));
  const LoadedPair pair = degraded("h264=10", pair_of(black, white));
  EXPECT_LE(difference(pair.left, black), 1);
  EXPECT_LE(difference(pair.right, white), 1);
}

TEST_F(H264, OfSoftViewsBlursAndLosesMoreWithACoarserQuantizer) {
  const LoadedPair little = degraded("camh264=10", edge()), much = degraded("camh264=45", edge());
  for (const cv::Mat& view : {little.left, little.right}) {
    EXPECT_NEAR(cv::mean(view.col(20))[0], kBesideSoftEdge, 3);
    EXPECT_NEAR(cv::mean(view.col(19))[0], 200 - kBesideSoftEdge, 3);
  }
  EXPECT_GT(difference(little.left, little.right), 0);
  EXPECT_LT(cv::norm(little.left, edge().left), cv::norm(much.left, edge().left));
}

TEST(Degradation, BlurKeepsAConstantAndSmoothsAnEdge) {
  for (const char* text : {"blur-right=1", "blur=1"}) {
    const cv::Mat right = degraded(text, edge()).right;
    EXPECT_EQ(right.at<std::uint8_t>(20, 5), 0) << text;
    EXPECT_EQ(right.at<std::uint8_t>(20, 35), 200) << text;
    // The integral of the Gaussian from the edge to half a pixel: 0.69 and 0.31 of the step.
    EXPECT_NEAR(right.at<std::uint8_t>(20, 20), 138, 3) << text;
    EXPECT_NEAR(right.at<std::uint8_t>(20, 19), 62, 3) << text;
  }
}

TEST(Degradation, BlurIsEqualInBothViews) {
  const LoadedPair pair = degraded("blur=1.5", edge());
  EXPECT_EQ(difference(pair.left, pair.right), 0);
  EXPECT_GT(difference(pair.left, edge().left), 40);
}

TEST(Degradation, CameraBlursAddsNoiseAndCompresses) {
  const LoadedPair pair = degraded("cam", edge());
  for (const cv::Mat& view : {pair.left, pair.right}) {
    EXPECT_NEAR(cv::mean(view.col(20))[0], kBesideSoftEdge, 3);
    EXPECT_NEAR(cv::mean(view.col(19))[0], 200 - kBesideSoftEdge, 3);
  }
  EXPECT_GT(difference(pair.left, pair.right), 1);
  EXPECT_EQ(difference(pair.left, degraded("cam", edge()).left), 0);
  // JPEG of quality 70 removes most of the noise.
  cv::Scalar mean, deviation;
  cv::meanStdDev(degraded("cam", constant(200, 128)).left, mean, deviation);
  EXPECT_NEAR(mean[0], 128, 0.2);
  EXPECT_GT(deviation[0], 0.3);
  EXPECT_LT(deviation[0], 2);
}

TEST(Degradation, RimIsSharpInTheMiddleAndSoftInTheCorners) {
  cv::Mat stripes(120, 160, CV_8UC1, cv::Scalar(200));
  for (int x = 0; x < 160; x += 2) stripes.col(x).setTo(0);
  const cv::Mat view = degraded("rim", pair_of(stripes, stripes)).right;
  const cv::Rect middle(60, 45, 40, 30), corner(0, 0, 12, 9);
  EXPECT_EQ(difference(view(middle), stripes(middle)), 0);
  EXPECT_LE(difference(view(corner), cv::Mat(corner.size(), CV_8UC1, cv::Scalar(100))), 1);
  // On the row of the center, a radius of 0.504 has 1.63 steps of the sigmas 0, 0.5 and 1 px. The
  // sampled Gaussians of the latter two keep 0.574 and 0.014 of the contrast.
  const int x = 80 + 57;
  const double contrast = std::abs(view.at<std::uint8_t>(60, x) - 100) / 100.0;
  EXPECT_NEAR(contrast, 0.37 * 0.574 + 0.63 * 0.014, 0.01);
}

TEST(Degradation, RimOfACameraHasNoiseInTheMiddle) {
  const LoadedPair pair = degraded("rimcam", constant(200, 128));
  const cv::Rect middle(60, 60, 80, 80);
  EXPECT_GT(difference(pair.left(middle), constant(200, 128).left(middle)), 0);
  EXPECT_GT(difference(pair.left, pair.right), 0);
  EXPECT_LT(cv::mean(degraded("rimcam", edge()).left(cv::Rect(19, 16, 1, 8)))[0], 20)
      << "sharp in the middle";
}

TEST(Degradation, GainAndGammaAreExact) {
  EXPECT_EQ(degraded("gain-right=0.5").right.at<std::uint8_t>(20, 30), 45);
  EXPECT_EQ(degraded("gamma-right=2").right.at<std::uint8_t>(20, 30), 32);  // 255 (90 / 255)^2
}

TEST(Degradation, LowerMovesTheContentDown) {
  const LoadedPair pair = degraded("lower-right=2");
  EXPECT_EQ(pair.right.at<std::uint8_t>(20, 30), original().right.at<std::uint8_t>(18, 30));
}

TEST(Degradation, RollTurnsClockwise) {
  // The slope of the columns is 1, that of the rows 2: to the right of the center, the content
  // comes from above.
  const LoadedPair pair = degraded("roll-right=5");
  EXPECT_LT(pair.right.at<std::uint8_t>(23, 55), original().right.at<std::uint8_t>(23, 55));
  EXPECT_EQ(pair.right.at<std::uint8_t>(23, 30), original().right.at<std::uint8_t>(23, 30));
}

TEST(Degradation, BrightSaturates) {
  const LoadedPair pair = degraded("bright=4");
  EXPECT_EQ(pair.left.at<std::uint8_t>(40, 40), 255);
  EXPECT_EQ(pair.left.at<std::uint8_t>(0, 0), 80);
}

TEST(Degradation, LeavesTheTruthAloneUnlessItEnlarges) {
  LoadedPair pair = original();
  pair.truth.disparity = cv::Mat(47, 61, CV_32FC1, cv::Scalar(7));
  for (const char* text : {"noise=5", "cam", "rim", "rimcam", "blur=2", "lower-right=1"}) {
    const DegradedPair result = degrade(parse_degradation(text), pair, 33);
    EXPECT_EQ(result.images.left.size(), pair.left.size()) << text;
    EXPECT_EQ(difference(result.images.truth.disparity, pair.truth.disparity), 0) << text;
    EXPECT_EQ(result.images.truth.scale, 1) << text;
    EXPECT_EQ(result.max_disparity, 33) << text;
    EXPECT_EQ(difference(pair.left, original().left), 0) << text << " keeps its argument";
    EXPECT_EQ(difference(pair.right, original().right), 0) << text << " keeps its argument";
  }
}

class Enlarged : public ::testing::Test {
 protected:
  void SetUp() override {
    pair_ = original();
    pair_.truth.disparity = cv::Mat(47, 61, CV_32FC1);
    pair_.truth.visible = cv::Mat(47, 61, CV_8UC1);
    for (int y = 0; y < 47; ++y) {
      for (int x = 0; x < 61; ++x) {
        pair_.truth.disparity.at<float>(y, x) = x == 9 ? std::nanf("") : 0.25F * x + y;
        pair_.truth.visible.at<std::uint8_t>(y, x) = x < 30 ? 255 : 0;
      }
    }
  }
  LoadedPair pair_;
};

TEST_F(Enlarged, ViewsAreInterpolated) {
  for (const auto& [text, scale, size] :
       {std::tuple("soft2x", 2.0, cv::Size(122, 94)), {"soft1.5x", 1.5, cv::Size(92, 70)}}) {
    const LoadedPair images = degraded(text, pair_);
    for (const cv::Mat& view : {images.left, images.right}) {
      ASSERT_EQ(view.size(), size) << text;
      for (const cv::Point at : {cv::Point(30, 21), cv::Point(50, 40), cv::Point(51, 41)}) {
        const double x = (at.x + 0.5) / scale - 0.5, y = (at.y + 0.5) / scale - 0.5;
        EXPECT_NEAR(view.at<std::uint8_t>(at), 20 + 2 * y + x, 0.6) << text << at;
      }
    }
  }
}

TEST_F(Enlarged, TruthMasksAndRangeAreEnlarged) {
  for (const char* text : {"soft2x", "cam2x"}) {
    const auto [images, max_disparity] = degrade(parse_degradation(text), pair_, 33);
    EXPECT_EQ(max_disparity, 66) << text;
    EXPECT_EQ(images.truth.scale, 2) << text;
    ASSERT_EQ(images.truth.disparity.size(), images.left.size()) << text;
    ASSERT_EQ(images.truth.visible.size(), images.left.size()) << text;
    for (int y = 0; y < 94; ++y) {
      for (int x = 0; x < 122; ++x) {
        const cv::Point source(x / 2, y / 2);
        const float got = images.truth.disparity.at<float>(y, x);
        const float expected = 2 * pair_.truth.disparity.at<float>(source);
        ASSERT_TRUE(std::isnan(expected) ? std::isnan(got) : got == expected) << text << source;
        ASSERT_EQ(images.truth.visible.at<std::uint8_t>(y, x),
                  pair_.truth.visible.at<std::uint8_t>(source));
      }
    }
  }
}

TEST_F(Enlarged, PartsOfAPixelRoundTheRangeUp) {
  for (const char* text : {"soft1.5x", "cam1.5x"}) {
    const auto [images, max_disparity] = degrade(parse_degradation(text), pair_, 33);
    EXPECT_EQ(max_disparity, 50) << text;
    EXPECT_EQ(images.truth.scale, 1.5) << text;
    EXPECT_FLOAT_EQ(images.truth.disparity.at<float>(30, 45), 1.5F * (0.25F * 30 + 20)) << text;
  }
}

TEST_F(Enlarged, PairWithoutTruthIsOnlyEnlarged) {
  const LoadedPair images = degraded("soft2x", original());
  EXPECT_TRUE(images.truth.disparity.empty());
  EXPECT_TRUE(images.truth.visible.empty());
  EXPECT_EQ(images.left.cols, 122);
}

TEST_F(Enlarged, CameraChangesTheEnlargedViews) {
  for (const auto& [text, soft] : {std::pair("cam2x", "soft2x"), {"cam1.5x", "soft1.5x"}}) {
    const LoadedPair camera = degraded(text, edge()), larger = degraded(soft, edge());
    ASSERT_EQ(camera.left.size(), larger.left.size()) << text;
    const int middle = larger.left.cols / 2;
    EXPECT_GT(cv::mean(camera.left.col(middle - 2))[0],
              cv::mean(larger.left.col(middle - 2))[0] + 5)
        << text << " is blurred after it was enlarged";
    EXPECT_GT(difference(camera.left, camera.right), 1) << text;
  }
}

}  // namespace
}  // namespace mtstereo::eval::degrade_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expect_error.hpp"

namespace mtstereo::eval::metrics_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Metrics, MatchValuesComputedByHand) {
  // errors: 0, 0.5, 1, 4, no estimate, no truth, 3 (of 100: under 5 %), 5 (of 100: 5 %)
  const cv::Mat truth = (cv::Mat_<float>(2, 4) << 10, 10, 10, 10, 10, kNan, 100, 100);
  const cv::Mat found = (cv::Mat_<float>(2, 4) << 10, 10.5F, 9, 14, kNan, 3, 103, 95);
  const Metrics m = measure(found, truth);
  EXPECT_EQ(m.known, 7);
  EXPECT_EQ(m.compared, 6);
  EXPECT_DOUBLE_EQ(m.avgerr, (0 + 0.5 + 1 + 4 + 3 + 5) / 6);
  EXPECT_DOUBLE_EQ(m.rms, std::sqrt((0.25 + 1 + 16 + 9 + 25) / 6));
  EXPECT_DOUBLE_EQ(m.d_all, 100.0 * 2 / 6);   // 4 of 10, 5 of 100
  EXPECT_DOUBLE_EQ(m.bad[0], 100.0 * 4 / 6);  // over 0.5: 1, 4, 3, 5
  EXPECT_DOUBLE_EQ(m.bad[1], 100.0 * 3 / 6);  // over 1: 4, 3, 5
  EXPECT_DOUBLE_EQ(m.bad[2], 100.0 * 3 / 6);  // over 2
  EXPECT_DOUBLE_EQ(m.bad[3], 100.0 * 1 / 6);  // over 4: 5
  EXPECT_DOUBLE_EQ(m.known_density, 100.0 * 6 / 7);
}

TEST(Metrics, CountBothThresholdsOfDAllAsOutliers) {
  const auto d_all = [](float truth, float found) {
    return measure(cv::Mat_<float>(1, 1, found), cv::Mat_<float>(1, 1, truth)).d_all;
  };
  EXPECT_EQ(d_all(60, 63), 100);      // exactly 3 px and 5 %
  EXPECT_EQ(d_all(60, 62.99F), 0);    // under 3 px
  EXPECT_EQ(d_all(60.1F, 63.1F), 0);  // 3 px, under 5 %
  EXPECT_EQ(d_all(20, 17), 100);      // 3 px, 15 %
  EXPECT_EQ(d_all(140, 147), 100);    // 5 %, where 0.05 * 140 is not 7
  EXPECT_EQ(d_all(0, 3), 100);        // a truth of 0 has no 5 %
}

TEST(Metrics, AreNanWithoutComparedPixels) {
  const cv::Mat truth = (cv::Mat_<float>(1, 2) << 1, kNan);
  const cv::Mat found = (cv::Mat_<float>(1, 2) << kNan, 1);
  const Metrics m = measure(found, truth);
  EXPECT_EQ(m.known, 1);
  EXPECT_EQ(m.compared, 0);
  EXPECT_TRUE(std::isnan(m.avgerr));
  EXPECT_TRUE(std::isnan(m.rms));
  EXPECT_TRUE(std::isnan(m.d_all));
  EXPECT_TRUE(std::isnan(m.bad[0]));
  EXPECT_EQ(m.known_density, 0);
}

TEST(Metrics, CountOnlyVisiblePixelsWithAMask) {
  const cv::Mat truth = (cv::Mat_<float>(1, 4) << 10, 10, 10, 10);
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 11, 12, 13, kNan);
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(1, 4) << 255, 0, 255, 255);
  const Metrics m = measure(found, truth, mask);
  EXPECT_EQ(m.known, 3);
  EXPECT_EQ(m.compared, 2);
  EXPECT_DOUBLE_EQ(m.avgerr, 2);
}

TEST(Metrics, OfEnlargedImagesAreInPixelsOfTheOriginal) {
  const cv::Mat truth = (cv::Mat_<float>(1, 5) << 10, 10, 80, 100, kNan);
  const cv::Mat found = (cv::Mat_<float>(1, 5) << 10.5F, 13, 83, 104, 7);
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(1, 5) << 255, 255, 0, 255, 255);
  for (const cv::Mat& visible : {cv::Mat(), mask}) {
    const Metrics original = measure(found, truth, visible);
    const Metrics enlarged = measure(2 * found, 2 * truth, visible, 2);
    EXPECT_DOUBLE_EQ(enlarged.avgerr, original.avgerr);
    EXPECT_DOUBLE_EQ(enlarged.rms, original.rms);
    EXPECT_DOUBLE_EQ(enlarged.d_all, original.d_all);
    EXPECT_EQ(enlarged.bad, original.bad);
    EXPECT_EQ(enlarged.compared, original.compared);
    EXPECT_DOUBLE_EQ(measure(2 * found, 2 * truth, visible).avgerr, 2 * original.avgerr);
  }
}

TEST(Metrics, RejectMapsOfDifferentSizes) {
  EXPECT_INPUT_ERROR(measure(cv::Mat_<float>(2, 3, 1.F), cv::Mat_<float>(2, 4, 1.F)), "4x2");
  EXPECT_INPUT_ERROR(
      measure(cv::Mat_<float>(2, 3, 1.F), cv::Mat_<float>(2, 3, 1.F), cv::Mat_<std::uint8_t>(1, 3)),
      "3x1");
}

TEST(Evaluate, TakesTheScaleOfTheTruth) {
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 20, 26, kNan, 22);
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(1, 4) << 255, 255, 255, 0);
  const GroundTruth truth{cv::Mat(1, 4, CV_32FC1, cv::Scalar(20)), mask, 2};
  const Evaluation result = evaluate(found, truth);
  EXPECT_DOUBLE_EQ(result.all.avgerr, (0 + 3 + 1) / 3.0);
  EXPECT_DOUBLE_EQ(result.noc->avgerr, (0 + 3) / 2.0);
  EXPECT_DOUBLE_EQ(result.all.d_all, 100.0 / 3);
  EXPECT_DOUBLE_EQ(result.density, 75);
}

TEST(Evaluate, MeasuresDensityOverAllPixelsOfTheImage) {
  GroundTruth truth;
  truth.disparity = (cv::Mat_<float>(1, 4) << 10, kNan, kNan, kNan);
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 10, 5, kNan, 5);
  const Evaluation e = evaluate(found, truth);
  EXPECT_DOUBLE_EQ(e.density, 75);
  EXPECT_DOUBLE_EQ(e.all.known_density, 100);
  EXPECT_FALSE(e.noc.has_value());
}

TEST(Evaluate, HasNonOccludedFiguresIfTheTruthHasAMask) {
  GroundTruth truth;
  truth.disparity = (cv::Mat_<float>(1, 2) << 10, 10);
  truth.visible = (cv::Mat_<std::uint8_t>(1, 2) << 255, 0);
  const Evaluation e = evaluate(cv::Mat((cv::Mat_<float>(1, 2) << 10, 20)), truth);
  EXPECT_DOUBLE_EQ(e.all.avgerr, 5);
  ASSERT_TRUE(e.noc.has_value());
  EXPECT_DOUBLE_EQ(e.noc->avgerr, 0);
}

TEST(Evaluate, ReadsTheLibrarysFixedPointWithItsStride) {
  // Each row has one padding value, which is not part of the map.
  const std::vector<std::int32_t> values{256, 0, 99, 1, 640, 99};
  const DisparityView view{values.data(), 2, 2, 3 * sizeof(std::int32_t)};
  const cv::Mat map = to_float(view);
  EXPECT_EQ(map.at<float>(0, 0), 1);
  EXPECT_TRUE(std::isnan(map.at<float>(0, 1)));
  EXPECT_EQ(map.at<float>(1, 0), 1 / 256.0F);
  EXPECT_EQ(map.at<float>(1, 1), 2.5F);

  GroundTruth truth;
  truth.disparity = (cv::Mat_<float>(2, 2) << 1, 1, kNan, 3);
  const Evaluation e = evaluate(view, truth);
  EXPECT_DOUBLE_EQ(e.density, 75);
  EXPECT_DOUBLE_EQ(e.all.avgerr, 0.25);
}

TEST(Evaluate, AddsTheOffsetOfTheMapToKnownDisparities) {
  const std::vector<std::int32_t> values{256, 0, 2560};
  const cv::Mat map = to_float({values.data(), 3, 1, 3 * sizeof(std::int32_t)}, -4);
  EXPECT_EQ(map.at<float>(0, 0), -3);
  EXPECT_TRUE(std::isnan(map.at<float>(0, 1)));
  EXPECT_EQ(map.at<float>(0, 2), 6);
}

Evaluation evaluation_of(double avgerr, double density) {
  Evaluation e;
  e.density = density;
  e.all.known = 10;
  e.all.compared = std::isnan(avgerr) ? 0 : 5;
  e.all.avgerr = avgerr;
  e.all.bad[1] = 2 * avgerr;
  e.all.known_density = density;
  return e;
}

TEST(Mean, WeightsErrorsButNotDensities) {
  const Evaluation a = evaluation_of(1, 10), b = evaluation_of(4, 30);
  const Evaluation m = mean({{&a, 1}, {&b, 0.5}});
  EXPECT_DOUBLE_EQ(m.all.avgerr, (1 * 1 + 4 * 0.5) / 1.5);
  EXPECT_DOUBLE_EQ(m.all.bad[1], (2 * 1 + 8 * 0.5) / 1.5);
  EXPECT_DOUBLE_EQ(m.density, 20);
  EXPECT_DOUBLE_EQ(m.all.known_density, 20);
  EXPECT_EQ(m.all.known, 20);
  EXPECT_EQ(m.all.compared, 10);
}

TEST(Mean, IgnoresPairsWithoutComparedPixelsInTheError) {
  const Evaluation a = evaluation_of(1, 10), b = evaluation_of(kNone, 0);
  const Evaluation m = mean({{&a, 1}, {&b, 1}});
  EXPECT_DOUBLE_EQ(m.all.avgerr, 1);
  EXPECT_DOUBLE_EQ(m.density, 5);
}

TEST(Mean, OfNothingIsNan) {
  const Evaluation m = mean(std::vector<WeightedEvaluation>());
  EXPECT_TRUE(std::isnan(m.all.avgerr));
  EXPECT_TRUE(std::isnan(m.density));
  EXPECT_FALSE(m.noc.has_value());
}

TEST(Mean, HasNonOccludedFiguresOfThePairsThatHaveThem) {
  const Evaluation a = evaluation_of(1, 10);
  Evaluation b = evaluation_of(4, 30);
  b.noc = b.all;
  b.noc->avgerr = 3;
  const Evaluation m = mean({{&a, 1}, {&b, 1}});
  ASSERT_TRUE(m.noc.has_value());
  EXPECT_DOUBLE_EQ(m.noc->avgerr, 3);
}

TEST(ForeignFactor, IsThatOfATruthInAnotherScale) {
  cv::Mat estimate(20, 20, CV_32F);
  cv::RNG(1).fill(estimate, cv::RNG::UNIFORM, 5, 50);
  EXPECT_NEAR(foreign_factor(estimate, estimate / 4).value_or(0), 4, 1e-3);
  EXPECT_NEAR(foreign_factor(estimate, estimate * 2).value_or(0), 0.5, 1e-3);
  EXPECT_FALSE(foreign_factor(estimate, estimate * 1.02));
  EXPECT_FALSE(foreign_factor(estimate, 500 / estimate)) << "depths";
  EXPECT_FALSE(foreign_factor(estimate, estimate * 0)) << "nothing is known";
}

}  // namespace
}  // namespace mtstereo::eval::metrics_test

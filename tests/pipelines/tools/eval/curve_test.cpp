// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expect_error.hpp"

namespace mtstereo::eval::curve_test {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
const CurveMeasure kAvgerr = kCurveMeasures[0];

CurvePoint point(double density, double avgerr) { return {density, avgerr, 2 * avgerr, avgerr}; }

// A sweep with one row: the points at the thresholds 1, 2, ...
Sweep line(std::vector<CurvePoint> points) {
  Sweep sweep;
  sweep.ratios = {0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    sweep.thresholds.push_back(static_cast<int>(i) + 1);
  }
  sweep.points = std::move(points);
  return sweep;
}

TEST(ThresholdPoints, CountPixelsWithAtLeastThatConfidence) {
  // Errors 0, 2 and 10 px; the third has no estimate, the fourth no truth.
  const cv::Mat estimate = (cv::Mat_<float>(1, 5) << 10, 10, kNoValue, 20, 30);
  const cv::Mat truth = (cv::Mat_<float>(1, 5) << 10, 12, 5, kNoValue, 20);
  const cv::Mat confidence = (cv::Mat_<std::uint8_t>(1, 5) << 200, 100, 0, 100, 1);
  const std::vector<CurvePoint> points = threshold_points(estimate, confidence, {truth, {}});
  ASSERT_EQ(points.size(), 255U);
  const auto at = [&](int threshold) { return points[static_cast<std::size_t>(threshold) - 1]; };

  EXPECT_DOUBLE_EQ(at(1).density, 80);
  EXPECT_DOUBLE_EQ(at(1).avgerr, 4);
  EXPECT_DOUBLE_EQ(at(1).d_all, 100.0 / 3);
  EXPECT_DOUBLE_EQ(at(1).bad1, 200.0 / 3);
  for (const int threshold : {2, 100}) {
    EXPECT_DOUBLE_EQ(at(threshold).density, 60) << threshold;
    EXPECT_DOUBLE_EQ(at(threshold).avgerr, 1) << threshold;
    EXPECT_DOUBLE_EQ(at(threshold).d_all, 0) << threshold;
    EXPECT_DOUBLE_EQ(at(threshold).bad1, 50) << threshold;
  }
  for (const int threshold : {101, 200}) {
    EXPECT_DOUBLE_EQ(at(threshold).density, 20) << threshold;
    EXPECT_DOUBLE_EQ(at(threshold).avgerr, 0) << threshold;
  }
  for (const int threshold : {201, 255}) {
    EXPECT_DOUBLE_EQ(at(threshold).density, 0) << threshold;
    EXPECT_TRUE(std::isnan(at(threshold).avgerr)) << threshold;
    EXPECT_TRUE(std::isnan(at(threshold).d_all)) << threshold;
    EXPECT_TRUE(std::isnan(at(threshold).bad1)) << threshold;
  }
}

TEST(ThresholdPoints, EqualTheEvaluationOfTheThresholdedMap) {
  cv::RNG random(7);
  cv::Mat estimate(37, 53, CV_32FC1), confidence(37, 53, CV_8UC1);
  GroundTruth truth{cv::Mat(37, 53, CV_32FC1), {}, 1.5};
  random.fill(estimate, cv::RNG::UNIFORM, 1, 60);
  random.fill(confidence, cv::RNG::UNIFORM, 0, 256);
  random.fill(truth.disparity, cv::RNG::UNIFORM, 1, 60);
  for (int i = 0; i < 300; ++i) {
    estimate.at<float>(random.uniform(0, 37), random.uniform(0, 53)) = kNoValue;
    truth.disparity.at<float>(random.uniform(0, 37), random.uniform(0, 53)) = kNoValue;
  }
  const std::vector<CurvePoint> points = threshold_points(estimate, confidence, truth);
  for (const int threshold : {1, 2, 77, 128, 254, 255}) {
    cv::Mat rest = estimate.clone();
    rest.setTo(kNoValue, confidence < threshold);
    const CurvePoint expected = point_of(evaluate(rest, truth));
    const CurvePoint& got = points[static_cast<std::size_t>(threshold) - 1];
    EXPECT_DOUBLE_EQ(got.density, expected.density) << threshold;
    EXPECT_NEAR(got.avgerr, expected.avgerr, 1e-9) << threshold;
    EXPECT_DOUBLE_EQ(got.d_all, expected.d_all) << threshold;
    EXPECT_DOUBLE_EQ(got.bad1, expected.bad1) << threshold;
  }
}

TEST(ThresholdPoints, RejectMapsOfDifferentSizes) {
  const cv::Mat map(4, 5, CV_32FC1, cv::Scalar(1)), other(4, 6, CV_32FC1, cv::Scalar(1));
  const cv::Mat confidence(4, 5, CV_8UC1, cv::Scalar(1)), small(3, 5, CV_8UC1, cv::Scalar(1));
  EXPECT_INPUT_ERROR(threshold_points(map, confidence, {other, {}}), "different sizes");
  EXPECT_INPUT_ERROR(threshold_points(map, small, {map, {}}), "different sizes");
}

TEST(ErrorAt, IsInterpolatedLinearlyBetweenNeighbors) {
  const Sweep sweep = line({point(60, 3), point(40, 2), point(10, 0.5)});
  EXPECT_DOUBLE_EQ(error_at(sweep, 50, kAvgerr), 2.5);
  EXPECT_DOUBLE_EQ(error_at(sweep, 45, kAvgerr), 2.25);
  EXPECT_DOUBLE_EQ(error_at(sweep, 20, kAvgerr), 1);
  EXPECT_DOUBLE_EQ(error_at(sweep, 20, kCurveMeasures[1]), 2) << "D-all has its own values";
}

TEST(ErrorAt, EqualsTheErrorOfASettingAtItsDensity) {
  const Sweep sweep = line({point(60, 3), point(40, 2), point(10, 0.5)});
  EXPECT_DOUBLE_EQ(error_at(sweep, 60, kAvgerr), 3);
  EXPECT_DOUBLE_EQ(error_at(sweep, 40, kAvgerr), 2);
  EXPECT_DOUBLE_EQ(error_at(sweep, 10, kAvgerr), 0.5);
  EXPECT_DOUBLE_EQ(error_at(line({point(30, 7)}), 30, kAvgerr), 7) << "a single point";
}

TEST(ErrorAt, IsNanOutsideTheReachedDensities) {
  const Sweep sweep = line({point(60, 3), point(40, 2), point(10, 0.5)});
  EXPECT_TRUE(std::isnan(error_at(sweep, 60.1, kAvgerr)));
  EXPECT_TRUE(std::isnan(error_at(sweep, 9.9, kAvgerr)));
  EXPECT_TRUE(std::isnan(error_at(Sweep(), 50, kAvgerr)));
}

TEST(ErrorAt, DoesNotInterpolateAcrossAPointWithoutErrors) {
  const Sweep sweep = line({point(60, 3), point(40, kNone), point(10, 0.5)});
  EXPECT_TRUE(std::isnan(error_at(sweep, 50, kAvgerr)));
  EXPECT_TRUE(std::isnan(error_at(sweep, 40, kAvgerr)));
  EXPECT_DOUBLE_EQ(error_at(sweep, 60, kAvgerr), 3);
}

TEST(ErrorAt, IsTheMinimumIfTheDensityIsReachedRepeatedly) {
  // The density rises and falls, and two settings have the same density.
  const Sweep sweep = line({point(20, 5), point(40, 1), point(20, 2), point(20, 1.5)});
  EXPECT_DOUBLE_EQ(error_at(sweep, 30, kAvgerr), 1.5);
  EXPECT_DOUBLE_EQ(error_at(sweep, 20, kAvgerr), 1.5);
}

// Two ratios and three thresholds; the rows intersect near 40 %.
Sweep crossing() {
  Sweep sweep;
  sweep.ratios = {0, 50};
  sweep.thresholds = {0, 1, 2};
  sweep.points = {point(60, 2.0), point(50, 1.5), point(30, 1.0),
                  point(45, 1.9), point(30, 0.5), point(10, 0.2)};
  return sweep;
}

TEST(Envelope, IsTheMinimumOverRowsAndColumns) {
  const Sweep sweep = crossing();
  // At 45 % the first row has 1.375 between 50 and 30 %, and the second row and the first column
  // have a setting with 1.9; the second column has 1.25 between 50 and 30 %.
  EXPECT_DOUBLE_EQ(error_at(sweep, 45, kAvgerr), 1.25);
  EXPECT_DOUBLE_EQ(error_at(sweep, 30, kAvgerr), 0.5);
  EXPECT_DOUBLE_EQ(error_at(sweep, 20, kAvgerr), 0.35) << "only the second row";
  EXPECT_DOUBLE_EQ(error_at(sweep, 60, kAvgerr), 2.0);
  EXPECT_TRUE(std::isnan(error_at(sweep, 5, kAvgerr)));
}

TEST(Envelope, IsNeverAboveALineOfTheSweep) {
  const Sweep sweep = crossing();
  for (std::size_t column = 0; column < sweep.thresholds.size(); ++column) {
    const Sweep one = at_threshold(sweep, column);
    for (double density = 0; density <= 100; density += 0.5) {
      const double single = error_at(one, density, kAvgerr);
      if (std::isnan(single)) continue;
      EXPECT_LE(error_at(sweep, density, kAvgerr), single) << column << " at " << density;
    }
  }
}

TEST(Envelope, IsComputedForEachMeasureSeparately) {
  Sweep sweep = line({{30, 1, 9, 9}});
  sweep.ratios = {0, 50};
  sweep.points.push_back({30, 2, 3, 4});
  EXPECT_DOUBLE_EQ(error_at(sweep, 30, kCurveMeasures[0]), 1);
  EXPECT_DOUBLE_EQ(error_at(sweep, 30, kCurveMeasures[1]), 3);
  EXPECT_DOUBLE_EQ(error_at(sweep, 30, kCurveMeasures[2]), 4);
}

TEST(DensityAt, IsInterpolatedLinearlyBetweenNeighbors) {
  const Sweep sweep = line({point(60, 3), point(40, 2), point(10, 0.5)});
  EXPECT_DOUBLE_EQ(density_at(sweep, 2.5, kAvgerr), 50);
  EXPECT_DOUBLE_EQ(density_at(sweep, 2, kAvgerr), 40);
  EXPECT_DOUBLE_EQ(density_at(sweep, 1, kAvgerr), 20);
  EXPECT_DOUBLE_EQ(density_at(sweep, 1, kCurveMeasures[1]), 10) << "D-all has its own values";
}

TEST(DensityAt, IsTheLargestReachedIfAllErrorsAreSmaller) {
  const Sweep sweep = line({point(60, 3), point(40, 2), point(10, 0.5)});
  EXPECT_DOUBLE_EQ(density_at(sweep, 3, kAvgerr), 60);
  EXPECT_DOUBLE_EQ(density_at(sweep, 99, kAvgerr), 60);
  EXPECT_DOUBLE_EQ(density_at(line({point(30, 7)}), 7, kAvgerr), 30) << "a single point";
}

TEST(DensityAt, IsNanIfAllErrorsAreLargerOrUnknown) {
  EXPECT_TRUE(std::isnan(density_at(line({point(60, 3), point(10, 0.5)}), 0.4, kAvgerr)));
  EXPECT_TRUE(std::isnan(density_at(line({point(60, kNone)}), 5, kAvgerr)));
  EXPECT_TRUE(std::isnan(density_at(Sweep(), 5, kAvgerr)));
}

TEST(DensityAt, DoesNotInterpolateAcrossAPointWithoutErrors) {
  const Sweep sweep = line({point(60, 3), point(40, kNone), point(10, 0.5)});
  EXPECT_DOUBLE_EQ(density_at(sweep, 2, kAvgerr), 10);
}

TEST(DensityAt, IsTheLargestIfTheErrorIsReachedRepeatedly) {
  // The error falls while the density rises, then rises.
  const Sweep sweep = line({point(60, 5), point(50, 1), point(30, 4), point(10, 0)});
  EXPECT_DOUBLE_EQ(density_at(sweep, 2, kAvgerr), 52.5);
  EXPECT_DOUBLE_EQ(density_at(sweep, 0.5, kAvgerr), 12.5);
  EXPECT_DOUBLE_EQ(density_at(line({point(60, 1), point(30, 4)}), 2, kAvgerr), 60);
}

TEST(DensityAt, IsTheInverseOfTheErrorOnALineThatRises) {
  const Sweep sweep = line({point(70, 3), point(40, 2), point(10, 0.5)});
  for (double density = 10; density <= 70; density += 2.5) {
    EXPECT_NEAR(density_at(sweep, error_at(sweep, density, kAvgerr), kAvgerr), density, 1e-9);
  }
}

TEST(Envelope, ReachesTheLargestDensityOverRowsAndColumns) {
  const Sweep sweep = crossing();
  EXPECT_DOUBLE_EQ(density_at(sweep, 1.5, kAvgerr), 50) << "the second setting of the first row";
  // Between the first and the second setting of the first row and of the second column.
  EXPECT_DOUBLE_EQ(density_at(sweep, 1.25, kAvgerr), 45);
  EXPECT_TRUE(std::isnan(density_at(sweep, 0.1, kAvgerr)));
}

TEST(AtThreshold, IsTheColumn) {
  const Sweep column = at_threshold(crossing(), 1);
  EXPECT_EQ(column.ratios, (std::vector<int>{0, 50}));
  EXPECT_EQ(column.thresholds, std::vector<int>{1});
  ASSERT_EQ(column.points.size(), 2U);
  EXPECT_EQ(column.points[0].avgerr, 1.5);
  EXPECT_EQ(column.points[1].avgerr, 0.5);
}

TEST(DensityRange, IgnoresPointsWithoutErrors) {
  const DensityRange range = density_range(line({point(80, kNone), point(60, 3), point(0, kNone)}));
  EXPECT_EQ(range.least, 60);
  EXPECT_EQ(range.most, 60);
  EXPECT_TRUE(std::isnan(density_range(line({point(0, kNone)})).most));
}

}  // namespace
}  // namespace mtstereo::eval::curve_test

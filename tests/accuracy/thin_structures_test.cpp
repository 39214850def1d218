// SPDX-License-Identifier: LGPL-2.1-or-later
#include "thin_structures.hpp"

#include <gtest/gtest.h>

#include "lib/outputs/user_error.hpp"
#include "tools/eval/metrics.hpp"

namespace mtstereo::tests::thin_structures_test {
namespace {

using eval::kNone;

/// A background at 5 px with a bar at 15 px in the columns x0 .. x1 - 1.
cv::Mat with_bar(int x0, int x1) {
  cv::Mat truth(40, 60, CV_32FC1, cv::Scalar(5));
  truth.colRange(x0, x1).setTo(15);
  return truth;
}

TEST(ThinStructures, AreNarrowerThanTheLimitInOneDirection) {
  EXPECT_EQ(40 * 3, measure_thin(with_bar(20, 23), with_bar(20, 23)).thin);
  EXPECT_EQ(40 * kMostThin,
            measure_thin(with_bar(20, 20 + kMostThin), with_bar(20, 20 + kMostThin)).thin);
  EXPECT_EQ(0, measure_thin(with_bar(20, 21 + kMostThin), with_bar(20, 21 + kMostThin)).thin);
  const cv::Mat level = with_bar(20, 23).t();
  EXPECT_EQ(40 * 3, measure_thin(level, level).thin);
}

TEST(ThinStructures, AreFoundOrPaintedOverOrUnknown) {
  const cv::Mat truth = with_bar(20, 24);
  cv::Mat estimate = truth.clone();
  estimate.col(20).setTo(5.5);
  estimate.col(21).setTo(kNone);
  estimate.col(22).setTo(16.4);
  const ThinCounts counts = measure_thin(estimate, truth);
  EXPECT_EQ(160, counts.thin);
  EXPECT_EQ(80, counts.found);
  EXPECT_EQ(40, counts.painted);
  EXPECT_DOUBLE_EQ(50, counts.recall());
  EXPECT_DOUBLE_EQ(25, counts.painted_over());
}

TEST(ThinStructures, HaveARim) {
  const cv::Mat truth = with_bar(20, 24);
  cv::Mat estimate = truth.clone();
  estimate.col(24).setTo(15);
  estimate.col(28).setTo(6.5);
  estimate.col(29).setTo(6.5);
  estimate.col(19).setTo(4);
  const ThinCounts counts = measure_thin(estimate, truth);
  EXPECT_EQ(40 * 10, counts.rim);
  EXPECT_EQ(40 * 2, counts.false_rim);
  EXPECT_EQ(40 * 46, counts.far);
  EXPECT_EQ(40, counts.false_far);
  ThinCounts twice = counts;
  twice += counts;
  EXPECT_DOUBLE_EQ(counts.rim_share(), twice.rim_share());
  EXPECT_EQ(2 * 40 * 46, twice.far);
}

TEST(ThinStructures, NeedATruth) {
  cv::Mat truth = with_bar(20, 24);
  truth.rowRange(0, 10).setTo(kNone);
  truth.col(19).setTo(kNone);
  const ThinCounts counts = measure_thin(with_bar(20, 24), truth);
  EXPECT_EQ(30 * 4, counts.thin);
  EXPECT_EQ(30 * 9, counts.rim);
  EXPECT_EQ(0, ThinCounts().recall());
}

TEST(ThinStructures, RefuseAnotherSize) {
  EXPECT_THROW(measure_thin(cv::Mat(40, 59, CV_32FC1), with_bar(20, 24)), UserError);
}

}  // namespace
}  // namespace mtstereo::tests::thin_structures_test

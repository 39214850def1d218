// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/curve_means.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mtstereo::eval::curve_means_test {
namespace {

using ::testing::HasSubstr;

// Two thresholds.
Sweep sweep_of(const CurvePoint& first, const CurvePoint& second) {
  return {{0}, {1, 2}, {first, second}};
}

const CurvePoint kNothing{0, kNone, kNone, kNone};

TEST(SweepMean, IsTheUnweightedMeanOverThePairs) {
  SweepMean mean;
  mean.add(sweep_of({60, 1, 10, 20}, {30, 0.5, 5, 10}));
  mean.add(sweep_of({40, 3, 30, 40}, {10, 1.5, 7, 12}));
  const Sweep result = mean.mean();
  EXPECT_EQ(result.thresholds, (std::vector<int>{1, 2}));
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_DOUBLE_EQ(result.points[0].density, 50);
  EXPECT_DOUBLE_EQ(result.points[0].avgerr, 2);
  EXPECT_DOUBLE_EQ(result.points[0].d_all, 20);
  EXPECT_DOUBLE_EQ(result.points[0].bad1, 30);
  EXPECT_DOUBLE_EQ(result.points[1].density, 20);
  EXPECT_DOUBLE_EQ(result.points[1].avgerr, 1);
}

TEST(SweepMean, HasNoErrorIfOnePairHasNone) {
  for (const bool first : {true, false}) {
    SweepMean mean;
    mean.add(sweep_of({60, 1, 10, 20}, first ? kNothing : CurvePoint{30, 0.5, 5, 10}));
    mean.add(sweep_of({40, 3, 30, 40}, first ? CurvePoint{30, 0.5, 5, 10} : kNothing));
    EXPECT_DOUBLE_EQ(mean.mean().points[0].avgerr, 2);
    EXPECT_TRUE(std::isnan(mean.mean().points[1].avgerr));
    EXPECT_TRUE(std::isnan(mean.mean().points[1].bad1));
    EXPECT_DOUBLE_EQ(mean.mean().points[1].density, 15) << "an empty map has the density 0 %";
  }
}

TEST(SweepMean, IsEmptyWithoutPairs) { EXPECT_TRUE(SweepMean().mean().points.empty()); }

TEST(CurveCollector, AcceptsPairsThatAllMethodsCompleted) {
  const Sweep good = sweep_of({60, 1, 10, 20}, kNothing);
  const Sweep other = sweep_of({40, 3, 30, 40}, kNothing);
  CurveCollector collector({"mtstereo", "sgbm"});
  collector.add("A", {{"mtstereo", good}, {"sgbm", other}});
  collector.add("B", {{"mtstereo", other}});
  collector.add("C", {{"mtstereo", sweep_of(kNothing, kNothing)}, {"sgbm", good}});
  collector.add("D", {{"sgbm", other}, {"mtstereo", other}});
  const CurveMeans means = collector.means();
  EXPECT_EQ(means.pairs, 2);
  ASSERT_EQ(means.methods.size(), 2U);
  EXPECT_EQ(means.methods[0].method, "mtstereo");
  EXPECT_DOUBLE_EQ(means.methods[0].sweep.points[0].avgerr, 2);
  EXPECT_EQ(means.methods[1].method, "sgbm");
  EXPECT_DOUBLE_EQ(means.methods[1].sweep.points[0].avgerr, 3);
  ASSERT_EQ(means.left_out.size(), 2U);
  EXPECT_EQ(means.left_out[0].pair, "B");
  EXPECT_THAT(means.left_out[0].reason, HasSubstr("sgbm"));
  EXPECT_EQ(means.left_out[1].pair, "C");
  EXPECT_THAT(means.left_out[1].reason, HasSubstr("mtstereo has no disparity"));
}

TEST(CurveCollector, HasNoCurvesWithoutPairs) {
  CurveCollector collector({"mtstereo"});
  EXPECT_EQ(collector.means().pairs, 0);
  collector.add("A", {});
  EXPECT_EQ(collector.means().pairs, 0);
  EXPECT_TRUE(collector.means().methods.empty());
  EXPECT_EQ(collector.means().left_out.size(), 1U);
}

}  // namespace
}  // namespace mtstereo::eval::curve_means_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/official.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expect_error.hpp"

namespace mtstereo::eval::official_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

StereoPair pair_of(Layout layout) {
  StereoPair pair;
  pair.layout = layout;
  return pair;
}

GroundTruth truth_of(const cv::Mat& disparity) {
  GroundTruth truth;
  truth.disparity = disparity;
  return truth;
}

OfficialCounts count(Layout layout, const cv::Mat& estimate, const GroundTruth& truth) {
  return count_official(estimate, pair_of(layout), truth).value();
}

TEST(IsWrong, NeedsBothThresholdsOfKittiExceeded) {
  EXPECT_FALSE(is_wrong(Benchmark::kKitti2015, 3, 10));  // exactly 3 px
  EXPECT_TRUE(is_wrong(Benchmark::kKitti2015, 3.01, 10));
  EXPECT_FALSE(is_wrong(Benchmark::kKitti2015, 4, 100));  // 4 %
  EXPECT_FALSE(is_wrong(Benchmark::kKitti2015, 7, 140));  // exactly 5 %
  EXPECT_TRUE(is_wrong(Benchmark::kKitti2015, 7.01, 140));
}

TEST(IsWrong, NeedsTheOnlyThresholdOfTheOthersExceeded) {
  EXPECT_FALSE(is_wrong(Benchmark::kMiddlebury, 2, 1));
  EXPECT_TRUE(is_wrong(Benchmark::kMiddlebury, 2.01, 1000));
  EXPECT_FALSE(is_wrong(Benchmark::kEth3d, 1, 1));
  EXPECT_TRUE(is_wrong(Benchmark::kEth3d, 1.01, 1000));
}

TEST(Official, HasNoMeasuresOfOtherDataSets) {
  const cv::Mat map = (cv::Mat_<float>(1, 1) << 1);
  for (const Layout layout : {Layout::kDriving, Layout::kMonkaa, Layout::kFlyingThings,
                              Layout::kTrimbotReal, Layout::kTrimbotSynthetic}) {
    EXPECT_FALSE(count_official(map, pair_of(layout), truth_of(map)).has_value());
  }
}

TEST(Official, CountsEnlargedImagesInPixelsOfTheOriginal) {
  const cv::Mat truth = (cv::Mat_<float>(1, 4) << 100, 10, 10, 10);
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 104, 13.5F, 11.5F, 12.5F);
  const cv::Mat large_truth = 2 * truth, large_found = 2 * found;
  for (const Layout layout : {Layout::kKitti2015, Layout::kMiddlebury, Layout::kEth3d}) {
    const RegionCounts original = *count(layout, found, truth_of(truth)).all;
    const RegionCounts enlarged = *count(layout, large_found, {large_truth, {}, {}, 2}).all;
    EXPECT_EQ(enlarged.all.wrong, original.all.wrong) << layout_name(layout);
    EXPECT_EQ(enlarged.all.answered_wrong, original.all.answered_wrong) << layout_name(layout);
    EXPECT_DOUBLE_EQ(enlarged.error_sum, original.error_sum) << layout_name(layout);
  }
}

TEST(OfficialKitti, JudgesGapsByTheirBackgroundAndEstimatesAlone) {
  // Truth is sparse. The gap at column 2 becomes 10, which is right at neither pixel: 20 is wrong,
  // at column 3 the truth is unknown. The gap at column 5 becomes 10, which is right.
  const cv::Mat truth = (cv::Mat_<float>(1, 6) << 10, 30, 20, kNan, 10, 11);
  const cv::Mat found = (cv::Mat_<float>(1, 6) << 10, 40, kNan, kNan, 10, kNan);
  const OfficialCounts counts = count(Layout::kKitti2015, found, truth_of(truth));
  ASSERT_TRUE(counts.all.has_value());
  EXPECT_FALSE(counts.noc.has_value());
  EXPECT_EQ(counts.all->all.pixels, 5);
  EXPECT_EQ(counts.all->all.wrong, 2);  // 40 for 30, 10 for 20
  EXPECT_EQ(counts.all->all.answered, 3);
  EXPECT_EQ(counts.all->all.answered_wrong, 1);
  const OfficialFigures figures = figures_of(*counts.all);
  EXPECT_DOUBLE_EQ(figures.wrong, 40);
  EXPECT_DOUBLE_EQ(figures.answered_wrong, 100.0 / 3);
  EXPECT_DOUBLE_EQ(figures.density, 60);
  EXPECT_TRUE(std::isnan(figures.background));
  EXPECT_TRUE(std::isnan(figures.foreground));
}

TEST(OfficialKitti, SplitsBackgroundAndForegroundByTheObjectMap) {
  GroundTruth truth = truth_of((cv::Mat_<float>(1, 5) << 10, 10, 10, kNan, 10));
  truth.objects = (cv::Mat_<std::uint8_t>(1, 5) << 0, 0, 255, 255, 255);
  const cv::Mat found = (cv::Mat_<float>(1, 5) << 10, 20, 10, 50, 20);
  const OfficialFigures figures = figures_of(*count(Layout::kKitti2015, found, truth).all);
  EXPECT_DOUBLE_EQ(figures.background, 50);
  EXPECT_DOUBLE_EQ(figures.foreground, 50);
  EXPECT_DOUBLE_EQ(figures.wrong, 50);
  EXPECT_EQ(figures.pixels, 4);
}

TEST(OfficialKitti, CountsRowsThatCannotBeFilledAsWrong) {
  const cv::Mat truth(3, 1, CV_32FC1, cv::Scalar(1));
  const cv::Mat found = (cv::Mat_<float>(3, 1) << 1, kNan, 1);
  EXPECT_EQ(count(Layout::kKitti2015, found, truth_of(truth)).all->all.wrong, 1);
}

TEST(OfficialKitti, FillsBeforeTheRegionsAreSelected) {
  GroundTruth truth = truth_of((cv::Mat_<float>(1, 3) << 10, 10, 10));
  truth.visible = (cv::Mat_<std::uint8_t>(1, 3) << 0, 255, 0);
  const cv::Mat found = (cv::Mat_<float>(1, 3) << 2, kNan, 10);
  const OfficialCounts counts = count(Layout::kKitti2015, found, truth);
  ASSERT_TRUE(counts.noc.has_value());
  EXPECT_EQ(counts.noc->all.pixels, 1);
  EXPECT_EQ(counts.noc->all.wrong, 1);  // the background is the occluded 2
  EXPECT_EQ(counts.all->all.wrong, 2);
}

TEST(OfficialKitti, HasOnlyTheRegionNocOfVisibleTruth) {
  StereoPair pair = pair_of(Layout::kKitti2015);
  pair.truth_is_visible = true;
  const cv::Mat map = (cv::Mat_<float>(1, 1) << 7);
  const OfficialCounts counts = count_official(map, pair, truth_of(map)).value();
  EXPECT_FALSE(counts.all.has_value());
  ASSERT_TRUE(counts.noc.has_value());
  EXPECT_EQ(counts.noc->all.pixels, 1);
}

TEST(OfficialMiddlebury, CountsPixelsWithoutDisparityAsWrong) {
  GroundTruth truth = truth_of((cv::Mat_<float>(1, 6) << 10, 10, 10, 10, kNan, 10));
  truth.visible = (cv::Mat_<std::uint8_t>(1, 6) << 255, 255, 255, 0, 255, 255);
  const cv::Mat found = (cv::Mat_<float>(1, 6) << 10, 12, 12.5F, 20, 1, kNan);
  const OfficialCounts counts = count(Layout::kMiddlebury, found, truth);
  const OfficialFigures all = figures_of(*counts.all), noc = figures_of(counts.noc.value());
  EXPECT_DOUBLE_EQ(all.wrong, 60);           // 12.5, 20 and the gap
  EXPECT_DOUBLE_EQ(all.answered_wrong, 50);  // 12.5 and 20 of four
  EXPECT_DOUBLE_EQ(all.avgerr, (0 + 2 + 2.5 + 10) / 4);
  EXPECT_DOUBLE_EQ(all.density, 80);
  EXPECT_DOUBLE_EQ(noc.wrong, 50);  // 12.5 and the gap
  EXPECT_DOUBLE_EQ(noc.answered_wrong, 100.0 / 3);
  EXPECT_DOUBLE_EQ(noc.avgerr, 1.5);
  EXPECT_DOUBLE_EQ(noc.density, 75);
}

TEST(OfficialEth3d, CountsErrorsOverOnePixel) {
  const cv::Mat truth = (cv::Mat_<float>(1, 4) << 10, 10, 10, 10);
  const cv::Mat found = (cv::Mat_<float>(1, 4) << 11, 11.5F, kNan, 10);
  const OfficialCounts counts = count(Layout::kEth3d, found, truth_of(truth));
  EXPECT_FALSE(counts.noc.has_value()) << "there is no mask";
  const OfficialFigures figures = figures_of(*counts.all);
  EXPECT_DOUBLE_EQ(figures.wrong, 50);
  EXPECT_DOUBLE_EQ(figures.answered_wrong, 100.0 / 3);
  EXPECT_DOUBLE_EQ(figures.avgerr, (1 + 1.5) / 3);
}

TEST(Official, FiguresAreNanWithoutTruthOrEstimate) {
  const cv::Mat unknown = (cv::Mat_<float>(1, 2) << kNan, kNan);
  const cv::Mat known = (cv::Mat_<float>(1, 2) << 5, 5);
  const OfficialFigures none = figures_of(*count(Layout::kEth3d, known, truth_of(unknown)).all);
  EXPECT_TRUE(std::isnan(none.wrong));
  EXPECT_TRUE(std::isnan(none.density));
  const OfficialFigures gap = figures_of(*count(Layout::kEth3d, unknown, truth_of(known)).all);
  EXPECT_DOUBLE_EQ(gap.wrong, 100);
  EXPECT_TRUE(std::isnan(gap.answered_wrong));
  EXPECT_TRUE(std::isnan(gap.avgerr));
  EXPECT_DOUBLE_EQ(gap.density, 0);
  const OfficialFigures empty =
      figures_of(*count(Layout::kKitti2015, unknown, truth_of(known)).all);
  EXPECT_DOUBLE_EQ(empty.wrong, 100) << "a map without disparity cannot be filled";
}

TEST(Official, RejectsMapsOfAnotherSize) {
  const cv::Mat map = (cv::Mat_<float>(1, 2) << 1, 2);
  const StereoPair pair = pair_of(Layout::kKitti2015);
  GroundTruth truth = truth_of(cv::Mat_<float>(2, 2, 1.F));
  EXPECT_INPUT_ERROR(count_official(map, pair, truth),
                     "the ground truth is 2x2, the disparity map 2x1");
  truth.disparity = map;
  truth.visible = cv::Mat_<std::uint8_t>(1, 3);
  EXPECT_INPUT_ERROR(count_official(map, pair, truth), "the mask is 3x1");
  truth.visible = cv::Mat();
  truth.objects = cv::Mat_<std::uint8_t>(4, 1);
  EXPECT_INPUT_ERROR(count_official(map, pair, truth), "the object map is 1x4");
}

RegionCounts region_of(std::int64_t pixels, std::int64_t wrong, std::int64_t answered) {
  RegionCounts region;
  region.all = {pixels, wrong, answered, 0};
  region.error_sum = static_cast<double>(answered);
  return region;
}

TEST(OfficialMean, OfKittiIsThatOfAllPixelsTogether) {
  RegionCounts a = region_of(100, 10, 50), b = region_of(300, 90, 300);
  a.foreground = {10, 5, 10, 5};
  a.background = {90, 5, 40, 0};
  const OfficialFigures mean = official_mean(Benchmark::kKitti2015, {{&a, 1}, {&b, 1}});
  EXPECT_DOUBLE_EQ(mean.wrong, 25);
  EXPECT_DOUBLE_EQ(mean.density, 87.5);
  EXPECT_DOUBLE_EQ(mean.foreground, 50) << "only the pair with an object map";
  EXPECT_EQ(mean.pixels, 400);
}

TEST(OfficialMean, OfTheOthersIsWeightedByPairs) {
  RegionCounts a = region_of(100, 10, 50), b = region_of(300, 90, 300);
  b.error_sum = 900;
  const OfficialFigures mean = official_mean(Benchmark::kMiddlebury, {{&a, 1}, {&b, 0.5}});
  EXPECT_DOUBLE_EQ(mean.wrong, (10 + 0.5 * 30) / 1.5);
  EXPECT_DOUBLE_EQ(mean.avgerr, (1 + 0.5 * 3) / 1.5);
  EXPECT_DOUBLE_EQ(mean.density, 75);
  EXPECT_EQ(mean.answered, 350);
}

TEST(OfficialMean, OfNothingIsNan) {
  EXPECT_TRUE(std::isnan(official_mean(Benchmark::kKitti2015, {}).wrong));
  EXPECT_TRUE(std::isnan(official_mean(Benchmark::kEth3d, {}).wrong));
}

}  // namespace
}  // namespace mtstereo::eval::official_test

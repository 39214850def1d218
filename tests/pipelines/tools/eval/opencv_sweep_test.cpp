// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/opencv_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/runner.hpp"

namespace mtstereo::eval::opencv_sweep_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

LoadedPair test_images() {
  testing::TestPair pair = testing::make_pair(240, 120, 9);
  pair.truth.setTo(std::numeric_limits<float>::quiet_NaN(), pair.truth > 1e6);
  return {pair.left, pair.right, {pair.truth, {}}};
}

FilterSettings filters(int speckle_size) {
  FilterSettings settings;
  settings.speckle_size = speckle_size;
  return settings;
}

TEST(RivalSweep, HasTheUnfilteredAndTheFilteredMaps) {
  const LoadedPair images = test_images();
  const Sweep sweep = sweep_opencv(OpenCvMethod::kSgbm3Way, 32, images, filters(20));
  ASSERT_EQ(sweep.ratios.size(), kUniquenessRatios.size());
  ASSERT_EQ(sweep.thresholds.size(), 256U);
  ASSERT_EQ(sweep.points.size(), sweep.ratios.size() * sweep.thresholds.size());

  OpenCvMatcher matcher(OpenCvMethod::kSgbm3Way, 32);
  matcher.compute(images.left, images.right);
  const CurvePoint expected = point_of(evaluate(matcher.disparity(), images.truth));
  ASSERT_EQ(sweep.ratios[2], kUniquenessRatio);
  EXPECT_DOUBLE_EQ(sweep.at(2, 0).density, expected.density);
  EXPECT_DOUBLE_EQ(sweep.at(2, 0).avgerr, expected.avgerr);
}

TEST(RivalSweep, CountsErrorsAtTheScaleOfTheTruth) {
  LoadedPair images = test_images();
  images.truth.disparity += 1;
  const Sweep original = sweep_opencv(OpenCvMethod::kBm, 32, images, filters(20));
  images.truth.scale = 2;
  const Sweep halved = sweep_opencv(OpenCvMethod::kBm, 32, images, filters(20));
  for (const std::size_t threshold : {0, 1, 200}) {
    ASSERT_GT(original.at(0, threshold).avgerr, 0.5);
    EXPECT_NEAR(halved.at(0, threshold).avgerr, original.at(0, threshold).avgerr / 2, 1e-9);
    EXPECT_EQ(halved.at(0, threshold).density, original.at(0, threshold).density);
  }
}

TEST(RivalSweep, GetsSparserWithEveryThreshold) {
  const Sweep sweep = sweep_opencv(OpenCvMethod::kSgbm, 32, test_images(), filters(20));
  for (std::size_t i = 0; i < sweep.ratios.size(); ++i) {
    for (std::size_t j = 1; j < sweep.thresholds.size(); ++j) {
      ASSERT_LE(sweep.at(i, j).density, sweep.at(i, j - 1).density) << i << "," << j;
    }
  }
  EXPECT_GT(sweep.at(0, 0).density, sweep.at(0, 255).density);
}

TEST(RivalSweep, GetsSparserWithTheUniquenessRatio) {
  // Noise reduces the difference between the best and the second-best cost.
  LoadedPair images = test_images();
  cv::Mat noise(images.right.size(), CV_8UC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::UNIFORM, 0, 90);
  images.right = images.right * 0.6 + noise;
  for (const OpenCvMethod method :
       {OpenCvMethod::kSgbm, OpenCvMethod::kSgbm3Way, OpenCvMethod::kSgbmHh, OpenCvMethod::kBm}) {
    const Sweep sweep = sweep_opencv(method, 32, images, filters(20));
    EXPECT_LT(sweep.at(19, 0).density, 0.9 * sweep.at(0, 0).density) << opencv_name(method);
  }
}

TEST(RivalSweep, RemovesComponentsBelowTheSize) {
  const Sweep all = sweep_opencv(OpenCvMethod::kBm, 32, test_images(), filters(0));
  const Sweep none = sweep_opencv(OpenCvMethod::kBm, 32, test_images(), filters(240 * 120 + 1));
  EXPECT_EQ(all.at(0, 1).density, all.at(0, 0).density);
  EXPECT_GT(none.at(0, 0).density, 0);
  EXPECT_EQ(none.at(0, 1).density, 0);
}

TEST(RivalSweep, ReportsThatOpenCvRejectsTheImages) {
  LoadedPair images = test_images();
  images.right = images.right.colRange(0, 200);
  EXPECT_INPUT_ERROR(sweep_opencv(OpenCvMethod::kSgbm, 32, images, filters(20)), "OpenCV rejects");
}

TEST(RivalSweep, ReportsItsRatios) {
  const std::string text = opencv_settings(OpenCvMethod::kSgbm, uniqueness_ratios_text());
  EXPECT_THAT(text, HasSubstr("uniquenessRatio 0 5 10 "));
  EXPECT_THAT(text, HasSubstr("90 95,"));
  EXPECT_THAT(opencv_settings(OpenCvMethod::kSgbm), HasSubstr("uniquenessRatio 10,"));
}

class RunningWithACurve : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_pair_folder(folder_ / "A", testing::make_pair(240, 120, 9), 32);
    pairs_ = find_pairs(folder_.path(), Layout::kMiddlebury).pairs;
    settings_.opencv_methods = {OpenCvMethod::kBm};
  }
  testing::TemporaryFolder folder_;
  std::vector<StereoPair> pairs_;
  RunSettings settings_;
};

TEST_F(RunningWithACurve, StartsWithTheUnthresholdedResult) {
  settings_.curve = true;
  const PairReport report = Runner(settings_).run(pairs_[0]);
  ASSERT_TRUE(report.failures.empty()) << report.failures[0];
  ASSERT_EQ(report.sweeps.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(report.sweeps[i].method, report.results[i].method);
  }
  const Evaluation& own = report.results[0].evaluation;
  const CurvePoint& first = report.sweeps[0].sweep.points.at(0);
  EXPECT_DOUBLE_EQ(first.density, own.density);
  EXPECT_NEAR(first.avgerr, own.all.avgerr, 1e-9);
  EXPECT_LT(report.sweeps[0].sweep.points.at(254).density, own.density);
}

TEST_F(RunningWithACurve, IsNotRunByDefault) {
  const PairReport report = Runner(settings_).run(pairs_[0]);
  EXPECT_EQ(report.results.size(), 2U);
  EXPECT_TRUE(report.sweeps.empty());
}

}  // namespace
}  // namespace mtstereo::eval::opencv_sweep_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/runner.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "expect_error.hpp"
#include "support.hpp"
#include "tools/eval/pfm.hpp"

namespace mtstereo::eval::runner_test {
namespace {

using testing::make_pair;
using testing::TemporaryFolder;
using testing::write_pair_folder;

StereoPair pair_with_range(std::optional<int> range) {
  StereoPair pair;
  pair.name = "pair";
  pair.left = "folder/im0.png";
  pair.max_disparity = range;
  return pair;
}

TEST(SearchRange, IsThatOfTheDataSetByDefault) {
  Parameters parameters;
  std::vector<std::string> notes;
  EXPECT_EQ(search_range(pair_with_range(30), parameters, 200, notes), 30);
  ASSERT_TRUE(parameters.set(Parameter::kMaxDisparity, 50).ok());
  EXPECT_EQ(search_range(pair_with_range(30), parameters, 200, notes), 50);
  EXPECT_EQ(search_range(pair_with_range(std::nullopt), parameters, 200, notes), 50);
  EXPECT_TRUE(notes.empty());
}

TEST(SearchRange, IsLimitedToTheImageWidthWithANote) {
  std::vector<std::string> notes;
  EXPECT_EQ(search_range(pair_with_range(300), Parameters(), 200, notes), 200);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], ::testing::AllOf(::testing::HasSubstr("200"), ::testing::HasSubstr("300")));
}

TEST(SearchRange, IsLimitedToTheRangeOfTheLibraryWithANote) {
  std::vector<std::string> notes;
  EXPECT_EQ(search_range(pair_with_range(5000), Parameters(), 9000, notes), kLargestMaxDisparity);
  EXPECT_EQ(notes.size(), 1U);
}

TEST(SearchRange, ThatIsUnknownIsAnErrorWithASolution) {
  std::vector<std::string> notes;
  EXPECT_INPUT_ERROR(search_range(pair_with_range(std::nullopt), Parameters(), 200, notes),
                     "--max-disparity");
}

TEST(MedianSeconds, IgnoresTheWarmUp) {
  using namespace std::chrono_literals;
  int frames = 0;
  // The two warm-up frames and one of the three timed frames are slow.
  const double seconds = median_seconds(2, 3, [&] {
    ++frames;
    if (frames <= 3) std::this_thread::sleep_for(200ms);
  });
  EXPECT_EQ(frames, 5);
  EXPECT_LT(seconds, 0.15);
}

TEST(MedianSeconds, IsTheTimeOfOneFrame) {
  using namespace std::chrono_literals;
  EXPECT_GE(median_seconds(0, 2, [] { std::this_thread::sleep_for(20ms); }), 0.02);
}

class Running : public ::testing::Test {
 protected:
  void SetUp() override {
    write_pair_folder(folder_ / "A", make_pair(240, 120, 9), 32);
    write_pair_folder(folder_ / "B", make_pair(200, 100, 5), 16);
    pairs_ = find_pairs(folder_.path(), Layout::kMiddlebury).pairs;
  }
  TemporaryFolder folder_;
  std::vector<StereoPair> pairs_;
};

TEST_F(Running, FindsTheShiftOfARenderedPair) {
  Runner runner({});
  const PairReport report = runner.run(pairs_[0]);
  ASSERT_TRUE(report.failures.empty()) << report.failures[0];
  ASSERT_EQ(report.results.size(), 1U);
  EXPECT_EQ(report.max_disparity, 32);
  const MethodResult& own = report.results[0];
  EXPECT_EQ(own.method, kOwnMethod);
  EXPECT_GT(own.evaluation.density, 5);
  EXPECT_LT(own.evaluation.all.avgerr, 1);
  EXPECT_GT(own.seconds, 0);
  EXPECT_NEAR(own.seconds_per_megapixel, own.seconds * 1e6 / (240 * 120), 1e-9);
}

TEST_F(Running, FindsTheShiftWithTheRivals) {
  RunSettings settings;
  settings.opencv_methods = {OpenCvMethod::kSgbm, OpenCvMethod::kSgbm3Way, OpenCvMethod::kSgbmHh,
                             OpenCvMethod::kBm};
  Runner runner(settings);
  const PairReport report = runner.run(pairs_[0]);
  ASSERT_TRUE(report.failures.empty()) << report.failures[0];
  ASSERT_EQ(report.results.size(), 5U);
  for (const MethodResult& result : report.results) {
    EXPECT_LT(result.evaluation.all.avgerr, 1) << result.method;
    EXPECT_GT(result.evaluation.density, 5) << result.method;
  }
}

TEST_F(Running, RunsPairsOfDifferentSizesInTurn) {
  Runner runner({});
  for (const StereoPair& pair : {pairs_[0], pairs_[1], pairs_[0]}) {
    const PairReport report = runner.run(pair);
    ASSERT_TRUE(report.failures.empty()) << report.failures[0];
    EXPECT_LT(report.results.at(0).evaluation.all.avgerr, 1) << pair.name;
  }
}

TEST_F(Running, TakesEachPairForAStreamOfItsOwn) {
  testing::TestPair soft = make_pair(240, 120, 9);
  for (cv::Mat* view : {&soft.left, &soft.right}) cv::GaussianBlur(*view, *view, {}, 1.5);
  write_pair_folder(folder_ / "A", soft, 32);
  RunSettings settings;
  settings.repeat = 3;
  Runner full(settings);
  const double expected = full.run(pairs_[0]).results.at(0).evaluation.all.avgerr;
  ASSERT_TRUE(settings.parameters.set("resolution", "auto").ok());
  Runner automatic(settings);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(expected, automatic.run(pairs_[0]).results.at(0).evaluation.all.avgerr) << i;
  }
  settings.repeat = 12;
  Runner longer(settings);
  EXPECT_NE(expected, longer.run(pairs_[0]).results.at(0).evaluation.all.avgerr);
}

TEST_F(Running, DoesNotCompareAPairWithItself) {
  RunSettings settings;
  settings.repeat = 3;
  Runner off(settings);
  ASSERT_TRUE(settings.parameters.set("temporal", "hold").ok());
  Runner hold(settings);
  EXPECT_EQ(off.run(pairs_[0]).results.at(0).evaluation.density,
            hold.run(pairs_[0]).results.at(0).evaluation.density);
}

TEST_F(Running, ReportsACorruptPairAndContinues) {
  Runner runner({});
  testing::write_file(folder_ / "A/im1.png", "broken");
  const PairReport broken = runner.run(pairs_[0]);
  ASSERT_EQ(broken.failures.size(), 1U);
  EXPECT_THAT(broken.failures[0], ::testing::HasSubstr("A/im1.png"));
  EXPECT_TRUE(broken.results.empty());
  EXPECT_TRUE(runner.run(pairs_[1]).failures.empty());
}

TEST_F(Running, ReportsParametersThatDoNotFitTheImages) {
  RunSettings settings;
  ASSERT_TRUE(settings.parameters.set("min-node-width", "150").ok());
  ASSERT_TRUE(settings.parameters.set("max-node-width", "0.5").ok());
  settings.opencv_methods = {OpenCvMethod::kBm};
  Runner runner(settings);
  const PairReport report = runner.run(pairs_[0]);
  ASSERT_EQ(report.failures.size(), 1U);
  EXPECT_THAT(report.failures[0], ::testing::HasSubstr("min-node-width"));
  EXPECT_EQ(report.results.size(), 1U) << "OpenCV accepts the images";
}

TEST_F(Running, WritesMapsAndImagesOfEveryMethod) {
  RunSettings settings;
  settings.opencv_methods = {OpenCvMethod::kBm};
  settings.disparity_folder = folder_ / "maps";
  settings.image_folder = folder_ / "images";
  Runner runner(settings);
  ASSERT_TRUE(runner.run(pairs_[1]).failures.empty());
  EXPECT_EQ(read_pfm(folder_ / "maps/B.pfm").size(), cv::Size(200, 100));
  EXPECT_EQ(read_pfm(folder_ / "maps/bm/B.pfm").size(), cv::Size(200, 100));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "images/B.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "images/bm/B.png"));
}

TEST(OpenCvMatchers, SearchAMultipleOf16) {
  EXPECT_EQ(opencv_disparities(1), 16);
  EXPECT_EQ(opencv_disparities(64), 64);
  EXPECT_EQ(opencv_disparities(70), 80);
}

TEST(OpenCvMatchers, RejectImagesOfDifferentSizes) {
  OpenCvMatcher matcher(OpenCvMethod::kBm, 16);
  EXPECT_INPUT_ERROR(matcher.compute(cv::Mat::zeros(60, 80, CV_8U), cv::Mat::zeros(60, 81, CV_8U)),
                     "OpenCV rejects");
}

TEST(OpenCvMatchers, AreFoundByTheirNames) {
  for (const std::string& name : opencv_names()) {
    ASSERT_TRUE(find_opencv(name).has_value()) << name;
    EXPECT_EQ(opencv_name(*find_opencv(name)), name);
  }
  EXPECT_FALSE(find_opencv("elas").has_value());
}

}  // namespace
}  // namespace mtstereo::eval::runner_test

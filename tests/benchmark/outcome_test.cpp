// SPDX-License-Identifier: LGPL-2.1-or-later
#include "outcome.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "guarded.hpp"
#include "support/error_of.hpp"

namespace mtstereo::bench::outcome_test {
namespace {

using test::error_of;

Outcome outcome(int disparity, int confidence) {
  return {cv::Mat(4, 6, CV_32SC1, cv::Scalar(disparity)),
          cv::Mat(4, 6, CV_8UC1, cv::Scalar(confidence))};
}

TEST(Density, CountsDisparitiesOfTheLibrary) {
  cv::Mat map(2, 4, CV_32SC1, cv::Scalar(kNoDisparity));
  EXPECT_EQ(0, density_of(map));
  map.at<std::int32_t>(1, 3) = 1;
  map.at<std::int32_t>(0, 0) = 700;
  EXPECT_EQ(0.25, density_of(map));
}

TEST(Density, CountsValuesThatAreNotNan) {
  cv::Mat map(2, 4, CV_32FC1, cv::Scalar(0));  // a disparity of 0 counts
  EXPECT_EQ(1, density_of(map));
  map.at<float>(0, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(0.875, density_of(map));
}

TEST(Density, OfNothingIsAnError) {
  EXPECT_EQ("", error_of([] { require_density(outcome(256, 9).disparity); }));
  EXPECT_NE("", error_of([] { require_density(outcome(kNoDisparity, 0).disparity); }));
  EXPECT_NE("", error_of([] { require_density(cv::Mat()); }));
}

TEST(RequireSame, AcceptsEqualOutcomes) {
  EXPECT_EQ("", error_of([] { require_same("both", outcome(5, 6), outcome(5, 6)); }));
}

TEST(RequireSame, NamesTheFirstDifferentDisparity) {
  Outcome other = outcome(5, 6);
  other.disparity.at<std::int32_t>(2, 3) = 4;
  other.disparity.at<std::int32_t>(3, 0) = 4;
  EXPECT_EQ("both: the disparities differ, first at (3, 2): 5 and 4",
            error_of([&] { require_same("both", outcome(5, 6), other); }));
}

TEST(RequireSame, ComparesConfidences) {
  EXPECT_EQ("both: the confidences differ, first at (0, 0): 6 and 7",
            error_of([] { require_same("both", outcome(5, 6), outcome(5, 7)); }));
}

TEST(RequireSame, RejectsOtherSizes) {
  Outcome other = outcome(5, 6);
  other.disparity = other.disparity.rowRange(0, 2).clone();
  EXPECT_NE("", error_of([&] { require_same("both", outcome(5, 6), other); }));
}

TEST(Library, InvalidParametersAreErrors) {
  EXPECT_EQ("", error_of([] { parameters_of("paper", "sparse", 64, 2); }));
  EXPECT_NE("", error_of([] { parameters_of("swift", "sparse", 64, 1); }));
  EXPECT_NE("", error_of([] { parameters_of("default", "thin", 64, 1); }));
  EXPECT_NE("", error_of([] { parameters_of("default", "sparse", -1, 1); }));
}

TEST(Library, InvalidImagesAreErrors) {
  Matcher matcher = make_matcher(parameters_of("default", "sparse", 16, 1));
  const cv::Mat image(32, 64, CV_8UC1, cv::Scalar(9));
  EXPECT_EQ("", error_of([&] { match(matcher, {image, image}); }));
  EXPECT_NE("", error_of([&] { match(matcher, {image, image.rowRange(0, 20)}); }));
  EXPECT_NE("", error_of([&] { match(matcher, {cv::Mat(), cv::Mat()}); }));
}

TEST(OpenCvThreads, AreRestored) {
  const int before = cv::getNumThreads();
  {
    const OpenCvThreads one(1);
    EXPECT_EQ(1, cv::getNumThreads());
  }
  EXPECT_EQ(before, cv::getNumThreads());
}

}  // namespace
}  // namespace mtstereo::bench::outcome_test

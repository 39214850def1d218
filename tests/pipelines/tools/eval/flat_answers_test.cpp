// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/eval/flat_answers.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "expect_error.hpp"
#include "tools/eval/metrics.hpp"

namespace mtstereo::eval::flat_answers_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

cv::Mat noise(int width, int height, std::uint64_t seed) {
  cv::Mat image(height, width, CV_8UC1);
  cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

cv::Mat constant(float disparity) { return cv::Mat(20, 30, CV_32FC1, cv::Scalar(disparity)); }

TEST(FlatAnswers, AreAllDisparitiesOfFlatImages) {
  const cv::Mat flat(20, 30, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(count_flat_answers(constant(0), flat, flat), 30 * 20);
  // The right pixels of the first four columns are outside the image.
  EXPECT_EQ(count_flat_answers(constant(4), flat, flat), 26 * 20);
  EXPECT_EQ(count_flat_answers(constant(kNaN), flat, flat), 0);
}

TEST(FlatAnswers, NeedFlatWindowsInBothViews) {
  const cv::Mat flat(20, 30, CV_8UC1, cv::Scalar(7)), rough = noise(30, 20, 1);
  EXPECT_EQ(count_flat_answers(constant(0), flat, rough), 0);
  EXPECT_EQ(count_flat_answers(constant(0), rough, flat), 0);
}

TEST(FlatAnswers, HaveAWindowAroundTheMatchedRightPixel) {
  // Flat rectangles of 9x9 px have 5x5 flat windows.
  cv::Mat left = noise(30, 20, 1), right = noise(30, 20, 2);
  left(cv::Rect(15, 5, 9, 9)).setTo(100);
  right(cv::Rect(9, 5, 9, 9)).setTo(30);
  EXPECT_EQ(count_flat_answers(constant(6), left, right), 25);
  EXPECT_EQ(count_flat_answers(constant(6.4F), left, right), 25) << "rounded";
  EXPECT_EQ(count_flat_answers(constant(5), left, right), 20);
  EXPECT_EQ(count_flat_answers(constant(0), left, right), 0);
}

TEST(FlatAnswers, OneOtherValueInTheWindowIsContent) {
  cv::Mat left(20, 30, CV_8UC1, cv::Scalar(7));
  left.at<std::uint8_t>(10, 15) = 8;
  EXPECT_EQ(count_flat_answers(constant(0), left, left), 30 * 20 - 25);
}

TEST(FlatAnswers, RefuseOtherSizes) {
  const cv::Mat image(20, 30, CV_8UC1, cv::Scalar(7)), other(20, 31, CV_8UC1, cv::Scalar(7));
  EXPECT_INPUT_ERROR(count_flat_answers(constant(0), image, other), "different sizes");
}

TEST(FlatAnswers, ArePartOfTheEvaluationOfAPairAndSummedInTheMean) {
  const cv::Mat flat(20, 30, CV_8UC1, cv::Scalar(7));
  const LoadedPair pair{flat, flat, {constant(2), {}}};
  const Evaluation evaluation = evaluate(constant(2), pair);
  EXPECT_EQ(evaluation.flat_answers, 28 * 20);
  EXPECT_EQ(evaluation.all.avgerr, 0);
  EXPECT_EQ(mean({{&evaluation, 1}, {&evaluation, 0.5}}).flat_answers, 2 * 28 * 20);
  const Evaluation without = evaluate(constant(2), pair.truth);
  EXPECT_FALSE(without.flat_answers.has_value());
  EXPECT_FALSE(mean({{&without, 1}}).flat_answers.has_value());
}

}  // namespace
}  // namespace mtstereo::eval::flat_answers_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "support/compare.hpp"
#include "support/matching.hpp"
#include "support/padded_image.hpp"
#include "support/random.hpp"

namespace mtstereo::matcher_errors_test {
namespace {

using test::fails_with;

/// A matcher that has matched one frame, and the two views of the next frame, which tests make
/// invalid.
class MatcherErrors : public testing::Test {
 protected:
  MatcherErrors()
      : pair_(test::slanted_pair(96, 40, 20, 1)),
        matcher_(test::matcher({{"max-disparity", "32"}, {"cost", "gradient"}})),
        expected_(test::compute(matcher_, pair_.left, pair_.right)),
        left_(pair_.left.view()),
        right_(pair_.right.view()) {}

  /// Matches left_ and right_, which must fail; then a valid pair, whose result must be correct.
  void expect_rejected(ErrorCode code, std::initializer_list<std::string> words) {
    EXPECT_TRUE(fails_with(matcher_.compute(left_, right_), code, words));
    EXPECT_TRUE(same_image(expected_, test::compute(matcher_, pair_.left, pair_.right)))
        << "after the error";
    left_ = pair_.left.view();
    right_ = pair_.right.view();
  }

  test::Pair pair_;
  Matcher matcher_;
  test::DisparityPlane expected_;
  GrayView left_;
  GrayView right_;
};

TEST_F(MatcherErrors, RejectViewsWithoutData) {
  left_.data = nullptr;
  expect_rejected(ErrorCode::kInvalidImage, {"left", "no data"});
  right_.data = nullptr;
  expect_rejected(ErrorCode::kInvalidImage, {"right", "no data"});
  left_ = right_ = {};
  expect_rejected(ErrorCode::kInvalidImage, {"left", "0x0"});
}

TEST_F(MatcherErrors, RejectViewsWithoutPixels) {
  for (const int size : {0, -1, -1000000}) {
    left_.width = size;
    expect_rejected(ErrorCode::kInvalidImage, {"left", std::to_string(size) + "x40"});
    right_.height = size;
    expect_rejected(ErrorCode::kInvalidImage, {"right", "96x" + std::to_string(size)});
  }
}

TEST_F(MatcherErrors, RejectShortAndNegativeStrides) {
  for (const int stride : {95, 1, 0, -96, -200}) {
    left_.stride = stride;
    expect_rejected(ErrorCode::kInvalidImage, {"left", "stride", std::to_string(stride)});
    right_.stride = stride;
    expect_rejected(ErrorCode::kInvalidImage, {"right", "stride", std::to_string(stride)});
  }
}

TEST_F(MatcherErrors, RejectViewsOfDifferentSize) {
  right_.width = 95;
  expect_rejected(ErrorCode::kSizeMismatch, {"96x40", "95x40", "same size"});
  left_.height = 39;
  expect_rejected(ErrorCode::kSizeMismatch, {"96x39", "96x40"});
}

TEST_F(MatcherErrors, RejectFramesNarrowerThanMaxDisparity) {
  left_.width = right_.width = 31;
  expect_rejected(ErrorCode::kFrameDoesNotFit, {"max-disparity = 32", "31x40"});
}

TEST_F(MatcherErrors, RejectFramesThatAreTooLarge) {
  const std::vector<std::uint8_t> row(kLargestImageSide + 1);
  const int largest = kLargestImageSide;
  left_ = right_ = {row.data(), largest + 1, 1, largest + 1};
  expect_rejected(ErrorCode::kFrameDoesNotFit, {"16385x1", "16384"});
  left_ = right_ = {row.data(), 32, largest + 1, 32};
  expect_rejected(ErrorCode::kFrameDoesNotFit, {"32x16385", "16384"});
}

TEST_F(MatcherErrors, RejectNodeWidthsThatDoNotFitTheFrame) {
  Parameters parameters = matcher_.parameters();
  test::set_all(parameters, {{"min-node-width", "60"}, {"max-node-width", "0.5"}});
  ASSERT_TRUE(matcher_.set_parameters(parameters).ok());
  EXPECT_TRUE(fails_with(matcher_.compute(left_, right_), ErrorCode::kInvalidCombination,
                         {"min-node-width = 60", "max-node-width = 0.5", "96x40"}));
  parameters.unset(Parameter::kMinNodeWidth);
  parameters.unset(Parameter::kMaxNodeWidth);
  ASSERT_TRUE(matcher_.set_parameters(parameters).ok());
  EXPECT_TRUE(same_image(expected_, test::compute(matcher_, pair_.left, pair_.right)));
}

TEST_F(MatcherErrors, KeepTheLastResult) {
  const Result<FrameResult> result = matcher_.compute(left_, right_);
  ASSERT_TRUE(result.ok());
  const test::GrayPlane confidence = test::copy_of(result->confidence);
  EXPECT_FALSE(matcher_.compute({}, {}).ok());
  right_.width = 50;
  EXPECT_FALSE(matcher_.compute(left_, right_).ok());
  EXPECT_TRUE(same_image(expected_, result->disparity));
  EXPECT_TRUE(same_image(confidence, result->confidence));
}

TEST_F(MatcherErrors, LeaveANewMatcherUsable) {
  Matcher fresh = test::matcher({{"max-disparity", "32"}, {"cost", "gradient"}});
  EXPECT_FALSE(fresh.compute({}, {}).ok());
  right_.height = 20;
  EXPECT_FALSE(fresh.compute(left_, right_).ok());
  EXPECT_TRUE(same_image(expected_, test::compute(fresh, pair_.left, pair_.right)));
}

TEST(MatcherInput, MayHaveAnyStrideWithOneRow) {
  const test::Pair pair = test::slanted_pair(64, 1, 10, 2);
  Matcher matcher = test::matcher({{"max-disparity", "16"}});
  const test::DisparityPlane expected = test::compute(matcher, pair.left, pair.right);
  for (const int stride : {0, 1, -64, 63, 1000000}) {
    GrayView left = pair.left.view(), right = pair.right.view();
    left.stride = right.stride = stride;
    const Result<FrameResult> result = matcher.compute(left, right);
    ASSERT_TRUE(result.ok()) << "stride " << stride << ": " << result.error().message;
    EXPECT_TRUE(same_image(expected, result->disparity)) << "stride " << stride;
  }
}

TEST(MatcherInput, MayHaveDifferentStrides) {
  const test::Pair pair = test::slanted_pair(64, 30, 10, 3);
  Matcher matcher = test::matcher({{"max-disparity", "16"}});
  const test::DisparityPlane expected = test::compute(matcher, pair.left, pair.right);
  const test::PaddedImage<std::uint8_t> left(pair.left, 13, 3), right(pair.right, 64);
  const Result<FrameResult> result = matcher.compute(left.view(), right.view());
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(same_image(expected, result->disparity));
  EXPECT_TRUE(left.unchanged() && right.unchanged());
}

TEST(MatcherInput, MustNotHaveANegativeStride) {
  const test::Pair pair = test::slanted_pair(64, 30, 10, 4);
  Matcher matcher = test::matcher({{"max-disparity", "16"}});
  const test::PaddedImage<std::uint8_t> left(pair.left, 0);
  EXPECT_TRUE(fails_with(matcher.compute(left.upside_down(), pair.right.view()),
                         ErrorCode::kInvalidImage, {"left", "-64"}));
}

}  // namespace
}  // namespace mtstereo::matcher_errors_test

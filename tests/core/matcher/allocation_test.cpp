// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "support/compare.hpp"
#include "support/counting_allocator.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"
#include "support/sanitizers.hpp"

namespace mtstereo {
namespace {

using test::same_image;

class Allocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::allocations_are_counted()) {
      GTEST_SKIP() << (test::kSanitized ? "the sanitizer has an allocator of its own"
                                        : "the C library lets nobody count its allocations");
    }
  }
  void TearDown() override { test::fail_allocation_after(-1); }
};

TEST_F(Allocation, IsCounted) {
  // Behind a volatile pointer, so that the compiler cannot leave the pair of calls out.
  void* volatile memory = nullptr;
  test::count_allocations();
  memory = std::malloc(8);
  std::free(memory);
  memory = std::aligned_alloc(64, 64);
  std::free(memory);
  memory = std::calloc(3, 5);
  std::free(memory);
  memory = ::operator new(8);
  ::operator delete(memory);
  EXPECT_EQ(4, test::allocations());
  test::fail_allocation_after(1);
  std::unique_ptr<int> first, second;
  EXPECT_NO_THROW(first = std::make_unique<int>(1));
  EXPECT_THROW(second = std::make_unique<int>(1), std::bad_alloc);
  EXPECT_NO_THROW(second = std::make_unique<int>(1)) << "only one fails";
}

/// Allocations of each frame from the third on, the frames coming from memory that is there.
void expect_no_allocations(std::initializer_list<std::pair<const char*, std::string>> values,
                           bool keep_stages = false) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  const test::Pair other = test::slanted_pair(333, 201, 40, 2);
  Matcher matcher = test::matcher(values);
  matcher.keep_stages(keep_stages);
  for (int frame = 0; frame < 12; ++frame) {
    const test::Pair& now = frame % 2 == 0 ? pair : other;
    test::count_allocations();
    const bool ok = matcher.compute(now.left.view(), now.right.view()).ok();
    const long count = test::allocations();
    EXPECT_TRUE(ok);
    if (frame < 2) continue;
    EXPECT_EQ(0, count) << "frame " << frame;
  }
  EXPECT_GT(matcher.statistics().density, 0.05);
}

TEST_F(Allocation, NeverHappensInALaterFrameOnOneThread) {
  expect_no_allocations({{"threads", "1"}});
  expect_no_allocations({{"threads", "1"}, {"mode", "sparse"}});
  expect_no_allocations({{"threads", "1"},
                         {"node-cost", "gradient"},
                         {"cost-volume", "full"},
                         {"node-levels", "3,1,0"}});
  expect_no_allocations({{"threads", "1"}}, true);
}

TEST_F(Allocation, NeverHappensInALaterFrameInAnyModeOfAnyPreset) {
  for (const char* const threads : {"1", "2"}) {
    for (const char* const mode : {"sparse", "semi-dense", "dense"}) {
      SCOPED_TRACE(testing::Message() << mode << ", threads " << threads);
      for (const char* const preset : {"fast", "paper"}) {
        expect_no_allocations({{"threads", threads}, {"preset", preset}, {"mode", mode}});
      }
      expect_no_allocations(
          {{"threads", threads}, {"mode", mode}, {"rim-trim", "1"}, {"max-gap", "30"}});
    }
  }
}

TEST_F(Allocation, NeverHappensInALaterFrameWhoseRimIsWider) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  Matcher matcher = test::matcher({{"threads", "2"}});
  for (int frame = 0; frame < 3; ++frame) test::compute(matcher, pair.left, pair.right);
  ASSERT_TRUE(
      matcher.set_parameters(test::parameters({{"threads", "2"}, {"rim-trim", "31"}})).ok());
  test::count_allocations();
  const bool ok = matcher.compute(pair.left.view(), pair.right.view()).ok();
  EXPECT_EQ(0, test::allocations());
  EXPECT_TRUE(ok);
}

TEST_F(Allocation, NeverHappensInALaterFrameOnTwoThreads) {
  expect_no_allocations({{"threads", "2"}});
  expect_no_allocations({{"threads", "2"}, {"mode", "sparse"}}, true);
}

TEST_F(Allocation, NeverHappensInALaterFrameOnMoreThreadsThanBands) {
  expect_no_allocations({{"threads", "9"}});
}

TEST_F(Allocation, NeverHappensInASmallerFrame) {
  Matcher matcher = test::matcher({{"threads", "1"}, {"max-disparity", "32"}});
  for (int frame = 0; frame < 3; ++frame) {
    for (const auto& [width, height] : {std::pair{300, 150}, {200, 100}, {299, 40}}) {
      const test::Pair pair = test::slanted_pair(width, height, 20, 3);
      test::count_allocations();
      const bool ok = matcher.compute(pair.left.view(), pair.right.view()).ok();
      const long count = test::allocations();
      EXPECT_TRUE(ok);
      // Another size makes the kernel anew, which is a handful of bytes.
      if (frame == 0) continue;
      EXPECT_LE(count, 4) << width << "x" << height;
    }
  }
}

/// Lets the first, the second, the third ... allocation of a frame that is larger than the one
/// before fail, until none is left to. Each time the frame has to fail in order, and the next to be
/// as ever.
void expect_recovery(const char* threads, const char* node_cost, const char* resolution = "full") {
  const test::Pair pair = test::slanted_pair(90, 70, 16, 4);
  const test::Pair small = test::slanted_pair(40, 20, 8, 5);
  const Parameters parameters = test::parameters({{"threads", threads},
                                                  {"node-cost", node_cost},
                                                  {"resolution", resolution},
                                                  {"max-disparity", "20"}});
  Matcher undisturbed = std::move(Matcher::create(parameters).value());
  const test::DisparityPlane expected = test::compute(undisturbed, pair.left, pair.right);
  long failures = 0;
  for (bool failed = true; failed && !testing::Test::HasFailure(); failures += failed) {
    SCOPED_TRACE(testing::Message() << "allocation " << failures << ", " << threads << " threads");
    Matcher matcher = std::move(Matcher::create(parameters).value());
    matcher.keep_stages(true);
    if (failures % 2 == 0) test::compute(matcher, small.left, small.right);
    test::fail_allocation_after(failures);
    const Result<DisparityView> result = matcher.compute(pair.left.view(), pair.right.view());
    failed = test::allocation_has_failed();
    test::fail_allocation_after(-1);
    if (!result.ok()) {
      EXPECT_TRUE(test::fails_with(result, ErrorCode::kOutOfMemory, {}));
      EXPECT_FALSE(result.error().message.empty());
      EXPECT_EQ(0, matcher.cost(50, 20, 3)) << "there is no volume";
      const GrayView level = matcher.preprocessed(Side::kLeft);
      EXPECT_TRUE(level.data != nullptr || level.width == 0) << "a size without pixels";
      // Neither those of a frame that is half done nor those of one before it.
      for (int stage = 0; stage <= static_cast<int>(Stage::kFinal); ++stage) {
        EXPECT_EQ(0, matcher.stage(static_cast<Stage>(stage)).width) << "stage " << stage;
      }
    }
    EXPECT_TRUE(same_image(expected, test::compute(matcher, pair.left, pair.right)));
  }
  EXPECT_GT(failures, 50) << "the comparison means something";
}

TEST_F(Allocation, FailingAnywhereIsAnErrorAndNotTheEnd) {
  expect_recovery("1", "gradient");
  expect_recovery("2", "census");
  expect_recovery("1", "gradient", "half-refined");
}

/// The message of a frame for which the memory does not suffice.
std::string message_without_memory(
    std::initializer_list<std::pair<const char*, std::string>> values) {
  const test::Pair pair = test::slanted_pair(90, 70, 16, 5);
  Parameters parameters = test::parameters(values);
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, 20).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  test::fail_allocation_after(20);
  const Result<DisparityView> result = matcher.compute(pair.left.view(), pair.right.view());
  test::fail_allocation_after(-1);
  EXPECT_TRUE(test::fails_with(result, ErrorCode::kOutOfMemory, {"memory", "90x70"}));
  return result.ok() ? "" : result.error().message;
}

void expect_advice(std::initializer_list<std::pair<const char*, std::string>> values,
                   const char* advice) {
  const std::string message = message_without_memory(values);
  EXPECT_TRUE(message.ends_with(advice)) << message << "\nhas to end with\n" << advice;
}

TEST_F(Allocation, FailingSaysWhatToDo) {
  expect_advice({{"threads", "2"}},
                "max-disparity = 20: take smaller images, lower max-disparity or threads, or set "
                "resolution = half or preset = fast");
  expect_advice({{"node-cost", "gradient"}},
                ", or leave out the cost volume: set node-cost = census");
  expect_advice({{"pixel-cost", "gradient"}},
                ", or leave out the cost volume: set pixel-cost = census");
  expect_advice({{"preset", "paper"}},
                ", or leave out the cost volume: set node-cost = census and pixel-cost = census");
}

TEST_F(Allocation, FailingDoesNotProposeWhatIsSetAlready) {
  expect_advice({{"preset", "fast"}}, "lower max-disparity or threads, or set resolution = half");
  expect_advice({{"threads", "1"}, {"resolution", "half"}},
                "max-disparity = 20: take smaller images, lower max-disparity");
}

TEST_F(Allocation, FailingWhileParametersAreTakenKeepsTheOldOnes) {
  // Texts that are too long to be held without memory.
  const Parameters old = test::parameters({{"max-disparity", "20"}});
  const Parameters other = test::parameters(
      {{"node-levels", "63,62,61,60,59,58,57,0"}, {"intensity-weight", "0.12345678901234567"}});
  long failures = 0;
  for (bool failed = true; failed; failures += failed) {
    Matcher matcher = std::move(Matcher::create(old).value());
    test::fail_allocation_after(failures);
    const Status status = matcher.set_parameters(other);
    failed = test::allocation_has_failed();
    test::fail_allocation_after(-1);
    EXPECT_NE(failed, status.ok());
    EXPECT_EQ(failed ? 20 : 64, matcher.parameters().integer(Parameter::kMaxDisparity));
  }
  EXPECT_GT(failures, 0);
  test::fail_allocation_after(0);
  const Result<Matcher> none = Matcher::create(old);
  test::fail_allocation_after(-1);
  EXPECT_TRUE(test::fails_with(none, ErrorCode::kOutOfMemory, {"memory"}));
}

}  // namespace
}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "mtstereo/alignment.hpp"
#include "stages/prepare/noise_filter.hpp"
#include "support/compare.hpp"
#include "support/counting_allocator.hpp"
#include "support/matching.hpp"
#include "support/random.hpp"
#include "support/soft_pair.hpp"

namespace mtstereo::allocation_test {
namespace {

class Allocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::allocations_are_counted()) {
      GTEST_SKIP() << "the C library does not allow to replace the allocator";
    }
  }
  void TearDown() override { test::fail_allocation_after(-1); }
};

TEST_F(Allocation, IsCountedAndFailsOnRequest) {
  // The volatile pointer keeps the compiler from removing pairs of calls.
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
  EXPECT_NO_THROW(second = std::make_unique<int>(1)) << "only one allocation must fail";
}

using Values = std::initializer_list<std::pair<const char*, std::string>>;

/// Expects no allocations from the third of these frames on.
void expect_no_allocations(const std::vector<test::Pair>& frames, Values values) {
  Matcher matcher = test::matcher(values);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    test::count_allocations();
    const Result<FrameResult> result =
        matcher.compute(frames[frame].left.view(), frames[frame].right.view());
    const long count = test::allocations();
    ASSERT_TRUE(result.ok());
    EXPECT_GT(result->statistics.density, 0.05);
    if (frame < 2) continue;
    EXPECT_EQ(0, count) << "frame " << frame;
  }
}

/// The same with two frames in turn.
void expect_no_allocations(Values values) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  const test::Pair other = test::slanted_pair(333, 201, 40, 2);
  expect_no_allocations({pair, other, pair, other, pair, other, pair, other}, values);
}

TEST_F(Allocation, NeverHappensBeforeAMovingCamera) {
  for (const char* const temporal : {"hold", "filter"}) {
    expect_no_allocations(test::moving_frames(6, 240, 120),
                          {{"threads", "1"}, {"temporal", temporal}});
  }
}

TEST_F(Allocation, NeverHappensInLaterFramesOnOneThread) {
  expect_no_allocations({{"threads", "1"}});
  for (const char* const least : {"-20", "10"}) {
    expect_no_allocations({{"threads", "1"}, {"min-disparity", least}});
  }
  expect_no_allocations({{"threads", "1"}, {"mode", "sparse"}});
  expect_no_allocations({{"threads", "1"}, {"temporal", "hold"}});
  expect_no_allocations({{"threads", "1"}, {"temporal", "filter"}});
  expect_no_allocations(
      {{"threads", "1"}, {"preset", "paper"}, {"cost-volume", "full"}, {"node-levels", "3,1,0"}});
}

TEST_F(Allocation, NeverHappensInLaterFramesWhenTheCorrectionChanges) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  for (const char* const preset : {"default", "fast"}) {
    Matcher matcher = test::matcher({{"threads", "2"}, {"preset", preset}});
    for (int frame = 0; frame < 6; ++frame) {
      ViewCorrection correction;
      if (frame % 3 != 2) correction = {{0.1 * frame, 3, 2, 0, 0}, 0.4F, 1};
      test::count_allocations();
      const bool ok = matcher.set_correction(correction).ok() &&
                      matcher.compute(pair.left.view(), pair.right.view()).ok();
      const long count = test::allocations();
      EXPECT_TRUE(ok);
      if (frame < 2) continue;
      EXPECT_EQ(0, count) << "frame " << frame;
    }
  }
}

TEST_F(Allocation, NeverHappensInLaterFramesWhenTheResolutionIsChosen) {
  const test::Pair sharp = test::slanted_pair(333, 201, 40, 1);
  const test::Pair soft = softened(sharp);
  for (const char* const mode : {"semi-dense", "dense", "full"}) {
    for (const char* const least : {"-20", "0"}) {
      Matcher matcher = test::matcher(
          {{"threads", "2"}, {"resolution", "auto"}, {"mode", mode}, {"min-disparity", least}});
      int changes = 0;
      bool half = false;
      for (int frame = 0; frame < 30; ++frame) {
        const test::Pair& now = frame % 20 < 10 ? soft : sharp;
        test::count_allocations();
        const Result<FrameResult> result = matcher.compute(now.left.view(), now.right.view());
        const long count = test::allocations();
        ASSERT_TRUE(result.ok());
        changes += result->statistics.half_resolution != half;
        half = result->statistics.half_resolution;
        if (frame < 2) continue;
        EXPECT_EQ(0, count) << "frame " << frame << ", " << mode;
      }
      EXPECT_EQ(3, changes) << mode << ", " << least;
    }
  }
}

TEST_F(Allocation, NeverHappensInTheNoiseFilterOfAThreadThatStartsLate) {
  const test::GrayPlane view = test::noise(333, 64, 1);
  Image<std::uint8_t> filtered;
  filtered.resize(333, 64);
  NoiseFilterScratch scratch;
  scratch.resize(333, 32);
  test::count_allocations();
  smooth_lightly(view.view(), 0, 32, scratch, filtered);
  filter_noise(view.view(), 4, 32, 64, scratch, filtered);
  EXPECT_EQ(0, test::allocations());
}

TEST_F(Allocation, NeverHappensInLaterInspections) {
  AlignmentTracker tracker = std::move(AlignmentTracker::create().value());
  for (int i = 0; i < 12; ++i) {
    const test::Pair pair = test::slanted_pair(333, 201, 40, i);
    test::count_allocations();
    const bool watched = tracker.watch(pair.left.view(), pair.right.view()).ok();
    EXPECT_EQ(0, test::allocations());
    const bool ok = tracker.inspect(pair.left.view(), pair.right.view(), 50).ok();
    const long count = test::allocations();
    EXPECT_TRUE(watched && ok);
    if (i == 0) continue;
    EXPECT_EQ(0, count) << "pair " << i;
  }
  EXPECT_GT(tracker.views(), 5);
}

TEST_F(Allocation, OfATrackerThatFailsIsAnError) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  test::fail_allocation_after(0);
  EXPECT_TRUE(test::fails_with(AlignmentTracker::create(), ErrorCode::kOutOfMemory, {}));
  AlignmentTracker tracker = std::move(AlignmentTracker::create().value());
  int failures = 0;
  for (int i = 0; i < 100; ++i) {
    test::fail_allocation_after(i);
    const Status status = tracker.inspect(pair.left.view(), pair.right.view(), 50);
    test::fail_allocation_after(-1);
    if (status.ok()) break;
    EXPECT_TRUE(test::fails_with(status, ErrorCode::kOutOfMemory, {}));
    EXPECT_EQ(RowField(), tracker.correction().rows);
    ++failures;
  }
  EXPECT_GT(failures, 5);
  EXPECT_EQ(FieldStatus::kTrusted, tracker.findings().status) << "cannot be used after a failure";
}

TEST_F(Allocation, NeverHappensInLaterFramesInAnyModeOfAnyPreset) {
  for (const char* const threads : {"1", "2"}) {
    for (const char* const mode : {"sparse", "semi-dense", "dense", "full"}) {
      SCOPED_TRACE(testing::Message() << mode << ", threads " << threads);
      for (const char* const preset : {"fast", "paper"}) {
        expect_no_allocations({{"threads", threads}, {"preset", preset}, {"mode", mode}});
      }
      expect_no_allocations({{"threads", threads}, {"mode", mode}, {"max-gap", "30"}});
    }
  }
}

/// Alternates between two sets of parameters, frame by frame. From the third frame on no memory may
/// be allocated, whichever parameters differ.
void expect_free_change(std::initializer_list<std::pair<const char*, std::string>> one,
                        std::initializer_list<std::pair<const char*, std::string>> other) {
  const test::Pair pair = test::slanted_pair(333, 201, 40, 1);
  const Parameters sets[] = {test::parameters(one), test::parameters(other)};
  Matcher matcher = std::move(Matcher::create(sets[0]).value());
  for (int frame = 0; frame < 6; ++frame) {
    test::count_allocations();
    const bool ok = matcher.set_parameters(sets[frame % 2]).ok() &&
                    matcher.compute(pair.left.view(), pair.right.view()).ok();
    const long count = test::allocations();
    EXPECT_TRUE(ok);
    if (frame < 2) continue;
    EXPECT_EQ(0, count) << "frame " << frame;
  }
}

TEST_F(Allocation, NeverHappensAfterAChangeThatNeedsNoMoreMemory) {
  expect_free_change({{"threads", "2"}}, {{"threads", "2"}, {"min-confidence", "90"}});
  expect_free_change({{"threads", "1"}}, {{"threads", "1"}, {"mode", "dense"}});
  expect_free_change({{"threads", "1"}}, {{"threads", "1"}, {"preset", "fast"}});
  expect_free_change({{"threads", "1"}}, {{"threads", "1"}, {"preset", "paper"}});
  expect_free_change({{"threads", "2"}, {"max-disparity", "90"}},
                     {{"threads", "2"}, {"max-disparity", "33"}, {"max-neighbors", "3"}});
}

TEST_F(Allocation, NeverHappensInLaterFramesOnTwoThreads) {
  expect_no_allocations({{"threads", "2"}});
  expect_no_allocations({{"threads", "2"}, {"mode", "sparse"}});
}

TEST_F(Allocation, NeverHappensInLaterFramesOnMoreThreadsThanBands) {
  expect_no_allocations({{"threads", "9"}});
}

TEST_F(Allocation, NeverHappensInSmallerFrames) {
  Matcher matcher = test::matcher({{"threads", "1"}, {"max-disparity", "32"}});
  for (int frame = 0; frame < 3; ++frame) {
    for (const auto& [width, height] : {std::pair{300, 150}, {200, 100}, {299, 40}}) {
      const test::Pair pair = test::slanted_pair(width, height, 20, 3);
      test::count_allocations();
      const bool ok = matcher.compute(pair.left.view(), pair.right.view()).ok();
      const long count = test::allocations();
      EXPECT_TRUE(ok);
      if (frame == 0) continue;
      EXPECT_EQ(0, count) << width << "x" << height;
    }
  }
}

/// Lets the first, the second, the third ... allocation of a frame that is larger than the previous
/// one fail, until none is left. Each time the frame must fail with an error, and the next one must
/// have the correct result.
void expect_recovery(const char* threads, const char* cost, const char* resolution = "full") {
  const test::Pair pair = test::slanted_pair(90, 70, 16, 4);
  const test::Pair small = test::slanted_pair(40, 20, 8, 5);
  const Parameters parameters = test::parameters(
      {{"threads", threads}, {"cost", cost}, {"resolution", resolution}, {"max-disparity", "20"}});
  Matcher undisturbed = std::move(Matcher::create(parameters).value());
  const test::DisparityPlane expected = test::compute(undisturbed, pair.left, pair.right);
  long failures = 0;
  for (bool failed = true; failed && !testing::Test::HasFailure(); failures += failed) {
    SCOPED_TRACE(testing::Message() << "allocation " << failures << ", " << threads << " threads");
    Matcher matcher = std::move(Matcher::create(parameters).value());
    if (failures % 2 == 0) test::compute(matcher, small.left, small.right);
    test::fail_allocation_after(failures);
    const Result<FrameResult> result = matcher.compute(pair.left.view(), pair.right.view());
    failed = test::allocation_has_failed();
    test::fail_allocation_after(-1);
    if (!result.ok()) {
      EXPECT_TRUE(test::fails_with(result, ErrorCode::kOutOfMemory, {}));
      EXPECT_FALSE(result.error().message.empty());
    }
    EXPECT_TRUE(same_image(expected, test::compute(matcher, pair.left, pair.right)));
  }
  EXPECT_GT(failures, 50) << "too few results to compare";
}

TEST_F(Allocation, FailingAnywhereIsAnErrorAndTheMatcherStaysUsable) {
  expect_recovery("1", "gradient");
  expect_recovery("2", "census");
  expect_recovery("1", "gradient", "half-refined");
}

/// The error message of a frame whose memory cannot be allocated.
std::string message_without_memory(
    std::initializer_list<std::pair<const char*, std::string>> values) {
  const test::Pair pair = test::slanted_pair(90, 70, 16, 5);
  Parameters parameters = test::parameters(values);
  EXPECT_TRUE(parameters.set(Parameter::kMaxDisparity, 20).ok());
  Matcher matcher = std::move(Matcher::create(parameters).value());
  test::fail_allocation_after(20);
  const Result<FrameResult> result = matcher.compute(pair.left.view(), pair.right.view());
  test::fail_allocation_after(-1);
  EXPECT_TRUE(test::fails_with(result, ErrorCode::kOutOfMemory, {"memory", "90x70"}));
  return result.ok() ? "" : result.error().message;
}

void expect_advice(std::initializer_list<std::pair<const char*, std::string>> values,
                   const char* advice) {
  const std::string message = message_without_memory(values);
  EXPECT_TRUE(message.ends_with(advice)) << message << "\ndoes not end with\n" << advice;
}

TEST_F(Allocation, FailingReportsWhatToDo) {
  expect_advice({{"threads", "2"}},
                "max-disparity = 20: use smaller images, lower max-disparity or threads, or set "
                "resolution = half or preset = fast");
  expect_advice({{"preset", "paper"}}, ", or set cost = census, which needs no cost volume");
}

TEST_F(Allocation, FailingDoesNotSuggestWhatIsAlreadySet) {
  expect_advice({{"preset", "fast"}}, "lower max-disparity or threads, or set resolution = half");
  expect_advice({{"threads", "1"}, {"resolution", "half"}},
                "max-disparity = 20: use smaller images, lower max-disparity");
}

TEST_F(Allocation, FailingInCreateIsAnError) {
  test::fail_allocation_after(0);
  const Result<Matcher> none = Matcher::create(Parameters());
  test::fail_allocation_after(-1);
  EXPECT_TRUE(test::fails_with(none, ErrorCode::kOutOfMemory, {"memory"}));
}

TEST_F(Allocation, NeverHappensWhileParametersAreSet) {
  Matcher matcher = test::matcher({});
  Parameters parameters;
  test::count_allocations();
  bool ok = parameters.set("node-levels", "63,62,61,60,59,58,57,0").ok();
  ok = parameters.set("intensity-weight", "0.12345678901234567").ok() && ok;
  ok = parameters.set(Parameter::kCost, "gradient").ok() && ok;
  ok = parameters.check_frame(640, 480).ok() && parameters.check_scale16(256).ok() && ok;
  ok = matcher.set_parameters(parameters).ok() && ok;
  const long count = test::allocations();
  EXPECT_TRUE(ok);
  EXPECT_EQ(0, count);
}

/// Lets the first, the second ... allocation of a call fail that returns an error anyway. It must
/// return an error each time and never throw.
template <typename Call>
void expect_error_without_memory(ErrorCode code, Call&& call) {
  long failures = 0;
  for (bool failed = true; failed; failures += failed) {
    test::fail_allocation_after(failures);
    const auto outcome = call();
    failed = test::allocation_has_failed();
    test::fail_allocation_after(-1);
    ASSERT_FALSE(outcome.ok());
    EXPECT_EQ(failed ? ErrorCode::kOutOfMemory : code, outcome.error().code);
    EXPECT_EQ(failed, outcome.error().message.empty());
  }
  EXPECT_GT(failures, 0) << "the message must need memory";
}

TEST_F(Allocation, FailingInAnErrorMessageIsAnErrorWithoutMessage) {
  Parameters parameters;
  expect_error_without_memory(ErrorCode::kInvalidParameter,
                              [&] { return parameters.set(Parameter::kMaxDisparity, -1); });
  expect_error_without_memory(ErrorCode::kInvalidParameter,
                              [&] { return parameters.set(Parameter::kNodeLevels, "1,2"); });
  expect_error_without_memory(ErrorCode::kInvalidParameter,
                              [&] { return parameters.set("max-disparty", "64"); });
  expect_error_without_memory(ErrorCode::kFrameDoesNotFit,
                              [&] { return parameters.check_frame(0, 0); });
  expect_error_without_memory(ErrorCode::kInvalidCombination,
                              [&] { return parameters.check_scale16(65535); });
  expect_error_without_memory(ErrorCode::kSizeMismatch, [&] {
    return write_disparity16({}, 256, {nullptr, 1, 1, 2});
  });
  Matcher matcher = test::matcher({});
  const test::GrayPlane left(80, 20), right(81, 20);
  expect_error_without_memory(ErrorCode::kSizeMismatch,
                              [&] { return matcher.compute(left.view(), right.view()); });
}

}  // namespace
}  // namespace mtstereo::allocation_test

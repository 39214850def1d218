// SPDX-License-Identifier: LGPL-2.1-or-later
#include "step_times.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <stdexcept>

namespace mtstereo::bench::step_times_test {
namespace {

constexpr std::pair<const char*, const char*> kVariants[] = {
    {"default", "semi-dense"}, {"default", "sparse"},  {"default", "dense"},
    {"default", "full"},       {"fast", "semi-dense"}, {"paper", "semi-dense"}};

// measure() compares with the matcher.
TEST(StepTimes, HaveATimeForEachStepOfTheMatchersList) {
  const Pair pair = render_street(203, 97);  // no whole number of bands
  for (const auto& [preset, mode] : kVariants) {
    SCOPED_TRACE(std::string(preset) + ", " + mode);
    const Parameters parameters = parameters_of(preset, mode, 24, 1);
    StepTimes times(parameters, pair);
    const Settings settings(parameters);
    std::vector<std::string> expected;
    for_each_step(settings, [&](const Step& step) { expected.emplace_back(step.name); });
    EXPECT_EQ(expected, times.names());
    const std::vector<double> seconds = times.measure(0);
    ASSERT_EQ(times.names().size(), seconds.size());
    for (const double second : seconds) EXPECT_GT(second, 0);
  }
}

TEST(StepTimes, AreMeansOfOneFrame) {
  const Pair pair = render_street(203, 97);
  StepTimes times(parameters_of("default", "semi-dense", 24, 1), pair);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<double> one = times.measure(0);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(std::accumulate(one.begin(), one.end(), 0.0), took.count());
  const std::vector<double> many = times.measure(0.1);
  EXPECT_LT(std::accumulate(many.begin(), many.end(), 0.0), 0.1) << "not the sum of the frames";
}

TEST(StepTimes, FrameThatTheMatcherRefusesIsAnError) {
  const Pair pair = render_street(64, 48);
  EXPECT_THROW(StepTimes(parameters_of("default", "dense", 100, 1), pair), std::runtime_error);
}

}  // namespace
}  // namespace mtstereo::bench::step_times_test

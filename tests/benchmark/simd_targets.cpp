// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simd_targets.hpp"

#include <benchmark/benchmark.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "frame_timing.hpp"
#include "guarded.hpp"

namespace mtstereo::bench {
namespace {

std::string benchmark_name(const Frame& frame, const SimdTarget& target) {
  return "target/" + frame.name() + "/" + target.name;
}

Outcome outcome_on(const SimdTarget& target, const Frame& frame) {
  const ForcedTarget forced(target);
  Matcher matcher = make_matcher(parameters_of(kDefaultVariant, frame, 1));
  return outcome_of(match(matcher, frame.images()));
}

void time_target(benchmark::State& state, const SimdTarget& target, const SimdTarget& best,
                 const Frame& frame, Outcome& expected) {
  if (expected.disparity.empty()) expected = outcome_on(best, frame);
  const ForcedTarget forced(target);
  const Outcome outcome = time_matcher(state, parameters_of(kDefaultVariant, frame, 1), frame);
  require_same(best.name + " and " + target.name, expected, outcome);
  count_frame(state, frame, density_of(outcome.disparity));
}

}  // namespace

std::vector<SimdTarget> simd_targets() {
  std::vector<SimdTarget> targets;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    targets.push_back({target, hwy::TargetName(target)});
  }
  return targets;
}

ForcedTarget::ForcedTarget(const SimdTarget& target) {
  hwy::SetSupportedTargetsForTest(target.id);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

ForcedTarget::~ForcedTarget() {
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

void register_targets(const FramePointer& frame) {
  const std::vector<SimdTarget> targets = simd_targets();
  const auto expected = std::make_shared<Outcome>();
  for (const SimdTarget& target : targets) {
    benchmark::RegisterBenchmark(
        benchmark_name(*frame, target).c_str(),
        [=, best = targets.front()](benchmark::State& state) {
          guarded(state, [&] { time_target(state, target, best, *frame, *expected); });
        })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

std::vector<eval::TableRow> target_table(const Frame& frame, const Summary& summary) {
  using eval::fixed;
  const std::vector<SimdTarget> targets = simd_targets();
  const auto seconds_of = [&](const SimdTarget& target) {
    return summary.seconds_of(benchmark_name(frame, target));
  };
  const auto avx2 = std::find_if(targets.begin(), targets.end(),
                                 [](const SimdTarget& target) { return target.name == "AVX2"; });
  const double of_avx2 = avx2 == targets.end() ? NAN : seconds_of(*avx2);
  const SimdTarget& best = targets.front();
  const bool has_better = best.name != "AVX2";
  std::vector<eval::TableRow> rows = {{"target", "ms", "time / AVX2"}};
  if (has_better) rows.front().push_back("time / " + best.name);
  for (const SimdTarget& target : targets) {
    const double seconds = seconds_of(target);
    if (std::isnan(seconds)) continue;
    rows.push_back({target.name, fixed(seconds * 1e3, 1), fixed(seconds / of_avx2, 2)});
    if (has_better) rows.back().push_back(fixed(seconds / seconds_of(best), 2));
  }
  if (rows.size() == 1) rows.clear();
  return rows;
}

}  // namespace mtstereo::bench

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "frame_stages.hpp"
#include "frame_timing.hpp"
#include "guarded.hpp"

namespace mtstereo::bench {
namespace {

constexpr Variant kVariants[] = {
    kDefaultVariant,
    {"sparse", "default", "sparse"},
    {"dense", "default", "dense"},
    {"paper", "paper", "semi-dense"},
    {"fast", "fast", "semi-dense"},
};

/// Made when the first of its stages is timed.
using LazyStages = std::shared_ptr<std::unique_ptr<FrameStages>>;

/// Gives the time of one run, the mean of all [s].
double time_stage(benchmark::State& state, const std::string& name, FrameStages& stages) {
  using Clock = std::chrono::steady_clock;
  double sum = 0;
  for ([[maybe_unused]] auto _ : state) {
    stages.prepare(name);
    const Clock::time_point start = Clock::now();
    stages.run(name);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state.SetIterationTime(seconds);
    sum += seconds;
  }
  stages.require_result(name);
  return sum / static_cast<double>(state.iterations());
}

void add(const FramePointer& frame, const Variant& variant, const std::string& stage,
         const LazyStages& stages) {
  const std::string name = std::string("stage/") + frame->name() + "/" + variant.name + "/" + stage;
  benchmark::RegisterBenchmark(
      name.c_str(),
      [=](benchmark::State& state) {
        guarded(state, [&] {
          const OpenCvThreads one_thread(1);
          if (*stages == nullptr) {
            *stages =
                std::make_unique<FrameStages>(parameters_of(variant, *frame, 1), frame->images());
          }
          const double seconds = time_stage(state, stage, **stages);
          constexpr double kNanosecond = 1e-9;
          state.counters["ns/px"] =
              seconds / kNanosecond / static_cast<double>(frame->images().left.total());
        });
      })
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime();
}

}  // namespace

void register_stages(const FramePointer& frame) {
  std::set<std::string> known;
  for (const Variant& variant : kVariants) {
    if (!has_preset(variant.preset)) continue;
    const auto stages = std::make_shared<std::unique_ptr<FrameStages>>();
    const Parameters parameters = parameters_of(variant, *frame, 1);
    for (const std::string& stage : FrameStages::names(parameters)) {
      if (known.insert(stage).second) add(frame, variant, stage, stages);
    }
  }
}

}  // namespace mtstereo::bench

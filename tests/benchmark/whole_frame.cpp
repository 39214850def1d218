// SPDX-License-Identifier: LGPL-2.1-or-later
#include "whole_frame.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "eval/rivals.hpp"
#include "guarded.hpp"
#include "outcome.hpp"

namespace mtstereo::bench {
namespace {

constexpr int kThreadNumbers[] = {1, 2};

/// A set of defaults that is timed.
struct Variant {
  const char* name;
  const char* preset;
  const char* mode;
  bool on_all_frames;
};
constexpr Variant kVariants[] = {
    {"semi-dense", "default", "semi-dense", true},
    {"sparse", "default", "sparse", false},
    {"dense", "default", "dense", false},
    {"paper", "paper", "semi-dense", false},
};
constexpr eval::Rival kRivals[] = {eval::Rival::kSgbm, eval::Rival::kSgbm3Way, eval::Rival::kBm};

void count(benchmark::State& state, const Frame& frame, double density) {
  using benchmark::Counter;
  state.counters["s/MP"] =
      Counter(frame.megapixels(), Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["frames/s"] = Counter(1, Counter::kIsIterationInvariantRate);
  state.counters[kDensityCounter] = density;
}

Outcome outcome_with(const Variant& variant, const Frame& frame, int threads) {
  Matcher matcher =
      make_matcher(parameters_of(variant.preset, variant.mode, frame.disparities(), threads));
  const DisparityView disparity = match(matcher, frame.images());
  return outcome_of(disparity, matcher.confidence());
}

/// `other` is the outcome with the other number of threads, once it was needed.
void time_library(benchmark::State& state, const Variant& variant, const Frame& frame, int threads,
                  Outcome& other) {
  const OpenCvThreads opencv_threads(threads);
  if (other.disparity.empty()) other = outcome_with(variant, frame, threads == 1 ? 2 : 1);
  Matcher matcher =
      make_matcher(parameters_of(variant.preset, variant.mode, frame.disparities(), threads));
  DisparityView disparity = match(matcher, frame.images());  // sizes the buffers
  for ([[maybe_unused]] auto _ : state) disparity = match(matcher, frame.images());
  const Outcome outcome = outcome_of(disparity, matcher.confidence());
  require_density(outcome.disparity);
  require_same("1 and 2 threads", threads == 1 ? outcome : other, threads == 1 ? other : outcome);
  count(state, frame, density_of(outcome.disparity));
}

void time_rival(benchmark::State& state, eval::Rival rival, const Frame& frame, int threads) {
  const OpenCvThreads opencv_threads(threads);
  eval::RivalMatcher matcher(rival, frame.disparities());
  const Pair& pair = frame.images();
  matcher.compute(pair.left, pair.right);
  for ([[maybe_unused]] auto _ : state) matcher.compute(pair.left, pair.right);
  const cv::Mat disparity = matcher.disparity();
  require_density(disparity);
  count(state, frame, density_of(disparity));
}

/// Names a benchmark and registers it. Wall time counts; the processors' is told beside it.
template <typename Body>
void add(const FramePointer& frame, const std::string& method, int threads, Summary& summary,
         Body body) {
  const std::string name =
      "frame/" + frame->name() + "/" + method + "/threads:" + std::to_string(threads);
  summary.expect_frame(name, {frame->name(), method, threads});
  benchmark::RegisterBenchmark(
      name.c_str(), [body](benchmark::State& state) { guarded(state, [&] { body(state); }); })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace

void register_whole_frames(const std::vector<FramePointer>& all, Summary& summary) {
  for (const FramePointer& frame : all) {
    for (const int threads : kThreadNumbers) {
      for (const Variant& variant : kVariants) {
        if (!variant.on_all_frames && frame != main_frame(all)) continue;
        add(frame, variant.name, threads, summary,
            [=, other = std::make_shared<Outcome>()](benchmark::State& state) {
              time_library(state, variant, *frame, threads, *other);
            });
      }
      for (const eval::Rival rival : kRivals) {
        add(frame, std::string(eval::rival_name(rival)), threads, summary,
            [=](benchmark::State& state) { time_rival(state, rival, *frame, threads); });
      }
    }
  }
}

}  // namespace mtstereo::bench

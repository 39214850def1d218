// SPDX-License-Identifier: LGPL-2.1-or-later
#include "frame_timing.hpp"

#include <string>

#include "guarded.hpp"

namespace mtstereo::bench {
namespace {

Outcome outcome_with(const Parameters& parameters, const Frame& frame) {
  Matcher matcher = make_matcher(parameters);
  return outcome_of(match(matcher, frame.images()));
}

}  // namespace

bool has_preset(const char* preset) {
  const std::string choices = "|" + std::string(parameter_info(Parameter::kPreset).choices) + "|";
  return choices.find("|" + std::string(preset) + "|") != std::string::npos;
}

Parameters parameters_of(const Variant& variant, const Frame& frame, int threads) {
  return parameters_of(variant.preset, variant.mode, frame.disparities(), threads);
}

Outcome time_matcher(benchmark::State& state, const Parameters& parameters, const Frame& frame) {
  const OpenCvThreads opencv_threads(parameters.integer(Parameter::kThreads));
  Matcher matcher = make_matcher(parameters);
  FrameResult result = match(matcher, frame.images());  // allocates the buffers
  for ([[maybe_unused]] auto _ : state) result = match(matcher, frame.images());
  const Outcome outcome = outcome_of(result);
  require_density(outcome.disparity);
  return outcome;
}

void time_library(benchmark::State& state, const Variant& variant, const Frame& frame, int threads,
                  Outcome& other) {
  if (other.disparity.empty()) {
    other = outcome_with(parameters_of(variant, frame, threads == 1 ? 2 : 1), frame);
  }
  const Outcome outcome = time_matcher(state, parameters_of(variant, frame, threads), frame);
  require_same("1 and 2 threads", threads == 1 ? outcome : other, threads == 1 ? other : outcome);
  count_frame(state, frame, density_of(outcome.disparity));
}

void count_frame(benchmark::State& state, const Frame& frame, double density) {
  using benchmark::Counter;
  state.counters["s/MP"] =
      Counter(frame.megapixels(), Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["frames/s"] = Counter(1, Counter::kIsIterationInvariantRate);
  state.counters[kDensityCounter] = density;
}

}  // namespace mtstereo::bench

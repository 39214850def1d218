// SPDX-License-Identifier: LGPL-2.1-or-later
#include "step_times.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <set>

#include "frame_timing.hpp"
#include "guarded.hpp"

namespace mtstereo::bench {
namespace {

constexpr Variant kVariants[] = {
    kDefaultVariant,
    {"sparse", "default", "sparse"},
    {"dense", "default", "dense"},
    {"full", "default", "full"},
    {"paper", "paper", "semi-dense"},
    {"fast", "fast", "semi-dense"},
};

std::vector<std::string> names_of(const Settings& settings) {
  std::vector<std::string> names;
  for_each_step(settings, [&](const Step& step) { names.emplace_back(step.name); });
  return names;
}

double seconds_between(std::chrono::steady_clock::time_point start,
                       std::chrono::steady_clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

/// The times of all steps of a variant, which its benchmarks share: one measurement for each
/// repetition, made when the first of them asks for it.
class SharedTimes {
 public:
  SharedTimes(Variant variant, FramePointer frame, double seconds)
      : variant_(variant), frame_(std::move(frame)), seconds_(seconds) {}

  double of(std::size_t step, std::size_t repetition) {
    const OpenCvThreads one_thread(1);
    if (!times_) {
      times_ = std::make_unique<StepTimes>(parameters_of(variant_, *frame_, 1), frame_->images());
    }
    while (repetitions_.size() <= repetition) repetitions_.push_back(times_->measure(seconds_));
    return repetitions_[repetition][step];
  }

 private:
  Variant variant_;
  FramePointer frame_;
  double seconds_;
  std::unique_ptr<StepTimes> times_;
  std::vector<std::vector<double>> repetitions_;
};

void add(const FramePointer& frame, const Variant& variant, const std::string& name,
         std::size_t step, const std::shared_ptr<SharedTimes>& times) {
  const std::string full = "stage/" + frame->name() + "/" + variant.name + "/" + name;
  benchmark::RegisterBenchmark(full.c_str(),
                               [=, repetition = std::size_t{0}](benchmark::State& state) mutable {
                                 guarded(state, [&] {
                                   const double seconds = times->of(step, repetition++);
                                   for ([[maybe_unused]] auto _ : state)
                                     state.SetIterationTime(seconds);
                                   constexpr double kNanosecond = 1e-9;
                                   state.counters["ns/px"] =
                                       seconds / kNanosecond /
                                       static_cast<double>(frame->images().left.total());
                                 });
                               })
      ->Iterations(1)  // of a mean over many frames
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime();
}

}  // namespace

StepTimes::StepTimes(const Parameters& parameters, const Pair& pair)
    : pair_(pair), matcher_(Settings(parameters)), names_(names_of(matcher_.settings())) {
  Matcher matcher = make_matcher(parameters);
  expected_ = outcome_of(match(matcher, pair));
}

FrameResult StepTimes::run(std::vector<double>& sums) {
  std::size_t step = 0;
  Clock::time_point last = Clock::now();
  const auto take = [&](const Step&, const FrameMemory&) {
    const Clock::time_point now = Clock::now();
    sums[step++] += seconds_between(last, now);
    last = now;
  };
  return matcher_.compute(view_of(pair_.left), view_of(pair_.right), take);
}

std::vector<double> StepTimes::measure(double seconds) {
  std::vector<double> sums(names_.size(), 0);
  run(sums);  // sizes the buffers and fills the caches
  sums.assign(names_.size(), 0);
  int frames = 0;
  const Clock::time_point start = Clock::now();
  FrameResult result;
  do {
    result = run(sums);
    ++frames;
  } while (seconds_between(start, Clock::now()) < seconds);
  require_same("the matcher and its steps", expected_, outcome_of(result));
  for (double& sum : sums) sum /= frames;
  return sums;
}

void register_steps(const FramePointer& frame, double seconds) {
  std::set<std::string> known;
  for (const Variant& variant : kVariants) {
    const auto times = std::make_shared<SharedTimes>(variant, frame, seconds);
    const std::vector<std::string> names = names_of(Settings(parameters_of(variant, *frame, 1)));
    for (std::size_t step = 0; step < names.size(); ++step) {
      if (known.insert(names[step]).second) add(frame, variant, names[step], step, times);
    }
  }
}

}  // namespace mtstereo::bench

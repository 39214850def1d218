// SPDX-License-Identifier: LGPL-2.1-or-later
#include "whole_frame.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "frame_timing.hpp"
#include "guarded.hpp"
#include "outcome.hpp"
#include "tools/eval/opencv_matchers.hpp"

namespace mtstereo::bench {
namespace {

constexpr int kThreadNumbers[] = {1, 2};

struct FrameVariant {
  Variant of;
  bool on_all_frames;
};
constexpr FrameVariant kFrameVariants[] = {
    {kDefaultVariant, true},
    {{"fast", "fast", "semi-dense"}, true},
    {{"sparse", "default", "sparse"}, false},
    {{"dense", "default", "dense"}, false},
    {{"full", "default", "full"}, true},
    {{"paper", "paper", "semi-dense"}, false},
};
constexpr eval::OpenCvMethod kOpenCvMethods[] = {
    eval::OpenCvMethod::kSgbm, eval::OpenCvMethod::kSgbm3Way, eval::OpenCvMethod::kBm};

void time_opencv(benchmark::State& state, eval::OpenCvMethod method, const Frame& frame,
                 int threads) {
  const OpenCvThreads opencv_threads(threads);
  eval::OpenCvMatcher matcher(method, frame.disparities());
  const Pair& pair = frame.images();
  matcher.compute(pair.left, pair.right);
  for ([[maybe_unused]] auto _ : state) matcher.compute(pair.left, pair.right);
  const cv::Mat disparity = matcher.disparity();
  require_density(disparity);
  count_frame(state, frame, density_of(disparity));
}

/// Names and registers a benchmark. It measures wall time and reports processor time too.
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

void add_library(const FramePointer& frame, const Variant& variant, int threads, Summary& summary) {
  add(frame, variant.name, threads, summary,
      [=, other = std::make_shared<Outcome>()](benchmark::State& state) {
        time_library(state, variant, *frame, threads, *other);
      });
}

}  // namespace

void register_whole_frames(const std::vector<FramePointer>& all, Summary& summary) {
  for (const FramePointer& frame : all) {
    for (const int threads : kThreadNumbers) {
      for (const FrameVariant& variant : kFrameVariants) {
        if (!variant.on_all_frames && frame != main_frame(all)) continue;
        if (has_preset(variant.of.preset)) add_library(frame, variant.of, threads, summary);
      }
      for (const eval::OpenCvMethod method : kOpenCvMethods) {
        add(frame, std::string(eval::opencv_name(method)), threads, summary,
            [=](benchmark::State& state) { time_opencv(state, method, *frame, threads); });
      }
    }
  }
}

}  // namespace mtstereo::bench

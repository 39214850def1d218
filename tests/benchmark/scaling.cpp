// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scaling.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "frame_timing.hpp"
#include "guarded.hpp"

namespace mtstereo::bench {
namespace {

const cv::Size kSize(640, 480);   // size for growing numbers of disparities
constexpr int kDisparities = 64;  // disparities for growing sizes

void add(const std::string& name, const FramePointer& frame) {
  benchmark::RegisterBenchmark(
      ("scaling/" + name).c_str(),
      [frame, other = std::make_shared<Outcome>()](benchmark::State& state) {
        guarded(state, [&] {
          time_library(state, kDefaultVariant, *frame, 1, *other);
          state.counters["pixels"] = static_cast<double>(frame->images().left.total());
          state.counters["disparities"] = frame->disparities();
        });
      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

void register_scaling(bool quick) {
  std::vector<cv::Size> sizes = {{320, 240}, kSize, {960, 720}, {1280, 960}, {1920, 1440}};
  std::vector<int> disparities = {32, kDisparities, 96, 128, 192, 256};
  if (quick) {
    sizes.resize(2);
    disparities.resize(2);
  }
  for (const cv::Size size : sizes) {
    add("pixels/" + std::to_string(size.width) + "x" + std::to_string(size.height),
        std::make_shared<Frame>(size.width, size.height, kDisparities));
  }
  for (const int count : disparities) {
    add("disparities/" + std::to_string(count),
        std::make_shared<Frame>(kSize.width, kSize.height, count));
  }
}

}  // namespace mtstereo::bench

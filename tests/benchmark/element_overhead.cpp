// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-benchmark-element: the time per frame that the element `mtstereo` adds to the library.
#include <benchmark/benchmark.h>
#include <gst/gst.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "element_pipeline.hpp"
#include "guarded.hpp"
#include "options.hpp"
#include "outcome.hpp"
#include "summary.hpp"
#include "tools/eval/text_table.hpp"

namespace {

using namespace mtstereo;
using bench::ElementPipeline;

constexpr const char* kOverhead = "overhead_percent";
constexpr const char* kLibrary = "library_ms";
constexpr int kThreadNumbers[] = {1, 2};
constexpr int kScale = 256;  // the element's default of disparity-scale
constexpr int kMoments = 4;  // frames of the street
constexpr int kWarmUp = 1;   // untimed frames of each block

void print_help() {
  std::cout << "mtstereo-benchmark-element [--quick]\n"
               "          a small frame and 2 short repetitions, to check that everything runs\n"
               "  GST_PLUGIN_PATH must name the folder of the plugin, such as build/gst.\n"
               "  Options of Google Benchmark, which override the settings of this program:\n";
  benchmark::PrintDefaultHelp();
}

struct Size {
  int width, height, disparities;
  int rounds;  ///< rounds per repetition: one block of frames by each of the two
  int frames;  ///< timed frames per block
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Compares the library and the element on the same frames with the same number of threads.
class Race {
 public:
  Race(const Size& size, int threads, const bench::PairList& pairs)
      : size_(size),
        pairs_(pairs),
        matcher_(bench::make_matcher(
            bench::parameters_of("default", "semi-dense", size.disparities, threads))),
        pipeline_("threads=" + std::to_string(threads) +
                      " max-disparity=" + std::to_string(size.disparities),
                  size.width, size.height) {
    require_same_maps();
  }

  /// Medians over the frames [s].
  struct Times {
    double library, element;
  };

  /// Short alternating blocks, so that other load on the machine affects both.
  Times run() {
    std::vector<double> library, element;
    for (int round = 0; round < size_.rounds; ++round) {
      if (round % 2 == 0) time_element(element);
      time_library(library);
      if (round % 2 != 0) time_element(element);
    }
    return {median(std::move(library)), median(std::move(element))};
  }

 private:
  FrameResult match(int frame) {
    const bench::PairBuffers& pair = *pairs_[static_cast<std::size_t>(frame) % pairs_.size()];
    const auto result = matcher_.compute(pair.left.view(), pair.right.view());
    if (!result) throw std::runtime_error(result.error().message);
    return *result;
  }

  void time_library(std::vector<double>& seconds) {
    std::vector<ElementPipeline::Clock::time_point> done;
    for (int i = 0; i < kWarmUp + size_.frames; ++i) {
      match(i);
      done.push_back(ElementPipeline::Clock::now());
    }
    append_frames(done, seconds);
  }

  void time_element(std::vector<double>& seconds) {
    append_frames(pipeline_.match(pairs_, kWarmUp + size_.frames), seconds);
  }

  /// Appends the time from the end of each frame to the end of the next.
  static void append_frames(const std::vector<ElementPipeline::Clock::time_point>& done,
                            std::vector<double>& seconds) {
    for (std::size_t i = kWarmUp; i < done.size(); ++i) {
      seconds.push_back(std::chrono::duration<double>(done[i] - done[i - 1]).count());
    }
  }

  void require_same_maps() {
    const std::vector<cv::Mat> maps = pipeline_.maps(pairs_);
    cv::Mat expected(size_.height, size_.width, CV_16UC1);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const FrameResult result = match(static_cast<int>(i));
      bench::require_density(bench::outcome_of(result).disparity);
      const Status status =
          write_disparity16(result.disparity, kScale,
                            {expected.ptr<std::uint16_t>(), expected.cols, expected.rows,
                             static_cast<std::ptrdiff_t>(expected.step)});
      if (!status) throw std::runtime_error(status.error().message);
      if (cv::countNonZero(expected != maps.at(i)) != 0) {
        throw std::runtime_error("the element and the library give different disparities");
      }
    }
  }

  Size size_;
  const bench::PairList& pairs_;
  Matcher matcher_;
  ElementPipeline pipeline_;
};

/// The pairs, rendered when the first benchmark runs.
const bench::PairList& pairs_of(const Size& size, bench::PairList& pairs) {
  constexpr double kStep = 0.5;  // [s]
  for (int i = static_cast<int>(pairs.size()); i < kMoments; ++i) {
    pairs.push_back(std::make_unique<bench::PairBuffers>(
        bench::render_street(size.width, size.height, 1 + i * kStep)));
  }
  return pairs;
}

std::string frame_name(const Size& size) {
  return "street-" + std::to_string(size.width) + "x" + std::to_string(size.height) + "-" +
         std::to_string(size.disparities);
}

std::string benchmark_name(const Size& size, int threads) {
  return "element/" + frame_name(size) + "/threads:" + std::to_string(threads);
}

/// The pairs and the races exist as long as the benchmarks are registered.
void register_races(const Size& size) {
  const auto pairs = std::make_shared<bench::PairList>();
  for (const int threads : kThreadNumbers) {
    const auto race = std::make_shared<std::unique_ptr<Race>>();
    const auto body = [=](benchmark::State& state) {
      const bench::OpenCvThreads opencv_threads(threads);
      if (*race == nullptr) {
        *race = std::make_unique<Race>(size, threads, pairs_of(size, *pairs));
      }
      Race::Times times{};
      for ([[maybe_unused]] auto _ : state) {
        times = (*race)->run();
        state.SetIterationTime(times.element);
      }
      state.counters[kLibrary] = times.library * 1e3;
      state.counters[kOverhead] = (times.element / times.library - 1) * 100;
    };
    benchmark::RegisterBenchmark(
        benchmark_name(size, threads).c_str(),
        [body](benchmark::State& state) { bench::guarded(state, [&] { body(state); }); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->Iterations(1);
  }
}

int report(const Size& size, const bench::Summary& summary) {
  using eval::fixed;
  std::vector<eval::TableRow> rows = {
      {"frame", "threads", "library ms", "element ms", "overhead %"}};
  for (const int threads : kThreadNumbers) {
    const std::string name = benchmark_name(size, threads);
    const double seconds = summary.seconds_of(name);
    if (std::isnan(seconds)) continue;
    rows.push_back({frame_name(size), std::to_string(threads),
                    fixed(summary.counter_of(name, kLibrary), 2), fixed(seconds * 1e3, 2),
                    fixed(summary.counter_of(name, kOverhead), 2)});
  }
  std::cout << "\nMedians; the overhead is the median over the repetitions, not the ratio of the "
               "medians.\n";
  eval::print_rows(std::cout, rows);
  for (const std::string& error : summary.errors()) std::cerr << "error: " << error << '\n';
  return summary.errors().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

int run(int argc, char** argv) {
  const bench::Options options(argc, argv, {10, 0.2}, print_help);
  if (!options.good()) return EXIT_FAILURE;
  bench::add_context();
  gst_init(nullptr, nullptr);
  g_autofree gchar* gstreamer = gst_version_string();
  benchmark::AddCustomContext("gstreamer", gstreamer);

  const Size size = options.quick() ? Size{320, 240, 32, 1, 2} : Size{1242, 375, 100, 4, 5};
  register_races(size);
  bench::Summary summary;
  bench::SummarizingReporter reporter(summary);
  const std::size_t count = benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::ClearRegisteredBenchmarks();  // stops the pipelines
  if (count > 0) return report(size, summary);
  std::cerr << "error: no benchmark was run; --benchmark_list_tests lists their names\n";
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  return mtstereo::bench::guarded_main([&] { return run(argc, argv); });
}

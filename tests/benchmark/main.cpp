// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-benchmark: times whole frames and single stages, and OpenCV's matchers for comparison.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <cstring>
#include <iostream>
#include <vector>

#include "frames.hpp"
#include "guarded.hpp"
#include "memory.hpp"
#include "options.hpp"
#include "scaling.hpp"
#include "simd_targets.hpp"
#include "step_times.hpp"
#include "summary.hpp"
#include "whole_frame.hpp"

namespace {

using namespace mtstereo;

void print_help() {
  std::cout << "mtstereo-benchmark [--quick]\n"
               "          one frame size and 2 short repetitions, to check that everything runs\n"
               "  The environment variable MTSTEREO_TEST_DATA names the folder of kitti2015/.\n"
               "  Options of Google Benchmark, which override the settings of this program:\n";
  benchmark::PrintDefaultHelp();
}

int report(const bench::Summary& summary, const bench::Frame& main_frame) {
  const std::vector<bench::FrameTiming> timings = summary.timings();
  if (!timings.empty()) {
    std::cout << "\nMedians; the methods differ in density, see docs/benchmark.md.\n";
    eval::print_rows(std::cout, bench::frame_table(timings));
  }
  const std::vector<eval::TableRow> targets = bench::target_table(main_frame, summary);
  if (!targets.empty()) {
    std::cout << "\nSIMD targets: " << main_frame.name() << ", " << bench::kDefaultMethod
              << ", 1 thread\n";
    eval::print_rows(std::cout, targets);
  }
  for (const std::string& error : summary.errors()) std::cerr << "error: " << error << '\n';
  return summary.errors().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

int run(int argc, char** argv) {
  const std::size_t option = std::strlen(bench::kMemoryOption);
  if (argc == 2 && std::strncmp(argv[1], bench::kMemoryOption, option) == 0) {
    bench::measure_memory(argv[1] + option);
    return EXIT_SUCCESS;
  }
  const bench::Options options(argc, argv, {10, 0.2}, print_help);
  if (!options.good()) return EXIT_FAILURE;
  bench::add_context();

  bench::Summary summary;
  const std::vector<bench::FramePointer> frames =
      bench::frames(options.quick(), std::getenv("MTSTEREO_TEST_DATA"));
  bench::register_whole_frames(frames, summary);
  bench::register_steps(bench::main_frame(frames), options.quick() ? 0 : 0.2);
  bench::register_targets(bench::main_frame(frames));
  bench::register_scaling(options.quick());
  bench::register_memory(options.quick());
  bench::SummarizingReporter reporter(summary);
  if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) {
    std::cerr << "error: no benchmark was run; --benchmark_list_tests lists their names\n";
    return EXIT_FAILURE;
  }
  return report(summary, *bench::main_frame(frames));
}

}  // namespace

int main(int argc, char** argv) {
  return mtstereo::bench::guarded_main([&] { return run(argc, argv); });
}

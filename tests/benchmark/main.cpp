// SPDX-License-Identifier: LGPL-2.1-or-later
// mtstereo-benchmark: how long whole frames and single stages take, beside OpenCV's matchers.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <opencv2/core/version.hpp>
#include <string>
#include <vector>

#include "frames.hpp"
#include "memory.hpp"
#include "mtstereo/matcher.hpp"
#include "stages.hpp"
#include "summary.hpp"
#include "whole_frame.hpp"

namespace {

using namespace mtstereo;

constexpr const char* kQuickOption = "--quick";

void print_help() {
  std::cout << "mtstereo-benchmark [--quick]\n"
               "          one frame size and 2 short repetitions, to see that all still runs\n"
               "  The environment's MTSTEREO_TEST_DATA names the folder that has kitti2015/.\n"
               "  These are Google Benchmark's own, which go before what this program sets:\n";
  benchmark::PrintDefaultHelp();
}

/// The command line with what this program sets in front, so that the user's own options win.
std::vector<std::string> with_defaults(int argc, char** argv, bool& quick) {
  std::vector<std::string> arguments = {argv[0]};
  std::vector<std::string> own;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], kQuickOption) == 0) {
      quick = true;
    } else {
      own.emplace_back(argv[i]);
    }
  }
  arguments.emplace_back(quick ? "--benchmark_repetitions=2" : "--benchmark_repetitions=10");
  arguments.emplace_back(quick ? "--benchmark_min_time=0.001" : "--benchmark_min_time=0.2");
  arguments.emplace_back("--benchmark_display_aggregates_only=true");
  arguments.insert(arguments.end(), own.begin(), own.end());
  return arguments;
}

int report(const bench::Summary& summary) {
  const std::vector<bench::FrameTiming> timings = summary.timings();
  if (!timings.empty()) {
    std::cout << "\nMedians; how much of the frame is found differs, see docs/benchmark.md.\n";
    eval::print_rows(std::cout, bench::frame_table(timings));
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
  bool quick = false;
  std::vector<std::string> arguments = with_defaults(argc, argv, quick);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, pointers.data(), print_help);
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return EXIT_FAILURE;
  benchmark::AddCustomContext("mtstereo", version());
  benchmark::AddCustomContext("opencv", CV_VERSION);

  bench::Summary summary;
  const std::vector<bench::FramePointer> frames =
      bench::frames(quick, std::getenv("MTSTEREO_TEST_DATA"));
  bench::register_whole_frames(frames, summary);
  bench::register_stages(bench::main_frame(frames));
  bench::register_memory(quick);
  bench::SummarizingReporter reporter(summary);
  if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) {
    std::cerr << "error: no benchmark was run; --benchmark_list_tests tells their names\n";
    return EXIT_FAILURE;
  }
  return report(summary);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "error: something unknown was thrown\n";
  }
  return EXIT_FAILURE;
}

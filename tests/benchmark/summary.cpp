// SPDX-License-Identifier: LGPL-2.1-or-later
#include "summary.hpp"

#include <limits>
#include <string_view>
#include <utility>

#include "tools/eval/opencv_matchers.hpp"

namespace mtstereo::bench {
namespace {

double counter(const benchmark::BenchmarkReporter::Run& run, const char* name) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? 0.0 : static_cast<double>(found->second);
}

/// The time of the same frame with another method or number of threads, NaN if it was not timed.
double seconds_of(const std::vector<FrameTiming>& timings, const std::string& frame,
                  std::string_view method, int threads) {
  for (const FrameTiming& timing : timings) {
    if (timing.of.method == method && timing.of.frame == frame && timing.of.threads == threads) {
      return timing.seconds;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<eval::TableRow> frame_table(const std::vector<FrameTiming>& timings) {
  using eval::fixed;
  std::vector<eval::TableRow> rows = {{"frame", "method", "threads", "CPUs", "ms", "s/MP",
                                       "frames/s", "density %", "speedup", "time / semi-dense",
                                       "time / sgbm-3way", "time / bm"}};
  for (const FrameTiming& timing : timings) {
    const FrameCase& of = timing.of;
    const auto ratio_to = [&](std::string_view method) {
      return fixed(timing.seconds / seconds_of(timings, of.frame, method, of.threads), 2);
    };
    rows.push_back({of.frame, of.method, std::to_string(of.threads), fixed(timing.processors, 2),
                    fixed(timing.seconds * 1e3, 1), fixed(timing.seconds_per_megapixel, 3),
                    fixed(1 / timing.seconds, 1), fixed(timing.density * 100, 1),
                    fixed(seconds_of(timings, of.frame, of.method, 1) / timing.seconds, 2),
                    ratio_to(kDefaultMethod),
                    ratio_to(eval::opencv_name(eval::OpenCvMethod::kSgbm3Way)),
                    ratio_to(eval::opencv_name(eval::OpenCvMethod::kBm))});
  }
  return rows;
}

void Summary::expect_frame(const std::string& name, FrameCase of) {
  expected_.push_back({name, std::move(of)});
}

void Summary::take(const benchmark::BenchmarkReporter::Run& run) {
  if (run.error_occurred) {
    errors_.push_back(run.benchmark_name() + ": " + run.error_message);
    return;
  }
  // Single repetitions precede their median, which replaces them.
  const bool median = run.aggregate_name == "median";
  if (run.run_type == benchmark::BenchmarkReporter::Run::RT_Aggregate && !median) return;
  counters_[run.run_name.function_name] = run.counters;
  FrameTiming& timing = timed_[run.run_name.function_name];
  timing.seconds = run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
  timing.seconds_per_megapixel = counter(run, "s/MP");
  timing.density = counter(run, kDensityCounter);
  timing.processors = run.GetAdjustedCPUTime() / run.GetAdjustedRealTime();
}

std::vector<FrameTiming> Summary::timings() const {
  std::vector<FrameTiming> timings;
  for (const Expected& expected : expected_) {
    const auto found = timed_.find(expected.name);
    if (found == timed_.end()) continue;
    timings.push_back(found->second);
    timings.back().of = expected.of;
  }
  return timings;
}

double Summary::seconds_of(const std::string& name) const {
  const auto found = timed_.find(name);
  return found == timed_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second.seconds;
}

double Summary::counter_of(const std::string& name, const std::string& counter) const {
  const auto of_name = counters_.find(name);
  if (of_name == counters_.end() || of_name->second.count(counter) == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return static_cast<double>(of_name->second.at(counter));
}

void SummarizingReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs) {
    summary_.take(run);
    const bool aggregate = run.run_type == Run::RT_Aggregate;
    if (!aggregate || run.aggregate_name == "median" || run.aggregate_name == "cv") {
      shown.push_back(run);
    }
  }
  ConsoleReporter::ReportRuns(shown);
}

}  // namespace mtstereo::bench

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "eval/text_table.hpp"

namespace mtstereo::bench {

/// The counter of every whole frame that tells the share of pixels with a disparity.
inline constexpr const char* kDensityCounter = "density";

/// The method that the library's defaults are.
inline constexpr const char* kDefaultMethod = "semi-dense";

/// What the benchmark of a whole frame is about.
struct FrameCase {
  std::string frame;
  std::string method;
  int threads = 1;
};

/// What was measured of it.
struct FrameTiming {
  FrameCase of;
  double seconds = 0;                ///< of one frame [s]
  double seconds_per_megapixel = 0;  ///< [s/MP]
  double density = 0;                ///< 0 .. 1
  double processors = 0;             ///< at work at once, on average
};

/// The table of whole frames: time, how many processors were at work at once, how many times as
/// fast it is as with one thread, and the time as a multiple of what the defaults, StereoSGBM with
/// 3 directions and StereoBM take for the same frame with as many threads; "-" where the other was
/// not timed.
std::vector<eval::TableRow> frame_table(const std::vector<FrameTiming>& timings);

/// Collects what is reported: of each benchmark the median, or its only repetition.
class Summary {
 public:
  /// Announces the benchmark of a whole frame.
  void expect_frame(const std::string& name, FrameCase of);

  void take(const benchmark::BenchmarkReporter::Run& run);

  /// The whole frames that were timed, in the order they were announced.
  std::vector<FrameTiming> timings() const;
  /// The median of any benchmark [s], by its name without options; NaN where it was not timed.
  double seconds_of(const std::string& name) const;
  /// The same of one of its counters.
  double counter_of(const std::string& name, const std::string& counter) const;
  /// One sentence for each benchmark that failed, in the order they did.
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  struct Expected {
    std::string name;
    FrameCase of;
  };
  std::vector<Expected> expected_;
  std::map<std::string, FrameTiming> timed_;
  std::map<std::string, benchmark::UserCounters> counters_;
  std::vector<std::string> errors_;
};

/// Reports to a summary, and medians and their spread (cv) on the console.
class SummarizingReporter : public benchmark::ConsoleReporter {
 public:
  explicit SummarizingReporter(Summary& summary) : ConsoleReporter(OO_None), summary_(summary) {}
  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  Summary& summary_;
};

}  // namespace mtstereo::bench

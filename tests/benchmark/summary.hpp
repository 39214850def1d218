// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "tools/eval/text_table.hpp"

namespace mtstereo::bench {

/// The counter of the fraction of pixels with a disparity, which every whole frame has.
inline constexpr const char* kDensityCounter = "density";

/// The name of the library's defaults as a method.
inline constexpr const char* kDefaultMethod = "semi-dense";

/// The subject of a benchmark of a whole frame.
struct FrameCase {
  std::string frame;
  std::string method;
  int threads = 1;
};

/// Its measurements.
struct FrameTiming {
  FrameCase of;
  double seconds = 0;                ///< time of one frame [s]
  double seconds_per_megapixel = 0;  ///< [s/MP]
  double density = 0;                ///< 0 .. 1
  double processors = 0;             ///< average number of busy processors
};

/// The table of whole frames: time, average number of busy processors, speedup over one thread, and
/// the ratios of the time to those of the defaults, of StereoSGBM with 3 directions and of StereoBM
/// for the same frame with the same number of threads; "-" if the other was not timed.
std::vector<eval::TableRow> frame_table(const std::vector<FrameTiming>& timings);

/// Collects the median of each benchmark, or its only repetition.
class Summary {
 public:
  /// Announces the benchmark of a whole frame.
  void expect_frame(const std::string& name, FrameCase of);

  void take(const benchmark::BenchmarkReporter::Run& run);

  /// The timed whole frames in the order of their announcement.
  std::vector<FrameTiming> timings() const;
  /// The median of any benchmark [s], by its name without options; NaN if it was not timed.
  double seconds_of(const std::string& name) const;
  /// The same of one of its counters.
  double counter_of(const std::string& name, const std::string& counter) const;
  /// One sentence per failed benchmark, in order.
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

/// Reports to a summary, and prints medians and their spread (cv) on the console.
class SummarizingReporter : public benchmark::ConsoleReporter {
 public:
  explicit SummarizingReporter(Summary& summary) : ConsoleReporter(OO_None), summary_(summary) {}
  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  Summary& summary_;
};

}  // namespace mtstereo::bench

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mtstereo::bench::summary_test {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

Run repetition(const std::string& name, double milliseconds) {
  Run run;
  run.run_name.function_name = name;
  run.run_type = Run::RT_Iteration;
  run.iterations = 4;
  run.time_unit = benchmark::kMillisecond;
  run.real_accumulated_time = milliseconds * 1e-3 * 4;
  run.cpu_accumulated_time = 1.5 * run.real_accumulated_time;
  run.counters["s/MP"] = benchmark::Counter(milliseconds * 1e-3 / 0.5);
  run.counters[kDensityCounter] = benchmark::Counter(0.75);
  return run;
}

Run aggregate(const std::string& name, const std::string& kind, double milliseconds) {
  Run run = repetition(name, milliseconds);
  run.run_type = Run::RT_Aggregate;
  run.aggregate_name = kind;
  run.iterations = 1;
  run.real_accumulated_time = milliseconds * 1e-3;
  run.cpu_accumulated_time = 1.5 * run.real_accumulated_time;
  return run;
}

TEST(Summary, UsesTheOnlyRepetition) {
  Summary summary;
  summary.expect_frame("a", {"street", "semi-dense", 2});
  summary.take(repetition("a", 20));
  ASSERT_EQ(1U, summary.timings().size());
  const FrameTiming timing = summary.timings().front();
  EXPECT_EQ("street", timing.of.frame);
  EXPECT_EQ("semi-dense", timing.of.method);
  EXPECT_EQ(2, timing.of.threads);
  EXPECT_DOUBLE_EQ(0.020, timing.seconds);
  EXPECT_DOUBLE_EQ(0.040, timing.seconds_per_megapixel);
  EXPECT_DOUBLE_EQ(0.75, timing.density);
  EXPECT_DOUBLE_EQ(1.5, timing.processors);
}

TEST(Summary, UsesTheMedianOfSeveralRepetitionsAndNoOtherAggregate) {
  Summary summary;
  summary.expect_frame("a", {"street", "bm", 1});
  summary.take(repetition("a", 20));
  summary.take(repetition("a", 90));
  summary.take(aggregate("a", "mean", 55));
  summary.take(aggregate("a", "median", 30));
  summary.take(aggregate("a", "stddev", 7));
  ASSERT_EQ(1U, summary.timings().size());
  EXPECT_DOUBLE_EQ(0.030, summary.timings().front().seconds);
}

TEST(Summary, ExcludesFramesThatWereNotAnnouncedOrNotRun) {
  Summary summary;
  summary.expect_frame("a", {"street", "bm", 1});
  summary.take(repetition("stage", 20));
  EXPECT_TRUE(summary.timings().empty());
  EXPECT_TRUE(summary.errors().empty());
}

TEST(Summary, NamesFailedBenchmarksAndHasNoTimesOfThem) {
  Summary summary;
  summary.expect_frame("a", {"street", "bm", 1});
  benchmark::BenchmarkReporter::Run run = repetition("a", 20);
  run.error_occurred = true;
  run.error_message = "the maps differ";
  summary.take(run);
  EXPECT_TRUE(summary.timings().empty());
  ASSERT_EQ(1U, summary.errors().size());
  EXPECT_EQ("a: the maps differ", summary.errors().front());
}

// Columns of the table.
constexpr std::size_t kSpeedup = 8, kToDefault = 9, kToSgbm = 10, kToBm = 11;

TEST(FrameTable, DividesByRivalsWithTheSameFrameAndThreads) {
  const auto rows = frame_table({{{"f", "semi-dense", 1}, 0.100, 0.2, 0.5, 0.9},
                                 {{"f", "sgbm-3way", 1}, 0.050, 0.1, 0.7, 1},
                                 {{"f", "bm", 1}, 0.025, 0.05, 0.6, 1},
                                 {{"f", "bm", 2}, 0.001, 0.05, 0.6, 1},
                                 {{"g", "sgbm-3way", 1}, 0.001, 0.1, 0.7, 1}});
  ASSERT_EQ(6U, rows.size());
  EXPECT_EQ((eval::TableRow{"f", "semi-dense", "1", "0.90", "100.0", "0.200", "10.0", "50.0",
                            "1.00", "1.00", "2.00", "4.00"}),
            rows[1]);
  for (const eval::TableRow& row : rows) EXPECT_EQ(rows.front().size(), row.size());
  EXPECT_EQ("1.00", rows[2][kToSgbm]);
  EXPECT_EQ("0.50", rows[3][kToSgbm]);
}

TEST(FrameTable, DividesByDefaultsWithTheSameFrameAndThreads) {
  const auto rows = frame_table({{{"f", "semi-dense", 1}, 0.100, 0.2, 0.5, 1},
                                 {{"f", "semi-dense", 2}, 0.060, 0.2, 0.5, 2},
                                 {{"f", "fast", 1}, 0.025, 0.1, 0.5, 1},
                                 {{"f", "fast", 2}, 0.030, 0.1, 0.5, 2},
                                 {{"g", "fast", 1}, 0.030, 0.1, 0.5, 1}});
  ASSERT_EQ(6U, rows.size());
  EXPECT_EQ("0.25", rows[3][kToDefault]);
  EXPECT_EQ("0.50", rows[4][kToDefault]);
  EXPECT_EQ("-", rows[5][kToDefault]);
}

TEST(FrameTable, SpeedupIsRelativeToOneThreadOfTheSameFrameAndMethod) {
  const auto rows = frame_table({{{"f", "semi-dense", 1}, 0.100, 0.2, 0.5, 1},
                                 {{"f", "bm", 1}, 0.300, 0.2, 0.5, 1},
                                 {{"g", "semi-dense", 1}, 0.300, 0.2, 0.5, 1},
                                 {{"f", "semi-dense", 2}, 0.050, 0.2, 0.5, 2},
                                 {{"f", "sparse", 2}, 0.050, 0.2, 0.5, 2}});
  ASSERT_EQ(6U, rows.size());
  EXPECT_EQ("1.00", rows[1][kSpeedup]);
  EXPECT_EQ("2.00", rows[4][kSpeedup]);
  EXPECT_EQ("-", rows[5][kSpeedup]);
}

TEST(FrameTable, HasNoRatioIfTheRivalDidNotRun) {
  const auto rows = frame_table(
      {{{"f", "semi-dense", 1}, 0.100, 0.2, 0.5, 1}, {{"f", "bm", 2}, 0.010, 0.2, 0.5, 1}});
  ASSERT_EQ(3U, rows.size());
  EXPECT_EQ("-", rows[1][kToSgbm]);
  EXPECT_EQ("-", rows[1][kToBm]);
}

TEST(Summary, HasTimesOfBenchmarksThatWereNotAnnounced) {
  Summary summary;
  summary.take(repetition("target/SSSE3", 20));
  EXPECT_DOUBLE_EQ(0.020, summary.seconds_of("target/SSSE3"));
  EXPECT_DOUBLE_EQ(0.75, summary.counter_of("target/SSSE3", kDensityCounter));
  EXPECT_TRUE(std::isnan(summary.seconds_of("target")));
  EXPECT_TRUE(std::isnan(summary.counter_of("target", kDensityCounter)));
  EXPECT_TRUE(std::isnan(summary.counter_of("target/SSSE3", "pixels")));
}

}  // namespace
}  // namespace mtstereo::bench::summary_test

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simd_targets.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <set>

namespace mtstereo::bench::simd_targets_test {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

void take(Summary& summary, const std::string& name, double milliseconds) {
  Run run;
  run.run_name.function_name = name;
  run.run_type = Run::RT_Iteration;
  run.iterations = 1;
  run.time_unit = benchmark::kMillisecond;
  run.real_accumulated_time = milliseconds * 1e-3;
  summary.take(run);
}

TEST(SimdTargets, HaveDifferentNamesAndTheFastestFirst) {
  const std::vector<SimdTarget> targets = simd_targets();
  ASSERT_FALSE(targets.empty());
  std::set<std::string> names;
  for (const SimdTarget& target : targets) {
    names.insert(target.name);
    EXPECT_GE(target.id, targets.front().id);
  }
  EXPECT_EQ(targets.size(), names.size());
#if HWY_ARCH_X86_64 && !defined(__SSSE3__)
  EXPECT_EQ("EMU128", targets.back().name);
#endif
}

TEST(SimdTargets, ForcedTargetIsTheOnlyOneWithinItsScope) {
  const std::vector<SimdTarget> targets = simd_targets();
  for (const SimdTarget& target : targets) {
    const ForcedTarget forced(target);
    EXPECT_EQ(std::vector<std::int64_t>{target.id}, hwy::SupportedAndGeneratedTargets());
  }
  EXPECT_EQ(targets.size(), simd_targets().size());
}

TEST(TargetTable, DividesByTheFastestTarget) {
  const Frame frame(64, 48, 16);
  const std::vector<SimdTarget> targets = simd_targets();
  Summary summary;
  for (const SimdTarget& target : targets) {
    take(summary, "target/street-64x48-16/" + target.name, target.id == targets[0].id ? 10 : 25);
  }
  const auto rows = target_table(frame, summary);
  ASSERT_EQ(targets.size() + 1, rows.size());
  EXPECT_EQ("10.0", rows[1][1]);
  EXPECT_EQ("1.00", rows[1].back());
  for (std::size_t i = 2; i < rows.size(); ++i) {
    EXPECT_EQ("2.50", rows[i].back());
    EXPECT_EQ(rows.front().size(), rows[i].size());
  }
}

TEST(TargetTable, IsEmptyIfNothingOrAnotherFrameWasTimed) {
  Summary summary;
  const Frame frame(64, 48, 16);
  EXPECT_TRUE(target_table(frame, summary).empty());
  take(summary, "target/street-64x48-32/" + simd_targets().front().name, 10);
  EXPECT_TRUE(target_table(frame, summary).empty());
}

TEST(TargetTable, HasNoRatioToATargetThatWasNotTimed) {
  const std::vector<SimdTarget> targets = simd_targets();
  if (targets.size() < 2) GTEST_SKIP() << "this build has only one target";
  Summary summary;
  const Frame frame(64, 48, 16);
  take(summary, "target/street-64x48-16/" + targets.back().name, 10);
  const auto rows = target_table(frame, summary);
  ASSERT_EQ(2U, rows.size());
  EXPECT_EQ("-", rows[1].back());
}

}  // namespace
}  // namespace mtstereo::bench::simd_targets_test

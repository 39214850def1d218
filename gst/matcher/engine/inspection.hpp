// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>

namespace mtstereo::plugin {

/// Decides which pairs are inspected. The decision depends on the number of pairs since restart()
/// and on the results only, so that it is the same in every run.
class InspectionSchedule {
 public:
  /// While nothing is trusted, this many successive pairs are inspected after a restart, or after
  /// trust was lost. After that the interval applies.
  static constexpr int kAttempts = 4;

  /// A pair arrives. True if it is to be inspected, given an interval in pairs.
  bool due(int interval);
  /// The pair was inspected.
  void inspected(bool trusted);
  void restart() { *this = InspectionSchedule(); }

 private:
  int attempts_ = kAttempts;  // left
  int since_ = 0;             // pairs since the last inspection
  bool trusted_ = false;
};

/// Decides when to warn of problems: once per problem until it has disappeared. Sets of problems
/// are masks with one bit per problem.
class ProblemWarnings {
 public:
  /// A problem has disappeared if it was absent for this many intervals. A shorter absence can have
  /// other reasons, such as a seek, after which it has to be found again.
  static constexpr int kSettling = 5;

  /// A pair was checked, and these problems are present. Returns those to warn of now.
  std::uint32_t due(std::uint32_t problems, int interval);

 private:
  std::uint32_t reported_ = 0;
  std::array<std::int64_t, 32> absent_{};  // successive pairs without the problem
};

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace mtstereo::run {

/// What a progress line states: "120 of 480 pairs (25 %), 38.2 pairs/s, the matcher works 97 %
/// of the time, 9 s left".
std::string progress_text(std::int64_t done, std::int64_t total, double pairs_per_second,
                          double matching_share);

/// Prints the progress of a recording to stderr: a line that is rewritten on a terminal, and
/// otherwise one every ten seconds.
class ProgressLine {
 public:
  ProgressLine(std::string name, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// A pair was done; `milliseconds` is the time of the matcher, divided by the number of matchers
  /// that work at the same time.
  void show(std::int64_t done, std::int64_t total, double milliseconds);
  /// The last line, with the mean speed of all pairs if they took at least a second.
  void finish();
  /// Since the start [s].
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string text() const;
  void clear() const;

  std::string name_;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now(), first_ = start_, last_ = start_;
  Clock::time_point printed_ = start_;
  std::int64_t pairs_ = 0, done_ = 0, total_ = 0;
  double milliseconds_ = 0;  // of the matcher, since the first pair
};

}  // namespace mtstereo::run

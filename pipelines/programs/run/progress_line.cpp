// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs/run/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "lib/outputs/texts.hpp"

namespace mtstereo::run {
namespace {

constexpr std::chrono::milliseconds kOnTerminal{200};
constexpr std::chrono::seconds kElsewhere{10};

// Several pairs are often finished at once. Before that, a speed would say little.
constexpr double kSpeedKnown = 1;  // [s]

std::string time_left(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 120) return std::to_string(whole) + " s";
  if (whole < 7200) return std::to_string((whole + 59) / 60) + " min";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace

std::string progress_text(std::int64_t done, std::int64_t total, double pairs_per_second,
                          double matching_share) {
  std::string line = std::to_string(done) + " of " + std::to_string(total) + " pairs (" +
                     std::to_string(100 * done / total) + " %)";
  if (pairs_per_second <= 0) return line;
  line += outputs::format(", %.1f pairs/s, the matcher works %.0f %% of the time", pairs_per_second,
                          100 * matching_share);
  const double left = static_cast<double>(total - done) / pairs_per_second;
  return done < total ? line + ", " + time_left(left) + " left" : line;
}

ProgressLine::ProgressLine(std::string name, bool quiet)
    : name_(std::move(name)), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::clear() const {
  if (terminal_ && !quiet_) std::cerr << "\r\033[K" << std::flush;
}

// The speed between the first pair and the last one.
std::string ProgressLine::text() const {
  const double seconds = std::chrono::duration<double>(last_ - first_).count();
  const auto pairs = static_cast<double>(pairs_ - 1);
  const bool known = pairs_ > 1 && seconds >= kSpeedKnown;
  return name_ + ": " +
         progress_text(done_, total_, known ? pairs / seconds : 0,
                       known ? std::min(milliseconds_ / 1000 / seconds, 1.0) : 0);
}

void ProgressLine::show(std::int64_t done, std::int64_t total, double milliseconds) {
  last_ = Clock::now();
  if (pairs_ == 0) {
    first_ = last_;
  } else {
    milliseconds_ += milliseconds;
  }
  ++pairs_;
  done_ = done;
  total_ = total;
  if (quiet_ || last_ - printed_ < (terminal_ ? Clock::duration(kOnTerminal) : kElsewhere)) return;
  printed_ = last_;
  std::cerr << (terminal_ ? "\r\033[K" : "") << text() << (terminal_ ? "" : "\n") << std::flush;
}

void ProgressLine::finish() {
  if (quiet_ || pairs_ == 0) return;
  clear();
  std::cerr << text() << '\n';
}

double ProgressLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace mtstereo::run

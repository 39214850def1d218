// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/checks/clock_check.hpp"

#include <algorithm>

#include "recordings/clocks/undecided_clocks.hpp"

namespace mtstereo::run {
namespace {

constexpr Nanoseconds kCompared = 20 * kSecond;  // from the start of each source
constexpr Nanoseconds kShort = 5 * kSecond;      // motion rarely decides in less

FrameIndex beginning_of(const FrameIndex& index) {
  FrameIndex beginning = index;
  std::vector<Nanoseconds>& times = beginning.times;
  times.erase(std::upper_bound(times.begin(), times.end(), times.front() + kCompared), times.end());
  return beginning;
}

// How much later the right frames of the pairs are by their times.
double mean_difference(const Work& work) {
  double sum = 0;
  for (const FramePair& pair : work.pairs.pairs) {
    sum += seconds(work.right.times[static_cast<std::size_t>(pair.right)] -
                   work.left.times[static_cast<std::size_t>(pair.left)]);
  }
  return sum / static_cast<double>(work.pairs.pairs.size());
}

}  // namespace

TimeFigures check_clocks(const Work& work) {
  TimeFigures times;
  if (work.recording.arrangement != Arrangement::kTwoSources) {
    times.reason = "both views are in one frame";
    return times;
  }
  const double difference = mean_difference(work);
  const double stated =
      work.clocks ? work.clocks->relation.offset + work.clocks->relation.drift * work.clocks->time
                  : 0;
  times.apart = difference - stated;
  if (work.left.times.back() - work.left.times.front() < kShort) {
    times.reason = "the recording is too short";
    return times;
  }
  try {
    const ClockEstimate found =
        estimate_clocks(work.recording, beginning_of(work.left), beginning_of(work.right));
    times.apart = difference - found.relation.offset - found.relation.drift * found.time;
    times.measured = true;
    times.confirmed = found.confirmed;
    times.deviation = found.uncertainty;
  } catch (const UndecidedClocks& error) {
    times.reason = error.reason();
  }
  return times;
}

}  // namespace mtstereo::run

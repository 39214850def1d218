// SPDX-License-Identifier: LGPL-2.1-or-later
#include "recordings/clocks/frame_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace mtstereo::run {
namespace {

// A part of a frame by which times may be inexact: containers round them, cameras jitter.
constexpr int kSlackDivisor = 16;

// Half a frame of the slower source; times that are half a frame apart must not lose pairs by the
// rounding of a container.
Nanoseconds usual_tolerance(Nanoseconds period) { return period / 2 + period / kSlackDivisor; }

// The left times on the clock of the right recording.
std::vector<Nanoseconds> mapped(const std::vector<Nanoseconds>& times,
                                const ClockRelation& relation) {
  std::vector<Nanoseconds> result;
  result.reserve(times.size());
  for (const Nanoseconds time : times) {
    const double correction = relation.drift * static_cast<double>(time) + relation.offset * 1e9;
    result.push_back(time + std::llround(correction));
  }
  return result;
}

// How far the frame after number i is from a time.
Nanoseconds next_distance(const std::vector<Nanoseconds>& times, std::size_t i, Nanoseconds time) {
  if (i + 1 >= times.size()) return std::numeric_limits<Nanoseconds>::max() / 2;
  return std::abs(times[i + 1] - time);
}

}  // namespace

PairList pair_frames(const FrameIndex& left, const FrameIndex& right, const ClockRelation& relation,
                     std::optional<Nanoseconds> tolerance) {
  const std::vector<Nanoseconds> times = mapped(left.times, relation);
  const std::vector<Nanoseconds>& others = right.times;
  const Nanoseconds period = std::max(left.period, right.period);
  const Nanoseconds farthest = tolerance.value_or(usual_tolerance(period));
  // A frame keeps its partner unless the next one is clearly nearer: the same side is chosen all
  // the time if the frames of one source are in the middle between those of the other one.
  const Nanoseconds slack = std::min(left.period, right.period) / kSlackDivisor;
  PairList list;
  list.pairs.reserve(std::min(times.size(), others.size()));
  std::size_t i = 0, j = 0;
  while (i < times.size() && j < others.size()) {
    const Nanoseconds distance = std::abs(others[j] - times[i]);
    if (next_distance(others, j, times[i]) + slack < distance) {
      ++j;
    } else if (next_distance(times, i, others[j]) + slack < distance) {
      ++i;
    } else if (distance <= farthest) {
      list.pairs.push_back({static_cast<std::int64_t>(i++), static_cast<std::int64_t>(j++)});
    } else {
      ++(times[i] < others[j] ? i : j);
    }
  }
  const auto pairs = static_cast<std::int64_t>(list.pairs.size());
  list.dropped_left = static_cast<std::int64_t>(times.size()) - pairs;
  list.dropped_right = static_cast<std::int64_t>(others.size()) - pairs;
  return list;
}

PairList all_frames(const FrameIndex& both) {
  PairList list;
  list.pairs.reserve(both.times.size());
  for (std::size_t i = 0; i < both.times.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    list.pairs.push_back({number, number});
  }
  return list;
}

}  // namespace mtstereo::run

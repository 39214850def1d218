// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/pair_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <tuple>
#include <utility>

namespace mtstereo::plugin {
namespace {

/// A frame is at most this part of a frame from where its partner is expected: the neighbor of a
/// lost partner is at more than half a frame, and jitter adds to the error of the learned offset.
constexpr double kGate = 0.45;
/// The part of a frame that offset and jitter together may reach without doubt.
constexpr double kDoubtfulReach = 0.4;
/// Frames without a partner after which the offset is learned again.
constexpr int kMisses = 12;
/// Frames of one stream that are looked at to learn.
constexpr std::size_t kMostFrames = StreamOffset::kFrames + 2;

/// Steps from frame to frame from which a frame duration is measured. Most must not be of lost
/// frames.
constexpr std::size_t kStepsOfPeriod = 12;

PairDecision wait_for(Side side) { return {.action = PairAction::kWait, .side = side}; }

PairDecision drop_wrong_time(Side side, std::size_t index) {
  return {.action = PairAction::kDrop, .side = side, .index = index, .wrong_time = true};
}

/// The longest beginning in which the times increase.
std::size_t ordered_length(std::span<const Nanoseconds> times) {
  const auto end = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>());
  return end == times.end() ? times.size() : static_cast<std::size_t>(end - times.begin()) + 1;
}

}  // namespace

/// The median of the steps between frames, passed and waiting.
Nanoseconds PairFinder::Stream::period(std::span<const Nanoseconds> waiting) const {
  std::array<Nanoseconds, std::tuple_size_v<decltype(steps)> + kMostFrames> all{};
  auto end = std::copy_n(steps.begin(), std::min(count, steps.size()), all.begin());
  for (std::size_t i = 1; i < waiting.size() && end != all.end(); ++i) {
    if (waiting[i] > waiting[i - 1]) *end++ = bounded(waiting[i] - waiting[i - 1]);
  }
  if (static_cast<std::size_t>(end - all.begin()) < kStepsOfPeriod) return 0;
  const auto middle = all.begin() + (end - all.begin()) / 2;
  std::nth_element(all.begin(), middle, end);
  return *middle;
}

void PairFinder::Stream::passed(Nanoseconds time) {
  if (last && time > *last) steps[count++ % steps.size()] = bounded(time - *last);
  last = time;
}

void PairFinder::update_periods(const WaitingFrames& left, const WaitingFrames& right,
                                Nanoseconds tolerance) {
  const auto period_of = [](const Stream& stream, const WaitingFrames& frames) {
    if (frames.skipping && frames.period > 0) return frames.period;
    const Nanoseconds measured = stream.period(frames.times);
    // Jitter and loss do not prove that the caps are wrong.
    const bool plausible =
        frames.period > 0 && std::llabs(measured - frames.period) <= frames.period / 2;
    return measured == 0 || plausible ? frames.period : measured;
  };
  const Nanoseconds first = period_of(streams_[0], left);
  const Nanoseconds second = period_of(streams_[1], right);
  // Measured periods vary by the jitter.
  same_rate_ =
      first == 0 || second == 0 || std::llabs(first - second) <= std::max(first, second) / 8;
  period_ = first == 0 ? second : second == 0 ? first : std::min(first, second);
  if (period_ == 0) period_ = 2 * tolerance;
}

/// A first frame that is not after the last one of its stream.
std::optional<PairDecision> PairFinder::check_first(Side side, const WaitingFrames& frames) {
  Stream& here = stream(side);
  const Nanoseconds first = frames.times[0];
  if (!here.last || first > *here.last) return std::nullopt;
  if (frames.times.size() < 2) {
    return frames.complete ? drop_wrong_time(side, 0) : wait_for(side);
  }
  const Nanoseconds second = frames.times[1];
  if (second > *here.last || second <= first) return drop_wrong_time(side, 0);
  // The stream continues at an earlier time: a clock was reset, or a counter has wrapped around.
  here = Stream();
  offset_ = StreamOffset();
  return std::nullopt;
}

/// A frame that is not before its successor: one of the two has a wrong time stamp.
std::optional<PairDecision> PairFinder::check_order(Side side, const WaitingFrames& frames) {
  if (const auto step = check_first(side, frames)) return step;
  const std::size_t bad = ordered_length(frames.times) - 1;
  if (bad + 1 == frames.times.size()) return std::nullopt;
  const Nanoseconds time = frames.times[bad];
  const Nanoseconds next = frames.times[bad + 1];
  if (time == next) return drop_wrong_time(side, bad);
  const std::optional<Nanoseconds> before = bad > 0 ? frames.times[bad - 1] : stream(side).last;
  // The successor is the wrong one if this frame is where it is expected.
  if (before && next <= *before && !suspicious(side, time, time - *before)) return std::nullopt;
  if (before && next > *before) return drop_wrong_time(side, bad);
  if (bad + 2 < frames.times.size()) {
    const Nanoseconds third = frames.times[bad + 2];
    return drop_wrong_time(side, third > time ? bad + 1 : bad);
  }
  return frames.complete ? drop_wrong_time(side, bad) : wait_for(side);
}

/// True if a frame is so far after its predecessor, or a first frame so far from that of the other
/// stream, that its time may be wrong.
bool PairFinder::suspicious(Side side, Nanoseconds time, Nanoseconds distance) {
  const Stream& here = stream(side);
  const Nanoseconds step = std::max(here.period({}), period_);
  return (here.last ? time - *here.last : std::llabs(distance)) > step + step / 2;
}

PairDecision PairFinder::drop_older(Side older, const Ordered& left, const Ordered& right,
                                    Nanoseconds difference) {
  const Side newer = other_side(older);
  const Ordered& frames = newer == Side::kLeft ? left : right;
  if (frames.times.size() < 2 && !frames.complete &&
      suspicious(newer, frames.times[0], difference)) {
    return wait_for(newer);
  }
  return {.action = PairAction::kDrop, .side = older, .difference = difference};
}

/// Learns the offset, or returns the stream that is needed for it.
std::optional<PairDecision> PairFinder::learn(const Ordered& left, const Ordered& right) {
  if (offset_.learn(left.times, right.times, period_)) return std::nullopt;
  const auto open = [](const Ordered& frames) {
    return !frames.complete && frames.times.size() < kMostFrames;
  };
  const bool left_open = open(left) && left.times.size() < StreamOffset::kFrames;
  const bool right_open = open(right) && right.times.size() < StreamOffset::kFrames;
  if (left_open && (!right_open || left.times.size() <= right.times.size())) {
    return wait_for(Side::kLeft);
  }
  if (right_open) return wait_for(Side::kRight);
  // No more frames to learn from will come: the difference of a single pair has to do.
  const auto frames = static_cast<int>(std::min(left.times.size(), right.times.size()));
  offset_.learn(left.times, right.times, period_, frames);
  return std::nullopt;
}

/// Streams that are half a frame apart must not change partners with every jitter: then a pair may
/// exceed a tolerance of half a frame by this much.
Nanoseconds PairFinder::slack(Nanoseconds tolerance) const {
  const bool half = std::llabs(2 * tolerance - period_) <= period_ / 50;
  return same_rate_ && offset_.known() && half ? period_ / 10 : 0;
}

PairDecision PairFinder::decide(const Ordered& left, const Ordered& right, Nanoseconds tolerance) {
  const Nanoseconds raw = bounded(right.times[0] - left.times[0]);
  const Nanoseconds distance = bounded(raw - (same_rate_ ? offset_.value() : 0));
  const Nanoseconds size = std::llabs(distance);
  const Side older = distance >= 0 ? Side::kLeft : Side::kRight;
  const bool tolerated = std::llabs(raw) <= tolerance + slack(tolerance);
  if (tolerated && size <= period_ / 4) return {.action = PairAction::kPair, .difference = raw};
  const bool far = same_rate_ && offset_.known() &&
                   static_cast<double>(size) > kGate * static_cast<double>(period_);
  if (!tolerated || far) return drop_older(older, left, right, raw);
  // The next frame of the older stream may be nearer.
  const Ordered& frames = older == Side::kLeft ? left : right;
  if (frames.times.size() >= 2) {
    const Nanoseconds step = frames.times[1] - frames.times[0];
    if (std::llabs(size - step) < size) {
      return {.action = PairAction::kDrop, .side = older, .difference = raw};
    }
  } else if (!frames.complete) {
    return wait_for(older);
  }
  return {.action = PairAction::kPair, .difference = raw};
}

PairDecision PairFinder::next(const WaitingFrames& left, const WaitingFrames& right,
                              Nanoseconds tolerance) {
  update_periods(left, right, tolerance);
  // Both streams repeat the times of their last pair: a file whose time stamps are wrong, but
  // alike.
  if (last_paired_ && left.times[0] == streams_[0].last && right.times[0] == streams_[1].last) {
    return {.action = PairAction::kPair, .difference = right.times[0] - left.times[0]};
  }
  for (const Side side : kSides) {
    if (const auto step = check_order(side, side == Side::kLeft ? left : right)) return *step;
  }
  const auto ordered = [](const WaitingFrames& frames) {
    const std::size_t length = ordered_length(frames.times);
    return Ordered{frames.times.first(length), frames.complete || length < frames.times.size()};
  };
  const Ordered lefts = ordered(left);
  const Ordered rights = ordered(right);
  const Nanoseconds raw = bounded(rights.times[0] - lefts.times[0]);
  if (same_rate_ && !offset_.known() && std::llabs(raw) <= tolerance) {
    const auto safe = static_cast<Nanoseconds>(kSafeOffset * static_cast<double>(period_));
    if (std::llabs(raw) <= safe) return {.action = PairAction::kPair, .difference = raw};
    if (const auto step = learn(lefts, rights)) return *step;
    update_doubt();
  }
  // An offset beyond the tolerance leads to no pairs at all.
  if (same_rate_ && std::llabs(offset_.value()) > tolerance + slack(tolerance) / 2 &&
      tolerance * 2 >= period_ - period_ / 100) {
    offset_.slip(offset_.value() > 0 ? -period_ : period_);
    new_doubt_ = PairDoubt::kSlip;
  }
  return decide(lefts, rights, tolerance);
}

void PairFinder::dropped(Side side, Nanoseconds time) {
  stream(side).passed(time);
  last_paired_ = false;
  if (++misses_ < kMisses) return;
  misses_ = 0;
  offset_.forget();
}

void PairFinder::paired(Nanoseconds left, Nanoseconds right) {
  stream(Side::kLeft).passed(left);
  stream(Side::kRight).passed(right);
  misses_ = 0;
  last_paired_ = true;
  if (!same_rate_) return;
  offset_.add(left, right - left);
  update_doubt();
}

void PairFinder::update_doubt() {
  const auto period = static_cast<double>(period_);
  const double offset = std::abs(static_cast<double>(offset_.value()));
  const double spread = offset_.line().statistics().spread;
  const double limit = doubtful_ ? 0.75 * kSafeOffset : kSafeOffset;
  const bool doubtful = offset > limit * period || offset + 2 * spread > kDoubtfulReach * period;
  if (doubtful && !doubtful_) new_doubt_ = PairDoubt::kOffset;
  doubtful_ = doubtful;
}

bool DoubtWarning::due(PairDoubt doubt, Nanoseconds now) {
  auto& last = last_[static_cast<std::size_t>(doubt)];
  if (last && now - *last < kInterval) return false;
  last = now;
  return true;
}

PairDoubt PairFinder::new_doubt() { return std::exchange(new_doubt_, PairDoubt::kNone); }

}  // namespace mtstereo::plugin

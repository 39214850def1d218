// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/tolerance.hpp"

#include <algorithm>

namespace mtstereo::plugin {

std::optional<Nanoseconds> FrameDurations::shorter() const {
  if (left && right) return std::min(*left, *right);
  return left ? left : right;
}

Nanoseconds effective_tolerance(Nanoseconds set, const FrameDurations& caps,
                                const FrameDurations& buffers) {
  if (set >= 0) return set;
  if (const auto duration = caps.shorter()) return *duration / 2;
  if (const auto duration = buffers.shorter()) return *duration / 2;
  return kFallbackTolerance;
}

Nanoseconds WaitingFrame::deadline(bool left, Nanoseconds time, Nanoseconds now,
                                   Nanoseconds latency) {
  if (time_ != time || left_ != left) {
    left_ = left;
    time_ = time;
    since_ = now;
  }
  return std::max(time, since_ + kGrace - latency);
}

bool UnpairedWarning::dropped(Nanoseconds now) {
  ++run_;
  if (run_ < kRun) return false;
  if (last_ && now - *last_ < kInterval) return false;
  last_ = now;
  return true;
}

}  // namespace mtstereo::plugin

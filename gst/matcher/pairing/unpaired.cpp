// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/pairing/unpaired.hpp"

#include <algorithm>

namespace mtstereo::plugin {

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

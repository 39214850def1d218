// SPDX-License-Identifier: LGPL-2.1-or-later
#include "matcher/silence.hpp"

#include <utility>

namespace mtstereo::plugin {
namespace {

std::optional<Side> silent_side(const StreamsObservation& streams) {
  if (streams.busy || streams.waiting[0] == streams.waiting[1]) return std::nullopt;
  const std::size_t silent = streams.waiting[0] ? 1 : 0;
  if (streams.ended[silent]) return std::nullopt;
  return silent == 0 ? Side::kLeft : Side::kRight;
}

}  // namespace

std::optional<Side> SilenceDetector::silent(const StreamsObservation& streams, Nanoseconds now,
                                            Nanoseconds timeout) {
  const auto side = silent_side(streams);
  if (side != side_ || streams.progress != progress_) {
    side_ = side;
    since_ = now;
    progress_ = streams.progress;
    reported_ = false;
  }
  if (!side_ || reported_ || now - since_ < timeout) return std::nullopt;
  reported_ = true;
  return side_;
}

bool LongWait::due(bool waits, Nanoseconds now, Nanoseconds timeout) {
  if (!waits) {
    *this = {};
    return false;
  }
  if (!since_) since_ = now;
  if (now - *since_ < timeout) return false;
  return !std::exchange(reported_, true);
}

}  // namespace mtstereo::plugin

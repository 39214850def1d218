// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/numbered_views.hpp"

namespace mtstereo::test {

// Streams of cameras that are triggered together, whose time stamps and transport are not perfect.

/// A signed time [ns].
using Nanoseconds = std::int64_t;

/// What is wrong with a stream.
struct Defects {
  Nanoseconds skew = 0;    ///< added to every time stamp [ns]
  double drift = 0;        ///< growth of the skew [s per s]
  Nanoseconds jitter = 0;  ///< every time stamp varies by up to this much, both ways [ns]
  double loss = 0;         ///< the probability that a frame is lost
};

/// `count` frames, numbered from 0, with these defects. The time stamps begin at 1 s, so that none
/// is negative.
std::vector<NumberedFrame> defective_sequence(int count, const Defects& defects, unsigned seed,
                                              GstClockTime interval = kFrame);

/// The wrong pairs before the first warning about the times of the frames. A map that does not
/// state the difference counts as wrong. A pair is right if its difference is at most `allowed`.
int wrong_without_warning(const FeedResult& result, int allowed = 0);

/// The numbers of maps and wrong pairs, and the warnings.
std::string summary(const FeedResult& result);

}  // namespace mtstereo::test

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"
#include "matcher/pairing/pair_finder.hpp"

namespace mtstereo::plugin {

/// Why steps are taken now.
enum class Occasion {
  kFrames,    ///< both streams have a frame, or have ended
  kDeadline,  ///< the oldest frame waits no longer
  kEnd,       ///< one stream has just ended; the rest of the other one is left to the next occasion
};

/// What is done next.
enum class StepKind {
  kWait,    ///< for a frame
  kEnd,     ///< no pair can follow
  kPair,    ///< the frames `left` and `right` are a pair
  kDrop,    ///< `left` or `right` has no partner
  kGap,     ///< `left` is a gap
  kPassed,  ///< a gap of the right stream has been passed
  kNoTime,  ///< error: a frame has no time, the other one has
};

/// A step, with the frames that it takes from the queues.
struct Step {
  StepKind kind = StepKind::kWait;
  Side side = Side::kLeft;  ///< of the frame that is dropped or has no time
  QueuedFrame left{};
  QueuedFrame right{};
  bool at_deadline = false;      ///< it is dropped because its partner has not arrived
  bool wrong_time = false;       ///< it is dropped because of its time stamp
  bool without_message = false;  ///< it is dropped where a frame without a partner is normal
  Nanoseconds difference = 0;    ///< of the two frames, right minus left
  Nanoseconds tolerance = 0;
  PairDoubt doubt = PairDoubt::kNone;

  QueuedFrame& frame() { return side == Side::kLeft ? left : right; }
};

/// Takes the next step: looks at the pads and changes the queues. The caller sends and reports what
/// follows from it. Runs in the task of the source pad, without locks.
Step next_step(ElementState& state, Occasion occasion);

}  // namespace mtstereo::plugin

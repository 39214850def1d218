// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"
#include "matcher/pairing/pair_finder.hpp"

// Messages about frames and pairs. Call them without locks, in the task of the source pad.

namespace mtstereo::plugin {

/// A frame had no partner, because the next one of the other side is too far away.
void report_difference(ElementState& state, Nanoseconds difference, Nanoseconds tolerance);

/// A frame had no partner, because none arrived on this side in time.
void report_lateness(ElementState& state, Side silent);

/// The pairs may be wrong although their times fit.
void report_doubt(ElementState& state, PairDoubt doubt);

/// Errors: time stamps on one side only; no reference time stamp on a side.
GstFlowReturn refuse_mixed_stamping(ElementState& state, bool left_has_time);
GstFlowReturn refuse_missing_reference(ElementState& state, Side side);

/// A change to sync-mode=reference-timestamp was taken back.
void warn_of_missing_reference(ElementState& state, Side side);

/// Logs the difference of the streams' times at the first pair and when it has changed.
void log_offset(ElementState& state);

}  // namespace mtstereo::plugin

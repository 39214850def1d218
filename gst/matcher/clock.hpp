// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// The running time of the pipeline; std::nullopt if there is no clock or its base time is not
/// valid yet, which is the case before PLAYING. Takes the object lock. Any thread.
std::optional<Nanoseconds> running_time_now(const ElementState& state);

/// True if a source is live, so that frames have a deadline. Takes the lock of the aggregator: not
/// with the object lock. Any thread.
bool is_live(const ElementState& state);

}  // namespace mtstereo::plugin

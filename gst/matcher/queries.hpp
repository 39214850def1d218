// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

// Any thread.

/// Answers a query on a sink pad.
bool answer_sink_query(ElementState& state, GstAggregatorPad* pad, GstQuery* query);

/// Answers a query on the source pad.
bool answer_source_query(ElementState& state, GstQuery* query);

}  // namespace mtstereo::plugin

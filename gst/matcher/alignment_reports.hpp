// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Adds the fields on alignment to a structure: those of the property `stats` and of the message
/// `mtstereo-alignment`.
void add_alignment_fields(GstStructure* structure, const AlignmentReport& report);

/// Publishes what is known about the alignment after a pair: the property `alignment-field`, the
/// fields of `stats`, the message, and a warning for each new problem. Runs in the task of the
/// source pad.
void publish_alignment(ElementState& state);

}  // namespace mtstereo::plugin

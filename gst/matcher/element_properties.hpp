// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Adds the element's properties: those of the parameter table and its own.
void install_properties(GObjectClass* object_class);

/// Sets a property. A value that the core refuses is kept in Settings::problem. Any thread.
void set_element_property(ElementState& state, guint id, const GValue* value, GParamSpec* spec);

/// Reads a property. Any thread.
void get_element_property(ElementState& state, guint id, GValue* value, GParamSpec* spec);

}  // namespace mtstereo::plugin

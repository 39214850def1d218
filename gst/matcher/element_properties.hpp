// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Installs all properties of the element: those of the parameter table and its own.
void install_properties(GObjectClass* object_class) noexcept;

/// Sets a property. If the core rejects the value, the reason is stored in Settings::problem. Any
/// thread.
void set_element_property(ElementState& state, guint id, const GValue* value, GParamSpec* spec);

/// Reads a property. Any thread.
void get_element_property(ElementState& state, guint id, GValue* value, GParamSpec* spec);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"

namespace mtstereo::plugin {

/// Installs all properties of the element.
void install_properties(GObjectClass* object_class) noexcept;

/// Sets a property. Any thread.
void set_element_property(ElementState& state, guint id, const GValue& value,
                          const GParamSpec* spec);

/// Reads a property. Any thread.
void get_element_property(ElementState& state, guint id, GValue& value, const GParamSpec* spec);

}  // namespace mtstereo::plugin

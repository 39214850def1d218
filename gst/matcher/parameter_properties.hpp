// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {

/// The id of the first property that is made from the parameter table; the others follow in the
/// order of the table. Smaller ids are the element's own.
inline constexpr guint kFirstParameterProperty = 100;

/// Adds a property for every row of the parameter table to an element's class: type, range, default
/// (of the mode semi-dense) and help come from the row.
void install_parameter_properties(GObjectClass* object_class);

/// The parameter of a property id, or nullptr where the id is none of these.
const ParameterInfo* parameter_of_property(guint property_id);

/// Sets a parameter from a property's value. The message of a failure is the core's.
Status set_parameter_from_value(Parameters& parameters, const ParameterInfo& info,
                                const GValue& value);

/// Writes the value in force into a property's value.
void parameter_to_value(const Parameters& parameters, const ParameterInfo& info, GValue& value);

}  // namespace mtstereo::plugin

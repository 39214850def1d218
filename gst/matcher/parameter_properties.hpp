// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include "mtstereo/parameters.hpp"

namespace mtstereo::plugin {

/// The id of the first property of the parameter table; the others follow in the order of the
/// table. Smaller ids are those of the element's own properties.
inline constexpr guint kFirstParameterProperty = 100;

/// Installs a property for every row of the parameter table. Type, range, default (of preset
/// default and mode semi-dense), blurb and the descriptions of enumeration values are those of the
/// row.
void install_parameter_properties(GObjectClass* object_class);

/// The parameter of a property id, or nullptr for the other properties.
const ParameterInfo* parameter_of_property(guint property_id);

/// Sets a parameter to the value of its property. A failure has the message of the core.
Status set_parameter_from_value(Parameters& parameters, const ParameterInfo& info,
                                const GValue& value);

/// Copies the effective value of a parameter to the value of its property.
void parameter_to_value(const Parameters& parameters, const ParameterInfo& info, GValue& value);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <glib-object.h>

#include "cameras/rectification_plan.hpp"

namespace mtstereo::plugin {

/// Installs the properties of mtrectify.
void install_rectify_properties(GObjectClass* object_class);

/// Sets a value; false if there is no such property.
bool set_rectify_property(RectifySettings& settings, guint id, const GValue* value);
/// Gets a value; false if there is no such property.
bool get_rectify_property(const RectifySettings& settings, guint id, GValue* value);

}  // namespace mtstereo::plugin

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cameras/rectification_plan.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {

/// The properties of mtrectify.
const PropertyTable<RectifySettings>& rectify_properties();

}  // namespace mtstereo::plugin

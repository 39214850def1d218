// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "matcher/engine/match_settings.hpp"
#include "shared/properties.hpp"

namespace mtstereo::plugin {

/// A property for every row of the parameter table. Type, range, default (of preset default and
/// mode semi-dense), blurb and the descriptions of enumeration values come from the row.
///
/// Each parameter is a property of its own, also those that only experts change: the names are
/// those of the library, the programs and the paper, gst-launch-1.0 sets them one by one, and
/// gst-inspect-1.0 shows type, range and default of each. A property of type GstStructure with
/// several of them would have none of this. The blurbs of the latter begin with "Expert:".
std::vector<Property<MatchSettings>> parameter_rows();

}  // namespace mtstereo::plugin

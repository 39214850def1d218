// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/base/stream_formats.hpp"
#include "shared/disparity_meta.hpp"
#include "shared/ownership.hpp"

namespace mtstereo::plugin {

/// The caps of disparity maps of this unit, for a left stream of this format.
CapsPointer output_caps(const StreamFormat& left, const DisparityUnit& unit);

}  // namespace mtstereo::plugin

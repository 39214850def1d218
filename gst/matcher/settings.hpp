// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "matcher/element_state.hpp"
#include "shared/disparity_meta.hpp"

namespace mtstereo::plugin {

/// Applies the property values to the matcher if they, or the size of the left stream, have changed
/// since the last call. Runs in the task of the source pad, and at the start.
///
/// Values that do not fit each other, the frame size or downstream are not applied: if the last
/// ones fit, the properties return to these, and a warning is posted. Otherwise there is nothing to
/// match with: an error is posted, and false is returned.
bool apply_settings(ElementState& state);

/// Chooses the disparity scale if none was set: 256, or the largest smaller power of two with which
/// the search range fits into 16 bits. To be called after every change of a parameter.
void fit_scale(Settings& settings);

/// The unit of the disparity maps with these settings.
DisparityUnit unit_of(const Settings& settings);

}  // namespace mtstereo::plugin

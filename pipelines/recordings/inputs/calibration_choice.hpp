// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/inputs/data_sets.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Sets the calibration of a recording whose views have this size, and whether the views are
/// rectified. The calibration of the options is used, or the nearest that can be read, fits the
/// size and does not contradict the names of the views. The choice is a remark. Throws UserError
/// for the one of the options, and if there are several beside the input.
void choose_calibration(FoundRecording& found, const InputOptions& options, int width, int height);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/inputs/data_sets.hpp"
#include "recordings/inputs/recording.hpp"

namespace mtstereo::run {

/// Looks at the first frames: checks the sizes, finds the arrangement of one source, and chooses
/// the calibration. Throws UserError.
Recording completed(FoundRecording found, const InputOptions& options);

}  // namespace mtstereo::run

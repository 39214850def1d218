// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "run/piece.hpp"

namespace mtstereo::run {

/// Measures the correction of the views on pairs from the whole recording, and sets
/// Work::correction. What is wrong with the views becomes remarks. Throws RunError.
void measure_correction(Work& work);

}  // namespace mtstereo::run

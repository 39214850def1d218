// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// Whether rows and sharpness are corrected: not with alignment=off, the default of preset paper.
bool is_corrected(const WorkOptions& options);

/// Measures the correction of the views on pairs from the whole recording, and sets
/// Work::correction. What is wrong with the views becomes remarks. Throws UserError.
void measure_correction(Work& work);

}  // namespace mtstereo::run

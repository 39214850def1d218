// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// The numbers of at most twelve of so many pairs, spread evenly over the recording.
std::vector<std::int64_t> sample_pairs(std::int64_t pairs);

/// Measures the correction of the views on pairs from the whole recording, and sets
/// Work::correction. What is wrong with the views becomes remarks. Throws UserError.
void measure_correction(Work& work);

}  // namespace mtstereo::run

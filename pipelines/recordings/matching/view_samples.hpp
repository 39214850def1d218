// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "recordings/matching/piece.hpp"
#include "recordings/matching/view_checks.hpp"

namespace mtstereo::run {

/// Reads small images of a few pairs from the whole recording, with right views that are so many
/// frames later; negative: earlier. Needs the pairs and the complete options of a work. Throws
/// UserError.
ViewSamples read_view_samples(const Work& work, const std::vector<int>& shifts);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// The first part of prepare(): indexes, geometry, clocks, pairs and their period. A range that is
/// to be found is left as it is, and nothing is matched but for the clocks. Throws UserError.
Work prepare_pairs(const Recording& recording, const WorkOptions& options,
                   const std::optional<ClockRelation>& relation, bool estimate);

}  // namespace mtstereo::run

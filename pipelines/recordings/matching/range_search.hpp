// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// Whether the range of disparities is to be found: max-disparity is "auto" or 0.
bool finds_range(const WorkOptions& options);

/// Replaces max-disparity=auto by what pairs from the whole recording need: they are matched at
/// half resolution in a range of half the width of the views. If they do not match, the default
/// stays. Either is a remark. Needs the pairs, their period and the geometry. Throws UserError if
/// no pair can be decoded.
void find_range(Work& work);

}  // namespace mtstereo::run

// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "geometry/remapping.hpp"
#include "mtstereo/geometry/rectification.hpp"

namespace mtstereo {

/// For each row the longest of its runs; the first one of several. Rows without runs have 0 .. 0.
std::vector<ValidColumns> longest_runs(const std::vector<PixelRun>& runs, int height);

/// The largest upright rectangle whose rows are inside of these columns; empty if all rows are.
PixelRectangle largest_rectangle(const std::vector<ValidColumns>& columns);

}  // namespace mtstereo

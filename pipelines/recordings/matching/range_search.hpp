// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "recordings/matching/piece.hpp"

namespace mtstereo::run {

/// Whether the range of disparities is to be found: max-disparity is "auto" or 0.
bool finds_range(const WorkOptions& options);

/// The disparities of pairs from the whole recording.
struct FoundRange {
  int pairs = 0;       ///< that match
  double largest = 0;  ///< that 99.8 % of the disparities of each pair do not exceed [px]
  /// The same of the most reliable disparities, which miss some near things but are hardly ever
  /// wrong [px].
  double reliable = 0;
  int max_disparity = 0;  ///< with a tenth in reserve, rounded up to a multiple of 16 [px]
};

/// Matches pairs at half resolution in a range of half the width of the views. None if they do not
/// match. Needs the pairs, their period and the geometry. Throws UserError if no pair can be
/// decoded.
std::optional<FoundRange> search_range(const Work& work);

/// Sets max-disparity.
void set_range(Work& work, int max_disparity);

/// Replaces max-disparity=auto by what search_range() finds; without it, the default stays. Either
/// is a remark. Throws UserError as that does.
void find_range(Work& work);

}  // namespace mtstereo::run

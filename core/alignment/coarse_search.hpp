// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "alignment/corner_grid.hpp"
#include "base/buffer.hpp"

namespace mtstereo {

/// Finds a corner of the left reduced view in the right one, by the sum of absolute differences of
/// patches. All lengths count pixels of the reduced views.

/// Which displacements from the left to the right view are searched: disparities and rows.
struct SearchWindow {
  int least_disparity;  ///< can be negative
  int most_disparity;
  int rows;  ///< up and down
};

/// The patch: columns -8 .. 7 and rows -5 .. 5 around the corner.
inline constexpr int kPatchWidth = 16;
inline constexpr int kPatchRows = 11;

/// The best place must be better than all places more than kNeighborhood away from it by this
/// factor.
inline constexpr double kDistinctness = 1.15;
inline constexpr int kNeighborhood = 2;

/// The corner is part of a repeated pattern if the best place is not distinct although its cost is
/// less than this fraction of the contrast of the patch.
inline constexpr double kRepeatedCost = 0.25;

/// A place in the other view, or why there is none.
struct Place {
  enum class Outcome { kFound, kNotFound, kRepeated };

  Outcome outcome = Outcome::kNotFound;
  int x = 0;
  int y = 0;

  bool found() const { return outcome == Outcome::kFound; }
};

/// Sums of absolute differences of one search.
struct SearchScratch {
  Buffer<std::int32_t> costs;

  void resize(const SearchWindow& window);
};

/// The place of the corner in the right view, if it is distinct and if the search from there in the
/// left view leads back to the corner within 1 px.
Place find_in_right_view(const Image<std::uint8_t>& left, const Image<std::uint8_t>& right,
                         const Corner& corner, const SearchWindow& window, SearchScratch& scratch);

}  // namespace mtstereo

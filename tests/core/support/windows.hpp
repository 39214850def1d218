// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "reference/pixels/search_windows.hpp"
#include "stages/pixels/search_windows.hpp"
#include "support/random.hpp"

namespace mtstereo::test {

/// Windows of all kinds for views of this size: every few tiles a vote for a few disparities.
inline SearchWindows random_windows(int width, int height, int lanes, Random& random) {
  WindowVotes votes;
  votes.resize(width, height, lanes);
  clear_votes(0, (height + 1) / 2, votes);
  for (int tile = 0; tile < votes.columns * votes.rows; ++tile) {
    votes.known[tile] = 64;
    if (random.below(4) == 0) votes.by_path[tile * votes.bins + random.below(votes.bins)] = 64;
  }
  SearchWindows windows;
  windows.resize(width, height);
  choose_windows(votes, windows);
  return windows;
}

/// The same windows for the references.
inline reference::Windows copy_of(const SearchWindows& windows, int width, int height) {
  reference::Windows copy;
  if (windows.row(0) == nullptr) return copy;
  copy.columns = (width + kWindowTile - 1) / kWindowTile;
  for (int y = 0; y < height; y += kWindowTile) {
    copy.tiles.insert(copy.tiles.end(), windows.row(y), windows.row(y) + copy.columns);
  }
  return copy;
}

}  // namespace mtstereo::test

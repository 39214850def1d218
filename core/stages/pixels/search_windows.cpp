// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_windows.hpp"

#include <algorithm>
#include <cstring>

#include "mtstereo/image.hpp"

namespace mtstereo {
namespace {

int tiles_of(int size) { return (size + kWindowTile - 1) / kWindowTile; }

/// Votes for all bins within kVoteReach of twice each known disparity. Returns how many are known.
int vote(const std::int32_t* disparities, int count, int bins, std::uint8_t* votes) {
  static_assert(2 * kVoteReach < kWindowStep);  // so it is one bin, or two
  static_assert(kWindowStep == 1 << 4 && kDisparityOne == 1 << 8);
  std::int32_t padded[kVotingRows] = {};
  std::int16_t first[kVotingRows], last[kVotingRows];
  if (count < kVotingRows) {
    std::copy_n(disparities, count, padded);
    disparities = padded;
  }
  // Compilers vectorize the loop. Words, since all processors have their minimum and maximum.
  for (int i = 0; i < kVotingRows; ++i) {
    const auto full = static_cast<std::int16_t>((2 * disparities[i] + kDisparityOne / 2) >> 8);
    const auto low = static_cast<std::int16_t>(full - kVoteReach);
    const auto high = static_cast<std::int16_t>(full + kVoteReach);
    first[i] = static_cast<std::int16_t>(std::max<std::int16_t>(low, 0) >> 4);
    last[i] = std::min<std::int16_t>(static_cast<std::int16_t>(high >> 4),
                                     static_cast<std::int16_t>(bins - 1));
  }
  int known = 0;
  for (int i = 0; i < kVotingRows; ++i) {
    if (disparities[i] == kNoDisparity) continue;
    ++known;
    if (first[i] <= last[i]) ++votes[first[i]];
    if (first[i] < last[i]) ++votes[last[i]];
  }
  return known;
}

/// The number of pixels whose disparities agree.
int count_agreeing(const std::int32_t* by_path, const std::int32_t* by_cost, int count) {
  constexpr int kMost = kMostDisagreement * kDisparityOne;
  int agreeing = 0;
  for (int i = 0; i < count; ++i) {
    const int difference = by_path[i] - by_cost[i];
    const bool known = by_path[i] != kNoDisparity && by_cost[i] != kNoDisparity;
    agreeing += known && difference <= kMost && difference >= -kMost ? 1 : 0;
  }
  return agreeing;
}

/// Adds up the votes of each tile of a row and of the tiles around it. A tile has `count` of them.
void sum_around(const Buffer<std::uint8_t>& votes, const WindowVotes& size, int row, int count,
                Buffer<std::uint16_t>& rows, Buffer<std::uint16_t>& sums) {
  const std::ptrdiff_t length = static_cast<std::ptrdiff_t>(size.columns) * count;
  std::fill_n(rows.data(), rows.size(), std::uint16_t{0});
  std::uint16_t* const middle = rows.data() + count;
  for (int y = std::max(row - 1, 0); y < std::min(row + 2, size.rows); ++y) {
    const std::uint8_t* const in = votes.data() + y * length;
    for (std::ptrdiff_t i = 0; i < length; ++i) {
      middle[i] = static_cast<std::uint16_t>(middle[i] + in[i]);
    }
  }
  for (std::ptrdiff_t i = 0; i < length; ++i) {
    sums[i] = static_cast<std::uint16_t>(middle[i - count] + middle[i] + middle[i + count]);
  }
}

void sum_row(const WindowVotes& votes, int row, TileSums& sums) {
  sum_around(votes.known, votes, row, 1, sums.rows, sums.known);
  sum_around(votes.by_path, votes, row, votes.bins, sums.rows, sums.by_path);
  sum_around(votes.by_cost, votes, row, votes.bins, sums.rows, sums.by_cost);
}

/// Whether enough pixels of a tile and of those around it have a disparity.
bool is_known(const WindowVotes& votes, const TileSums& sums, int column, int row) {
  const int columns = std::min(column + 2, votes.columns) - std::max(column - 1, 0);
  const int rows = std::min(row + 2, votes.rows) - std::max(row - 1, 0);
  return sums.known[column] * kLeastKnownShare >= columns * rows * kVotingRows * kVotingRows;
}

CostWindow chosen_window(const WindowVotes& votes, const TileSums& sums, int column, int row) {
  const CostWindow all = {0, static_cast<std::uint16_t>(votes.bins * kWindowStep)};
  if (!is_known(votes, sums, column, row)) return all;
  const std::ptrdiff_t tile = static_cast<std::ptrdiff_t>(column) * votes.bins;
  const auto elected = [&](int bin) {
    return sums.by_path[tile + bin] >= kLeastPathVotes ||
           sums.by_cost[tile + bin] >= kLeastCostVotes;
  };
  int first = 0, last = votes.bins - 1;
  while (first <= last && !elected(first)) ++first;
  if (first > last) return all;
  while (!elected(last)) --last;
  // Twice the same: joined() makes whole vectors of it.
  const CostWindow window = {static_cast<std::uint16_t>(first * kWindowStep),
                             static_cast<std::uint16_t>((last + 1) * kWindowStep)};
  return joined(window, window);
}

}  // namespace

void WindowVotes::resize(int width, int height, int lanes) {
  columns = tiles_of(width);
  rows = tiles_of(height);
  bins = lanes / kWindowStep;
  const std::size_t tiles = static_cast<std::size_t>(columns) * rows;
  known.resize(tiles);
  by_path.resize(tiles * bins);
  by_cost.resize(tiles * bins);
  compared.resize(tiles);
  agreeing.resize(tiles);
}

void clear_votes(int y0, int y1, WindowVotes& votes) {
  const std::size_t first = static_cast<std::size_t>(y0 / kVotingRows) * votes.columns;
  const std::size_t last =
      static_cast<std::size_t>((y1 + kVotingRows - 1) / kVotingRows) * votes.columns;
  for (Buffer<std::uint8_t>* count : {&votes.known, &votes.compared, &votes.agreeing}) {
    std::memset(count->data() + first, 0, last - first);
  }
  for (Buffer<std::uint8_t>* kind : {&votes.by_path, &votes.by_cost}) {
    std::memset(kind->data() + first * votes.bins, 0, (last - first) * votes.bins);
  }
}

void count_votes(const std::int32_t* by_path, const std::int32_t* by_cost, int width, int y,
                 WindowVotes& votes) {
  const int bins = votes.bins;
  std::ptrdiff_t tile = static_cast<std::ptrdiff_t>(y / kVotingRows) * votes.columns;
  for (int x = 0; x < width; x += kVotingRows, ++tile) {
    const int count = std::min(kVotingRows, width - x);
    const int known = vote(by_path + x, count, bins, votes.by_path.data() + tile * bins);
    votes.known[tile] = static_cast<std::uint8_t>(votes.known[tile] + known);
    if (by_cost == nullptr) continue;
    vote(by_cost + x, count, bins, votes.by_cost.data() + tile * bins);
    const int agreeing = count_agreeing(by_path + x, by_cost + x, count);
    votes.compared[tile] = static_cast<std::uint8_t>(votes.compared[tile] + count);
    votes.agreeing[tile] = static_cast<std::uint8_t>(votes.agreeing[tile] + agreeing);
  }
}

void TileSums::resize(int columns, int bins) {
  known.resize(columns);
  by_path.resize(static_cast<std::size_t>(columns) * bins);
  by_cost.resize(by_path.size());
  rows.resize(by_path.size() + 2 * static_cast<std::size_t>(bins));
}

void SearchWindows::resize(int width, int height, int lanes) {
  columns_ = tiles_of(width);
  rows_ = tiles_of(height);
  height_ = height;
  sums_.resize(columns_, lanes / kWindowStep);
  own_.resize(static_cast<std::size_t>(columns_) * rows_);
  joined_.resize(own_.size());
}

const CostWindow* SearchWindows::row(int y) const {
  if (columns_ == 0) return nullptr;
  return own_.data() + static_cast<std::ptrdiff_t>(y / kWindowTile) * columns_;
}

const CostWindow* SearchWindows::covering(int first, int last) const {
  if (columns_ == 0) return nullptr;
  const auto tile_row = [&](int y) { return std::clamp(y, 0, height_ - 1) / kWindowTile; };
  const Buffer<CostWindow>& windows = tile_row(first) == tile_row(last) ? own_ : joined_;
  return windows.data() + static_cast<std::ptrdiff_t>(tile_row(first)) * columns_;
}

void choose_windows(const WindowVotes& votes, SearchWindows& windows) {
  const int columns = windows.columns_;
  for (int row = 0; row < windows.rows_; ++row) {
    sum_row(votes, row, windows.sums_);
    CostWindow* const own = windows.own_.data() + static_cast<std::ptrdiff_t>(row) * columns;
    for (int column = 0; column < columns; ++column) {
      own[column] = chosen_window(votes, windows.sums_, column, row);
    }
  }
  const Buffer<CostWindow>& own = windows.own_;
  const std::size_t last = own.size() - columns;
  for (std::size_t tile = 0; tile < own.size(); ++tile) {
    windows.joined_[tile] = tile < last ? joined(own[tile], own[tile + columns]) : own[tile];
  }
}

}  // namespace mtstereo

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/search_windows.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/limits.hpp"
#include "mtstereo/image.hpp"
#include "mtstereo/parameters.hpp"

namespace mtstereo {
namespace {

int tiles_of(int size) { return (size + kWindowTile - 1) / kWindowTile; }

constexpr int kMostBins = (kLargestMaxDisparity + kCostStep) / kWindowStep;

using BinVotes = std::array<int, kMostBins>;

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

/// The votes in a tile and those around it.
class Surroundings {
 public:
  Surroundings(const WindowVotes& votes, int column, int row)
      : votes_(votes),
        x0_(std::max(column - 1, 0)),
        x1_(std::min(column + 2, votes.columns)),
        y0_(std::max(row - 1, 0)),
        y1_(std::min(row + 2, votes.rows)) {}

  bool known() const {
    int known = 0;
    for_each_tile([&](std::ptrdiff_t tile) { known += votes_.known[tile]; });
    const int pixels = (x1_ - x0_) * (y1_ - y0_) * kVotingRows * kVotingRows;
    return known * kLeastKnownShare >= pixels;
  }

  /// Per bin the votes of one kind.
  BinVotes sums(const Buffer<std::uint8_t>& kind) const {
    BinVotes sums;
    std::fill_n(sums.begin(), votes_.bins, 0);
    for_each_tile([&](std::ptrdiff_t tile) {
      for (int bin = 0; bin < votes_.bins; ++bin) sums[bin] += kind[tile * votes_.bins + bin];
    });
    return sums;
  }

 private:
  template <class Visit>
  void for_each_tile(Visit&& visit) const {
    for (std::ptrdiff_t y = y0_; y < y1_; ++y) {
      for (int x = x0_; x < x1_; ++x) visit(y * votes_.columns + x);
    }
  }

  const WindowVotes& votes_;
  int x0_, x1_, y0_, y1_;
};

CostWindow chosen_window(const WindowVotes& votes, int column, int row) {
  const CostWindow all = {0, static_cast<std::uint16_t>(votes.bins * kWindowStep)};
  const Surroundings around(votes, column, row);
  if (!around.known()) return all;
  const BinVotes by_path = around.sums(votes.by_path);
  const BinVotes by_cost = around.sums(votes.by_cost);
  const auto elected = [&](int bin) {
    return by_path[bin] >= kLeastPathVotes || by_cost[bin] >= kLeastCostVotes;
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

void SearchWindows::resize(int width, int height) {
  columns_ = tiles_of(width);
  rows_ = tiles_of(height);
  height_ = height;
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
    CostWindow* const own = windows.own_.data() + static_cast<std::ptrdiff_t>(row) * columns;
    for (int column = 0; column < columns; ++column) {
      own[column] = chosen_window(votes, column, row);
    }
  }
  const Buffer<CostWindow>& own = windows.own_;
  const std::size_t last = own.size() - columns;
  for (std::size_t tile = 0; tile < own.size(); ++tile) {
    windows.joined_[tile] = tile < last ? joined(own[tile], own[tile + columns]) : own[tile];
  }
}

}  // namespace mtstereo

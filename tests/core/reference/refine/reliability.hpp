// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "reference/refine/block_grid.hpp"
#include "reference/refine/gap_filling.hpp"
#include "stages/refine/reliability_table.hpp"

namespace mtstereo::reference {

/// The views of a rated map.
struct RatedPair {
  const GrayPlane& left;   ///< as bright as the right view
  const GrayPlane& right;  ///< with the gray values of the left one
  const GrayPlane& plain;  ///< the left view as it is
  float noise;
  const GrayPlane& agreement;  ///< of tiles
  int tile;                    ///< [px]
  int clipped_from = 256;      ///< the gray values of the plain view that say nothing
  const ConfidentMap* guide = nullptr;
  float detail = 1;  ///< the share of the finest octave
  int grid = 0;      ///< the level of the block grid
  int block = 8;     ///< side of its blocks [px]
};

/// The bins of the clues about one pixel, each found on its own.
class PixelClues {
 public:
  PixelClues(const RatedPair& pair, const ConfidentMap& in, int x, int y)
      : pair_(pair), in_(in), x_(x), y_(y) {}

  int bin(int clue) const {
    switch (clue) {
      case kSupportClue:
        return in_.confidence(x_, y_) / 8;
      case kShareClue:
        return share();
      case kMismatchClue:
        if (pair_.plain(x_, y_) >= pair_.clipped_from) return 17;
        return bin_of(mismatch(-1) + mismatch(0) + mismatch(1),
                      {3, 5, 7, 9, 14, 18, 23, 27, 36, 45, 54, 72, 90, 126, 180, 270});
      case kNearerClue:
        return first({1, 2, 3, 4, 6, 8, 10, 12, 15},
                     [&](int k) { return steps(x_ - k, y_) > own() + 32; });
      case kFartherClue:
        return first({1, 2, 3, 4, 6, 8}, [&](int k) {
          return std::min({steps(x_ - k, y_), steps(x_ + k, y_), steps(x_, y_ - k),
                           steps(x_, y_ + k)}) < own() - 32;
        });
      case kPartnerClue:
        return bin_of(std::floor(partner()), {-40, -20, -10, -5, 0, 3, 6, 10, 16, 24});
      case kTextureClue:
        return bin_of(texture(-4) + texture(0) + texture(4),
                      {1, 3, 8, 14, 20, 27, 40, 54, 75, 100, 135, 175, 230, 300, 400, 500});
      case kAgreementClue:
        return pair_.agreement.clamped(x_ / pair_.tile, y_ / pair_.tile);
      case kGuideClue:
        return pair_.guide == nullptr ? 0 : guide();
      case kGridClue:
        return grid_bin(pair_.grid, pair_.block, in_.map(x_, y_) / 256.0);
      case kDetailClue:
        return bin_of(pair_.detail, {.024F, .03F, .037F, .045F, .06F, .1F, .2F});
      default:
        return bin_of(pair_.noise, {.1F, .3F, .6F, 1, 1.5F, 2, 2.5F, 3, 4, 5, 7, 10});
    }
  }

  /// The differences of the gray values of three pixels in the row `row` rows below; the map's
  /// border is repeated outside.
  int mismatch(int row) const {
    const int y = std::clamp(y_ + row, 0, in_.map.height - 1);
    int sum = 0;
    for (int i = -1; i <= 1; ++i) {
      const int x = std::clamp(x_ + i, 0, in_.map.width - 1);
      const int partner = static_cast<int>(std::floor(x - in_.map(x, y) / 256.0 + 0.5));
      int least = 85;
      for (int k = -1; k <= 1; ++k) {
        const int right = pair_.right(std::clamp(partner + k, 0, pair_.right.width - 1), y);
        least = std::min(least, std::abs(pair_.left(x, y) - right));
      }
      sum += least;
    }
    return sum;
  }

  /// The changes of the gray value along nine pixels of that row.
  int texture(int row) const {
    const int y = std::clamp(y_ + row, 0, in_.map.height - 1);
    int sum = 0;
    for (int x = std::max(x_ - 4, 1); x <= std::min(x_ + 4, in_.map.width - 1); ++x) {
      sum += std::min(std::abs(pair_.plain(x, y) - pair_.plain(x - 1, y)), 28);
    }
    return sum;
  }

 private:
  /// The number of ends up to the value.
  static int bin_of(double value, const std::vector<float>& ends) {
    return static_cast<int>(std::count_if(
        ends.begin(), ends.end(), [&](float end) { return static_cast<float>(value) >= end; }));
  }

  template <typename Found>
  static int first(const std::vector<int>& distances, Found&& found) {
    for (const int k : distances) {
      if (found(k)) return k;
    }
    return 16;
  }

  /// The disparity in 16ths of a pixel; the map's border is repeated outside.
  int steps(int x, int y) const {
    return in_.map(std::clamp(x, 0, in_.map.width - 1), std::clamp(y, 0, in_.map.height - 1)) / 16;
  }
  int own() const { return steps(x_, y_); }

  double partner() const { return x_ - in_.map(x_, y_) / 256.0; }

  /// The share of matched pixels in 16ths, by a factor that is rounded up.
  int share() const {
    std::uint64_t matched = 0, pixels = 0;
    for (int y = std::max(y_ - 12, 0); y <= std::min(y_ + 12, in_.map.height - 1); ++y) {
      for (int x = std::max(x_ - 12, 0); x <= std::min(x_ + 12, in_.map.width - 1); ++x) {
        ++pixels;
        matched += in_.confidence(x, y) > 15;
      }
    }
    return static_cast<int>(matched * ((16 * 65536 + pixels - 1) / pixels) / 65536);
  }

  /// Four distances from the guide for each of eight levels of its confidence.
  int guide() const {
    const int x = x_ / 2, y = y_ / 2;
    const double distance = std::abs(in_.map(x_, y_) - 2 * pair_.guide->map(x, y)) / 256.0;
    const int level = std::clamp((pair_.guide->confidence(x, y) - 28) / 24, 0, 7);
    return 4 * level + bin_of(distance, {.5F, 1, 3});
  }

  const RatedPair& pair_;
  const ConfidentMap& in_;
  int x_, y_;
};

/// The table of soft, noisy and compressed views.
inline ReliabilityTable table_of(const TableParts& parts, double noise, double detail, int grid,
                                 bool halved) {
  const double soft = std::clamp(halved ? (0.12 - detail) / 0.09 : (0.2 - detail) / 0.14, 0.0, 1.0);
  const double noisy = std::clamp((noise - 3) / 2, 0.0, 1.0);
  const double blocky = std::min(grid / 2.0, 1.0);
  ReliabilityTable table = parts[0];
  for (int clue = 0; clue < kClues; ++clue) {
    for (int bin = 0; bin < kClueBins; ++bin) {
      table[clue][bin] += static_cast<std::int16_t>(std::lround(soft * parts[1][clue][bin]) +
                                                    std::lround(noisy * parts[2][clue][bin]) +
                                                    std::lround(blocky * parts[3][clue][bin]));
    }
  }
  return table;
}

/// The confidence of each pixel; `apart` keeps that of inferred ones at 1 .. 15.
inline GrayPlane rate_reliability(const RatedPair& pair, const ConfidentMap& in,
                                  const ReliabilityTable& table, bool apart) {
  GrayPlane out(in.map.width, in.map.height);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const PixelClues clues(pair, in, x, y);
      int sum = 0;
      for (int clue = 0; clue < kClues; ++clue) sum += table[clue][clues.bin(clue)];
      int rated = std::clamp(sum / 16, 1, 255);
      if (apart)
        rated = in.confidence(x, y) > 15 ? std::max(rated, 16) : 1 + (rated - 1) * 14 / 254;
      out(x, y) = static_cast<std::uint8_t>(rated);
    }
  }
  return out;
}

}  // namespace mtstereo::reference

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/block_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mtstereo {
namespace {

/// The first column whose step is measured; all columns have equally many.
constexpr int kFirstColumn = 2;

/// The most that a step counts [half gray values]. Edges of the scene are larger than most steps
/// between blocks.
constexpr int kMostStep = 8;

/// What chance may add to the visibility is this divided by the root of the number of steps.
constexpr double kChance = 6;

/// The least visibility of blocks. Sharp views without compression have less.
constexpr double kVisible = 1.05;

/// Adds the steps of a row, whole blocks of columns.
template <int kSide>
void add_steps(const std::uint8_t* row, int width, BlockBorders& borders) {
  std::array<int, kSide> sums{};
  for (int x = kFirstColumn; x + kSide < width; x += kSide) {
    const std::uint8_t* at = row + x;
    ++borders.count;
    for (int i = 0; i < kSide; ++i) {
      const int before = std::abs(at[i - 1] - at[i - 2]), after = std::abs(at[i + 1] - at[i]);
      const int step = 2 * std::abs(at[i] - at[i - 1]) - before - after;
      sums[i] += std::min(std::max(step, 0), kMostStep);
    }
  }
  for (int i = 0; i < kSide; ++i) borders.steps[(kFirstColumn + i) % kSide] += sums[i];
}

}  // namespace

void BlockBorders::add(const BlockBorders& other) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += other.steps[i];
  count += other.count;
}

double BlockBorders::visibility() const {
  if (count == 0) return 0;
  std::int64_t all = 0;
  for (const std::int64_t sum : steps) all += sum;
  // Views that were cropped begin within a block.
  const std::int64_t most = *std::max_element(steps.begin(), steps.end());
  const double others = static_cast<double>(all - most) / (side - 1);
  return static_cast<double>(most) / std::max(others, 1.0) -
         kChance / std::sqrt(static_cast<double>(count));
}

bool BlockBorders::visible() const { return visibility() >= kVisible; }

BlockBorders measure_borders(GrayView view, int side, int y0, int y1) {
  BlockBorders borders = {side};
  const int first = (y0 + kBlockRows - 1) / kBlockRows * kBlockRows;
  for (int y = first; y < y1; y += kBlockRows) {
    if (side == kBlockSide) add_steps<kBlockSide>(view.row(y), view.width, borders);
    if (side == kHalvedBlockSide) add_steps<kHalvedBlockSide>(view.row(y), view.width, borders);
  }
  return borders;
}

}  // namespace mtstereo

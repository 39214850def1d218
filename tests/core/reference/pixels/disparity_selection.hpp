// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdlib>
#include <limits>

#include "reference/prepare/census.hpp"
#include "stages/pixels/disparity_selection.hpp"

namespace mtstereo::reference {

/// A disparity in 1/256 px and its peak ratio; both 0 for an unknown disparity.
struct Selected {
  int disparity = 0;
  int ratio = 0;
};

/// Sums of paths from here on count as none.
inline constexpr int kNoSum = 509;

/// The curve through the best cost and its two neighbors whose minimum refines the disparity.
enum class Refinement {
  kParabola,    ///< for the gradient cost
  kSymmetricV,  ///< two lines of equal slopes, for the census cost
};

/// The minimum of the curve, in 1/256 px from the best cost. The two neighbors cost `before` and
/// `after` more than the best, neither less than 0.
inline int refined(Refinement curve, int before, int after) {
  const int scale = curve == Refinement::kParabola ? before + after : std::max(before, after);
  return scale > 0 ? 128 * (before - after) / scale : 0;
}

/// The index of the first least value inside of the window, or -1.
inline int first_least(const std::vector<int>& values) {
  int best = -1;
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    if (values[i] != kOutside && (best < 0 || values[i] < values[best])) best = i;
  }
  return best;
}

/// Accepts or rejects the disparity `best` of a pixel by its own costs, which are those of all
/// disparities that have a right pixel; low .. high are the expected ones.
inline Selected judge(const std::vector<int>& costs, int best, int low, int high,
                      const SelectionOptions& options, Refinement curve) {
  const int cost = costs[best];
  const int last = static_cast<int>(costs.size()) - 1;
  std::vector<int> others;
  for (int d = 0; d <= last; ++d) {
    const bool counts = !options.runner_up_in_range || (low <= d && d <= high);
    if (std::abs(d - best) > 1 && counts && costs[d] != kOutside) others.push_back(costs[d]);
  }
  if (others.empty()) return {};
  const int other = *std::min_element(others.begin(), others.end());
  if (curve == Refinement::kSymmetricV && other >= kNoSum) return {};
  if (!(other > cost * (1 + options.confidence))) return {};
  int disparity = 256 * best;
  const int none = curve == Refinement::kSymmetricV ? kNoSum : std::numeric_limits<int>::max();
  const auto inside = [&](int d) {
    return d >= 0 && d <= last && costs[d] != kOutside && costs[d] < none;
  };
  if (options.subpixel && inside(best - 1) && inside(best + 1)) {
    const int before = costs[best - 1] - cost;
    const int after = costs[best + 1] - cost;
    if (before >= 0 && after >= 0) disparity += refined(curve, before, after);
  }
  const int offset = curve == Refinement::kSymmetricV ? options.ratio_offset : 0;
  const int ratio = (other - cost) * 255 / (other + offset);
  return {std::max(disparity, 1), std::max(ratio, 1)};
}

/// The best disparity of a right pixel, given cost(x, d) of the left pixels.
template <typename Cost>
int best_of_right(int right_x, int width, int disparities, Cost&& cost) {
  std::vector<int> costs;
  for (int d = 0; d < disparities && right_x + d < width; ++d)
    costs.push_back(cost(right_x + d, d));
  return first_least(costs);
}

/// True if the right pixel agrees that left pixel x has the disparity `best`.
template <typename Cost>
bool right_agrees(int x, int best, int width, const SelectionOptions& options, Cost&& cost) {
  if (options.left_right_tolerance < 0) return true;
  const int other = best_of_right(x - best, width, options.disparities, cost);
  return std::abs(other - best) <= options.left_right_tolerance;
}

/// True if the disparity is that of the guide, whose ends at 0 and D - 1 do not count.
inline bool guide_agrees(int best, int low, int high, const SelectionOptions& options) {
  const int margin = options.guided_margin, last = options.disparities - 1;
  if (margin < 0 || (low == 0 && high == last)) return false;
  return (low == 0 || best - low >= margin) && (high == last || high - best >= margin);
}

/// Selects the disparities of one row from its costs; low[x] > high[x] if none are expected.
template <typename Range>
std::vector<Selected> select_disparities(const RowCosts& sums, const SelectionOptions& options,
                                         const Range& low, const Range& high) {
  const int width = static_cast<int>(sums.size());
  std::vector<Selected> row(width);
  for (int x = 0; x < width; ++x) {
    if (low[x] > high[x]) continue;
    std::vector<int> costs = sums[x];
    costs.resize(std::min(options.disparities, x + 1));
    const int best = first_least(costs);
    if (best < 0 || costs[best] >= kNoSum) continue;
    const auto cost = [&](int column, int d) { return sums[column][d]; };
    if (!right_agrees(x, best, width, options, cost) &&
        !guide_agrees(best, low[x], high[x], options)) {
      continue;
    }
    row[x] = judge(costs, best, low[x], high[x], options, Refinement::kSymmetricV);
  }
  return row;
}

}  // namespace mtstereo::reference

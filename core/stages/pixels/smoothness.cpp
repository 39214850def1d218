// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/smoothness.hpp"

#include <algorithm>
#include <cstdlib>

#define HWY_TARGET_INCLUDE "stages/pixels/smoothness.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Writes the steps of at least `least`. Compilers vectorize the loop, for the target. Adding one
/// half keeps exact whole quotients above the whole number by more than any rounding error.
void divide(int large_step, int edge, int least, const std::uint8_t* __restrict__ gray,
            const std::uint8_t* __restrict__ gray_before, int width,
            std::uint8_t* __restrict__ large_steps) {
  const float dividend = static_cast<float>(large_step * edge) + 0.5F;
  for (int x = 0; x < width; ++x) {
    const int change = kEdgeParts * std::abs(gray[x] - gray_before[x]);
    const int quotient = static_cast<int>(dividend / static_cast<float>(edge + change));
    const int cost = quotient < least ? least : quotient;
    large_steps[x] = static_cast<std::uint8_t>(cost > 255 ? 255 : cost);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(divide);

int edge_for_range(int range) {
  constexpr int kLeast = kEdgeParts / 2, kRangePerPart = 3;
  return std::clamp(range / kRangePerPart, kLeast, kUsualEdge);
}

void find_large_steps(const SmoothnessOptions& options, const std::uint8_t* gray,
                      const std::uint8_t* gray_before, int width, std::uint8_t* large_steps) {
  const int least = options.large_step == 0 ? 0 : options.small_step;
  HWY_DYNAMIC_DISPATCH(divide)
  (options.large_step, options.edge, least, gray, gray_before, width, large_steps);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/prepare/halving.hpp"

#include <algorithm>

#define HWY_TARGET_INCLUDE "stages/prepare/halving.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The rounded means of 2x2 pixels. Compilers vectorize this plain loop.
void halve_row(const std::uint8_t* __restrict__ upper, const std::uint8_t* __restrict__ lower,
               int pairs, std::uint8_t* __restrict__ out) {
  for (int x = 0; x < pairs; ++x) {
    const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
    out[x] = static_cast<std::uint8_t>((sum + 2) / 4);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(halve_row);

void halve_rows(GrayView view, int y0, int y1, Image<std::uint8_t>& half) {
  const int pairs = view.width / 2;
  const auto halve = HWY_DYNAMIC_DISPATCH(halve_row);
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* upper = view.row(2 * y);
    const std::uint8_t* lower = view.row(std::min(2 * y + 1, view.height - 1));
    std::uint8_t* out = half.row(y);
    halve(upper, lower, pairs, out);
    if (pairs < half.width()) {
      out[pairs] = static_cast<std::uint8_t>((upper[2 * pairs] + lower[2 * pairs] + 1) / 2);
    }
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

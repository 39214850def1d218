// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/nodes/node_census_cost.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#define HWY_TARGET_INCLUDE "stages/nodes/node_census_cost.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

inline int count_bits(std::uint32_t bits) {
#if HWY_ARCH_X86 && HWY_TARGET >= HWY_SSSE3
  // Without an instruction that counts bits, std::popcount would be a function call. Counts the
  // bits of pairs, groups of four and bytes, then sums up the bytes.
  bits -= bits >> 1 & 0x55555555;
  bits = (bits & 0x33333333) + (bits >> 2 & 0x33333333);
  bits = (bits + (bits >> 4)) & 0x0F0F0F0F;
  return static_cast<int>(bits * 0x01010101 >> 24);
#else
  return std::popcount(bits);
#endif
}

float mean_cost(const std::uint32_t* left, const std::uint32_t* right, int width,
                const NodePair& pair) {
  constexpr int kStep = 2;
  const int first = std::max(pair.left_begin - kNodeMargin, pair.begin_disparity());
  const int last = std::min(pair.left_end + kNodeMargin, width - 1);
  const int slope = disparity_slope(pair);
  const int at_begin = (pair.begin_disparity() << kSlopeBits) + (1 << (kSlopeBits - 1));
  int bits = 0;
  int count = 0;
  for (int x = first; x <= last; x += kStep, ++count) {
    const int inside = std::clamp(x, pair.left_begin, pair.left_end) - pair.left_begin;
    const int disparity = (at_begin + slope * inside) >> kSlopeBits;
    bits += count_bits(left[x] ^ right[x - disparity]);
  }
  return static_cast<float>(bits * kBitCost) / static_cast<float>(count);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(mean_cost);

float census_intensity_cost(const CensusImage& left, const CensusImage& right, int y,
                            const NodePair& pair) {
  return HWY_DYNAMIC_DISPATCH(mean_cost)(left.bits.row(y), right.bits.row(y), left.bits.width(),
                                         pair);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

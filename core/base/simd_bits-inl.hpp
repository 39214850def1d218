// SPDX-License-Identifier: LGPL-2.1-or-later
// Masks as bits of words. Every SIMD target includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_SIMD_BITS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_SIMD_BITS_INL_HPP
#undef MTSTEREO_SIMD_BITS_INL_HPP
#else
#define MTSTEREO_SIMD_BITS_INL_HPP
#endif

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Columns whose bits fit into a word.
constexpr int kWord = 64;

/// The bits of the first `count` columns, those of all if there are more than kWord.
constexpr std::uint64_t first_bits(int count) {
  return count < kWord ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

/// Bit i is lane i of the mask, at most 32.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  static_assert(kLanes <= 32);
  // As many bits as the mask has, so that the compiler needs no memory for them.
  using Word = std::conditional_t<kLanes <= 8, std::uint8_t,
                                  std::conditional_t<kLanes <= 16, std::uint16_t, std::uint32_t>>;
  Word word;
  std::uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

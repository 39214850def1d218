// SPDX-License-Identifier: LGPL-2.1-or-later
// Bytes at any places of memory. Every SIMD target includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_SIMD_GATHER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_SIMD_GATHER_INL_HPP
#undef MTSTEREO_SIMD_GATHER_INL_HPP
#else
#define MTSTEREO_SIMD_GATHER_INL_HPP
#endif

#include <bit>
#include <cstdint>

#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The bytes memory[places]. Reads three more after each. Not faster than a loop on all processors.
template <class D, class V>
HWY_INLINE V bytes_at(D d32, const std::uint8_t* memory, V places) {
  constexpr int kFirst = std::endian::native == std::endian::big ? 24 : 0;
  // Highway copies each word as bytes if the processor has no such load.
  const auto words = hn::GatherOffset(d32, reinterpret_cast<const std::int32_t*>(memory), places);
  return hn::And(hn::ShiftRight<kFirst>(words), hn::Set(d32, 255));
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

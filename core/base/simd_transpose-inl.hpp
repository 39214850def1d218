// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks of rows as columns. Every SIMD target includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_SIMD_TRANSPOSE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_SIMD_TRANSPOSE_INL_HPP
#undef MTSTEREO_SIMD_TRANSPOSE_INL_HPP
#else
#define MTSTEREO_SIMD_TRANSPOSE_INL_HPP
#endif

#include <cstdint>

#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// Transposes four columns of four rows each: the elements at `x`, of 32 bits, become the rows of
/// `out` at `y`.
template <typename T>
HWY_INLINE void transpose_four(const T* const* rows, int x, T* const* out, int y) {
  const hn::FixedTag<T, 4> d32;
  const hn::FixedTag<std::int64_t, 2> d64;
  const auto a = hn::LoadU(d32, rows[0] + x), b = hn::LoadU(d32, rows[1] + x);
  const auto c = hn::LoadU(d32, rows[2] + x), d = hn::LoadU(d32, rows[3] + x);
  const auto ab0 = hn::BitCast(d64, hn::InterleaveLower(d32, a, b));
  const auto ab2 = hn::BitCast(d64, hn::InterleaveUpper(d32, a, b));
  const auto cd0 = hn::BitCast(d64, hn::InterleaveLower(d32, c, d));
  const auto cd2 = hn::BitCast(d64, hn::InterleaveUpper(d32, c, d));
  hn::StoreU(hn::BitCast(d32, hn::InterleaveLower(d64, ab0, cd0)), d32, out[0] + y);
  hn::StoreU(hn::BitCast(d32, hn::InterleaveUpper(d64, ab0, cd0)), d32, out[1] + y);
  hn::StoreU(hn::BitCast(d32, hn::InterleaveLower(d64, ab2, cd2)), d32, out[2] + y);
  hn::StoreU(hn::BitCast(d32, hn::InterleaveUpper(d64, ab2, cd2)), d32, out[3] + y);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

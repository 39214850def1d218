// SPDX-License-Identifier: LGPL-2.1-or-later
// No include guard: every SIMD target includes this header again.

/// Compiles the including source file once for each SIMD target (SSSE3, AVX2, NEON ...). The source
/// file has this form:
///
///     #include "stages/room/stage.hpp"  // and whatever else it needs
///
///     #define HWY_TARGET_INCLUDE "stages/room/stage.cpp"  // this file
///     #include "base/simd.hpp"
///
///     HWY_BEFORE_NAMESPACE();
///     namespace mtstereo::HWY_NAMESPACE {
///     // Kernels. They call Highway as hn::Load() and so on.
///     }  // namespace mtstereo::HWY_NAMESPACE
///     HWY_AFTER_NAMESPACE();
///
///     #if HWY_ONCE
///     namespace mtstereo {
///     HWY_EXPORT(kernel);
///     // The stage's functions. HWY_DYNAMIC_DISPATCH(kernel) selects the processor's kernel.
///     }  // namespace mtstereo
///     #endif  // HWY_ONCE
///
/// Types and constants that all targets share belong in a header.

// foreach_target.h includes the source file again for every target but one. In each of these passes
// highway.h must come after it.
// clang-format off
#include <hwy/foreach_target.h>
#ifdef MTSTEREO_PRECOMPILED_HIGHWAY  // the functions of all targets; see core/pch/highway.hpp
#include <hwy/ops/set_macros-inl.h>
#else
#include <hwy/highway.h>
#endif
// clang-format on

#if HWY_TARGET == HWY_SCALAR
#error "HWY_SCALAR lacks operations that the stages need; see simd_targets in core/meson.build"
#endif

namespace mtstereo::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
}  // namespace mtstereo::HWY_NAMESPACE

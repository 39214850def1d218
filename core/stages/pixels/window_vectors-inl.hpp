// SPDX-License-Identifier: LGPL-2.1-or-later
// Internal to the kernels on costs: code for each common size of windows. Every SIMD target
// includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_WINDOW_VECTORS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_WINDOW_VECTORS_INL_HPP
#undef MTSTEREO_WINDOW_VECTORS_INL_HPP
#else
#define MTSTEREO_WINDOW_VECTORS_INL_HPP
#endif

#include <type_traits>

#include "base/simd.hpp"
#include "stages/pixels/cost_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

/// The number of a window's vectors.
template <class D8>
HWY_INLINE int vectors_of(D8, CostWindow window) {
  return window.size() / static_cast<int>(hn::MaxLanes(D8()));
}

/// The vectors of so many kCostStep lanes; 0 if they do not fill whole ones.
template <class D8>
constexpr int vectors_of_steps(int steps) {
  const int lanes = steps * kCostStep, vector = static_cast<int>(hn::MaxLanes(D8()));
  return lanes % vector == 0 ? lanes / vector : 0;
}

/// Calls `work` with the window's number of vectors as a constant if it has at most four times
/// kCostStep lanes, else with 0.
template <class D8, class Work>
HWY_INLINE auto with_vectors(CostWindow window, const Work& work) {
  switch (window.size() / kCostStep) {
    case 1:
      return work(std::integral_constant<int, vectors_of_steps<D8>(1)>());
    case 2:
      return work(std::integral_constant<int, vectors_of_steps<D8>(2)>());
    case 3:
      return work(std::integral_constant<int, vectors_of_steps<D8>(3)>());
    case 4:
      return work(std::integral_constant<int, vectors_of_steps<D8>(4)>());
    default:
      return work(std::integral_constant<int, 0>());
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

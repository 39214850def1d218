// SPDX-License-Identifier: LGPL-2.1-or-later
// Internal to disparity_selection.cpp: the decision about pixels in vectors. Every SIMD target
// includes this header again, after base/simd.hpp.
#if defined(MTSTEREO_SELECTION_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef MTSTEREO_SELECTION_LANES_INL_HPP
#undef MTSTEREO_SELECTION_LANES_INL_HPP
#else
#define MTSTEREO_SELECTION_LANES_INL_HPP
#endif

#include <cstdint>

#include "base/simd.hpp"
#include "mtstereo/image.hpp"
#include "stages/pixels/selection_data.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

constexpr std::int16_t kNone = SelectionScratch::kNone;

using Finished = hn::CappedTag<std::int32_t, kFinishedTogether>;
using FinishedVec = hn::Vec<Finished>;

/// Values of 16 bits as 32 bits.
template <typename T>
HWY_INLINE FinishedVec widened(const T* values) {
  const hn::Rebind<T, Finished> d16;
  return hn::PromoteTo(Finished(), hn::LoadU(d16, values));
}

/// The quotients of numbers from 0 up to 2^20 and numbers from 1 up to 2^10, rounded down. Their
/// quotient as floats is at most 1 off on every processor.
HWY_INLINE FinishedVec quotients(FinishedVec numbers, FinishedVec divisors) {
  const Finished d32;
  const hn::RebindToFloat<Finished> f32;
  const auto quotient =
      hn::ConvertTo(d32, hn::Div(hn::ConvertTo(f32, numbers), hn::ConvertTo(f32, divisors)));
  const auto rest = hn::Sub(numbers, hn::Mul(quotient, divisors));
  const auto one = hn::Set(d32, 1);
  const auto raised = hn::Add(quotient, hn::IfThenZeroElse(hn::Lt(rest, divisors), one));
  return hn::Sub(raised, hn::IfThenElseZero(hn::Lt(rest, hn::Zero(d32)), one));
}

/// symmetric_v_offset() of costs between `before` and `after`; 0 where `before` is kNone.
HWY_INLINE FinishedVec v_offsets(FinishedVec before, FinishedVec least, FinishedVec after) {
  const Finished d32;
  const auto zero = hn::Zero(d32);
  const auto slope = hn::Sub(hn::Max(before, after), least);
  const auto change = hn::Sub(before, after);
  const auto steps = hn::Mul(hn::Abs(change), hn::Set(d32, kDisparityOne / 2));
  const auto offset = quotients(steps, hn::Max(slope, hn::Set(d32, 1)));
  const auto none = hn::Or(hn::Eq(before, hn::Set(d32, kNone)), hn::Lt(slope, hn::Set(d32, 1)));
  return hn::IfThenZeroElse(none, hn::IfThenElse(hn::Lt(change, zero), hn::Neg(offset), offset));
}

/// Whether disparities are far enough inside of their expected ranges, see
/// SelectionOptions::guided_margin.
HWY_INLINE hn::Mask<Finished> agrees_with_guide(FinishedVec low, FinishedVec high, FinishedVec best,
                                                const SelectionOptions& options) {
  const Finished d32;
  const auto outside = hn::Set(d32, options.guided_margin - 1);
  const auto from_first = hn::Eq(low, hn::Zero(d32));
  const auto to_last = hn::Eq(high, hn::Set(d32, options.disparities - 1));
  const auto above = hn::Or(from_first, hn::Gt(hn::Sub(best, low), outside));
  const auto below = hn::Or(to_last, hn::Gt(hn::Sub(high, best), outside));
  return hn::AndNot(hn::And(from_first, to_last), hn::And(above, below));
}

/// Decides the pixels from x on, as finish_selection() describes it.
HWY_INLINE void finish_at(int x, const SelectionOptions& options, const std::uint16_t* low,
                          const std::uint16_t* high, const SelectionScratch& scratch,
                          std::int32_t* disparity, std::uint8_t* ratio) {
  const Finished d32;
  const auto best = widened(scratch.best.data() + x);
  const auto least = widened(scratch.least.data() + x);
  const auto second = widened(scratch.second.data() + x);
  const auto none = hn::Set(d32, kNone);
  const auto unsure = hn::Lt(second, widened(scratch.sufficient.data() + x));
  auto lost =
      hn::Or(hn::Gt(widened(low + x), widened(high + x)), hn::Or(hn::Eq(second, none), unsure));
  if (options.left_right_tolerance >= 0) {
    const auto distance = hn::Abs(hn::Sub(widened(scratch.other.data() + x), best));
    auto unequal = hn::Gt(distance, hn::Set(d32, options.left_right_tolerance));
    if (options.guided_margin >= 0) {
      unequal = hn::AndNot(agrees_with_guide(widened(low + x), widened(high + x), best, options),
                           unequal);
    }
    lost = hn::Or(lost, unequal);
  }
  auto refined = hn::Mul(best, hn::Set(d32, kDisparityOne));
  if (options.subpixel) {
    refined = hn::Add(refined, v_offsets(widened(scratch.before.data() + x), least,
                                         widened(scratch.after.data() + x)));
  }
  const auto zero = hn::Zero(d32), one = hn::Set(d32, 1);
  hn::StoreU(hn::IfThenZeroElse(lost, hn::Max(refined, one)), d32, disparity + x);
  // The ratio of a lost pixel does not matter, so that its costs may be any.
  const auto excess = hn::IfThenZeroElse(lost, hn::Max(hn::Sub(second, least), zero));
  const auto divisor =
      hn::IfThenElse(lost, one, hn::Max(hn::Add(second, hn::Set(d32, options.ratio_offset)), one));
  const auto share = quotients(hn::Mul(excess, hn::Set(d32, 255)), divisor);
  const hn::Rebind<std::uint8_t, Finished> d8;
  hn::StoreU(hn::DemoteTo(d8, hn::IfThenZeroElse(lost, hn::Max(share, one))), d8, ratio + x);
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard of each target

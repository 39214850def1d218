// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/disparity_selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mtstereo/image.hpp"
#include "stages/pixels/cost_lanes.hpp"

#define HWY_TARGET_INCLUDE "stages/pixels/disparity_selection.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Finished = hn::CappedTag<std::int32_t, kFinishedTogether>;
using FinishedVec = hn::Vec<Finished>;

/// Smaller values as 32 bits.
template <typename T>
HWY_INLINE FinishedVec widened(const T* values) {
  const hn::Rebind<T, Finished> narrow;
  return hn::PromoteTo(Finished(), hn::LoadU(narrow, values));
}

/// The bytes memory[places]. Reads three more after each. Not faster than a loop on all processors.
HWY_INLINE FinishedVec bytes_at(const std::uint8_t* memory, FinishedVec places) {
  const Finished d32;
  constexpr int kFirst = std::endian::native == std::endian::big ? 24 : 0;
  // Highway copies each word as bytes if the processor has no such load.
  const auto words = hn::GatherOffset(d32, reinterpret_cast<const std::int32_t*>(memory), places);
  return hn::And(hn::ShiftRight<kFirst>(words), hn::Set(d32, 255));
}

/// The quotients of numbers from 0 up to 2^20 and numbers from 1 up to 2^10, rounded down. Adding
/// one half keeps exact whole quotients above the whole number by more than any processor's
/// rounding error.
HWY_INLINE FinishedVec quotients(FinishedVec numbers, FinishedVec divisors) {
  const Finished d32;
  const hn::RebindToFloat<Finished> f32;
  const auto above = hn::Add(hn::ConvertTo(f32, numbers), hn::Set(f32, 0.5F));
  return hn::ConvertTo(d32, hn::Div(above, hn::ConvertTo(f32, divisors)));
}

/// The offsets of the V of equal slopes through costs between `before` and `after`
/// [1 / kDisparityOne px]; 0 where neither exceeds the least.
HWY_INLINE FinishedVec v_offsets(FinishedVec before, FinishedVec least, FinishedVec after) {
  const Finished d32;
  const auto zero = hn::Zero(d32);
  const auto slope = hn::Sub(hn::Max(before, after), least);
  const auto change = hn::Sub(before, after);
  const auto steps = hn::Mul(hn::Abs(change), hn::Set(d32, kDisparityOne / 2));
  const auto offset = quotients(steps, hn::Max(slope, hn::Set(d32, 1)));
  return hn::IfThenElse(hn::Lt(change, zero), hn::Neg(offset), offset);
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

/// The best disparities of the right pixels of the best ones of the columns from x on.
HWY_INLINE FinishedVec others_of(const Candidates& candidates, int x, FinishedVec best,
                                 int disparities) {
  const Finished d32;
  const auto first = hn::Set(d32, candidates.width - 1 - x);
  const auto places = hn::Add(best, hn::Sub(first, hn::Iota(d32, 0)));
  const auto low = bytes_at(candidates.decided(Candidates::kLow), places);
  if (cost_lanes(disparities) <= 256) return low;
  const auto high = bytes_at(candidates.decided(Candidates::kHigh), places);
  return hn::Add(low, hn::ShiftLeft<8>(high));
}

/// The sums of the columns from x on.
struct FinishedSums {
  FinishedSums(const Candidates& candidates, int x)
      : words(hn::LoadU(Finished(), reinterpret_cast<const std::int32_t*>(
                                        candidates.sums.data() + Candidates::kSums * x))) {}

  template <Candidates::Sum kSum>
  HWY_INLINE FinishedVec get() const {
    constexpr int kPlace = std::endian::native == std::endian::big ? 3 - kSum : kSum;
    return hn::And(hn::ShiftRight<8 * kPlace>(words), hn::Set(Finished(), 255));
  }

  FinishedVec words;
};

/// The offsets of refined disparities, from the sums, which have half the range of the costs.
HWY_INLINE FinishedVec offsets_of(const FinishedSums& sums) {
  const Finished d32;
  const auto none = hn::Set(d32, kNoSum);
  const auto before = sums.get<Candidates::kBefore>(), after = sums.get<Candidates::kAfter>();
  const auto alone = hn::Or(hn::Eq(before, none), hn::Eq(after, none));
  return hn::IfThenZeroElse(alone, v_offsets(before, sums.get<Candidates::kLeast>(), after));
}

/// Decides the pixels from x on, as finish_selection() describes it.
HWY_INLINE void finish_at(int x, const SelectionOptions& options, const std::uint8_t* runner_up,
                          const std::uint16_t* low, const std::uint16_t* high,
                          const Candidates& candidates, std::int32_t* disparity,
                          std::uint8_t* ratio) {
  const Finished d32;
  const auto best = widened(candidates.best.data() + x);
  const FinishedSums sums(candidates, x);
  const auto least_sum = sums.get<Candidates::kLeast>();
  const auto second_sum = sums.get<Candidates::kSecond>();
  const auto least = hn::ShiftLeft<1>(least_sum), second = hn::ShiftLeft<1>(second_sum);
  // Without a share, any sum above the least one is sufficient.
  const auto sufficient =
      options.confidence > 0 ? bytes_at(runner_up, least_sum) : hn::Add(least_sum, hn::Set(d32, 1));
  const auto doubtful =
      hn::Or(hn::Lt(second_sum, sufficient), hn::Eq(second_sum, hn::Set(d32, kNoSum)));
  auto lost = hn::Or(hn::Gt(widened(low + x), widened(high + x)), doubtful);
  if (options.left_right_tolerance >= 0) {
    const auto other = others_of(candidates, x, best, options.disparities);
    const auto distance = hn::Abs(hn::Sub(other, best));
    auto unequal = hn::Gt(distance, hn::Set(d32, options.left_right_tolerance));
    if (options.guided_margin >= 0) {
      unequal = hn::AndNot(agrees_with_guide(widened(low + x), widened(high + x), best, options),
                           unequal);
    }
    lost = hn::Or(lost, unequal);
  }
  auto refined = hn::Mul(best, hn::Set(d32, kDisparityOne));
  if (options.subpixel) refined = hn::Add(refined, offsets_of(sums));
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

void finish(int width, const SelectionOptions& options, const std::uint8_t* runner_up,
            const std::uint16_t* low, const std::uint16_t* high, const Candidates& candidates,
            std::int32_t* disparity, std::uint8_t* ratio) {
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Finished()));
  for (int x = 0; x + kLanes <= width; x += kLanes) {
    finish_at(x, options, runner_up, low, high, candidates, disparity, ratio);
  }
  // The last vector ends with the row. It may repeat some pixels.
  if (width % kLanes != 0) {
    finish_at(width - kLanes, options, runner_up, low, high, candidates, disparity, ratio);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(finish);

RunnerUpTable runner_up_table(double confidence) {
  RunnerUpTable table{};
  for (int sum = 0; sum <= kNoSum; ++sum) {
    const double least = std::floor(2 * sum * (1 + confidence)) + 1;
    table[sum] = static_cast<std::uint8_t>(std::min(std::ceil(least / 2), 1.0 * kNoSum));
  }
  return table;
}

void Candidates::resize(int columns, int disparities) {
  width = columns;
  // Pixels offer all their lanes, including those past the end of the row.
  right_stride = width + cost_lanes(disparities) + kCostStep;
  right.resize(kPlanes * kTurns * right_stride);
  // Disparities up to 255 leave the upper byte as it is.
  std::fill_n(right.data() + kHigh * kTurns * right_stride, kTurns * right_stride, std::uint8_t{0});
  const int padded = std::max(width, kFinishedTogether);
  // The pixels after the end are finished as well.
  best.resize(padded);
  std::fill_n(best.data() + width, padded - width, std::int16_t{0});
  sums.resize(kSums * padded);
  std::fill_n(sums.data(), width < padded ? kSums * padded : 0, std::uint8_t{0});
}

void finish_selection(int width, const SelectionOptions& options, const RunnerUpTable& runner_up,
                      const std::uint16_t* low, const std::uint16_t* high,
                      const Candidates& candidates, std::int32_t* disparity, std::uint8_t* ratio) {
  if (width >= kFinishedTogether) {
    HWY_DYNAMIC_DISPATCH(finish)
    (width, options, runner_up.data(), low, high, candidates, disparity, ratio);
    return;
  }
  // Too few pixels for a vector.
  std::uint16_t padded_low[kFinishedTogether] = {}, padded_high[kFinishedTogether] = {};
  std::int32_t disparities[kFinishedTogether];
  std::uint8_t ratios[kFinishedTogether];
  std::copy_n(low, width, padded_low);
  std::copy_n(high, width, padded_high);
  HWY_DYNAMIC_DISPATCH(finish)
  (kFinishedTogether, options, runner_up.data(), padded_low, padded_high, candidates, disparities,
   ratios);
  std::copy_n(disparities, width, disparity);
  std::copy_n(ratios, width, ratio);
}

}  // namespace mtstereo
#endif  // HWY_ONCE

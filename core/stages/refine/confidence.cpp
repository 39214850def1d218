// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/confidence.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mtstereo/image.hpp"
#include "stages/nodes/outlier_removal.hpp"

#define HWY_TARGET_INCLUDE "stages/refine/confidence.cpp"
#include "base/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Words = hn::CappedTag<std::uint16_t, kAlignment / 2>;
using Signed = hn::RebindToSigned<Words>;

static_assert(kLargestMaxDisparity * kVoteOne + 2 * support_tolerance(kSupportRadius) <
              kSupportNone);
static_assert(kSupportNone + 2 * support_tolerance(kSupportRadius) < 1 << 16);

void copy_row(const std::int32_t* map, const std::uint8_t* map_ratio, int width,
              std::uint16_t* disparity, std::uint16_t* ratio) {
  constexpr int kSteps = kDisparityOne / kVoteOne;
  constexpr int kShift = 3;
  static_assert(kSteps == 1 << kShift);
  const hn::CappedTag<std::int32_t, kAlignment / 4> d32;
  const hn::Rebind<std::uint16_t, decltype(d32)> d16;
  const hn::Rebind<std::uint8_t, decltype(d32)> d8;
  const auto none = hn::Set(d16, kSupportNone);
  const auto one = hn::Set(d16, kSupportOne);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto value = hn::LoadU(d32, map + x);
    const auto rounded = hn::ShiftRight<kShift>(hn::Add(value, hn::Set(d32, kSteps / 2)));
    // The mask is taken from the unrounded disparity, since the smallest ones round to 0.
    const auto known = hn::DemoteTo(d16, hn::Min(value, hn::Set(d32, 1)));
    const auto missing = hn::Eq(known, hn::Zero(d16));
    const auto ratios = hn::Or(hn::PromoteTo(d16, hn::LoadU(d8, map_ratio + x)), one);
    hn::StoreU(hn::IfThenElse(missing, none, hn::DemoteTo(d16, rounded)), d16, disparity + x);
    hn::StoreU(hn::IfThenZeroElse(missing, ratios), d16, ratio + x);
  }
}

/// Rows of the map and of its ratios, a window's from top to bottom. Pointers: the compiler knows
/// that no store changes them.
struct SupportRows {
  SupportRows(const SupportMap& support, int y) {
    for (int i = 0; i < kSupportSide; ++i) {
      const int row = y - kSupportRadius + i;
      inside[i] = row >= 0 && row < support.disparity.height();
      disparities[i] = inside[i] ? support.disparity.row(row) : nullptr;
      ratios[i] = inside[i] ? support.ratio.row(row) : nullptr;
    }
  }

  bool inside[kSupportSide];
  const std::uint16_t* disparities[kSupportSide];
  const std::uint16_t* ratios[kSupportSide];
};

/// The largest disparities that pixels at each distance can support.
struct Largest {
  /// `middle` holds the disparities minus 2^15, so that signed comparisons order unsigned numbers.
  HWY_INLINE explicit Largest(hn::Vec<Signed> middle) {
    for (int away = 0; away <= kSupportRadius; ++away) {
      const auto tolerance = static_cast<std::int16_t>(support_tolerance(away));
      of[away] = hn::Add(middle, hn::Set(Signed(), tolerance));
    }
  }

  hn::Vec<Signed> of[kSupportRadius + 1];
};

/// Counts and ratios that are added up in the same words, up to 15 of them.
struct SupportSums {
  HWY_INLINE SupportSums() : together(hn::Zero(Words())), count(together), ratio(together) {}

  /// Moves them to `count` and `ratio`.
  HWY_INLINE void split() {
    const Words d16;
    count = hn::Add(count, hn::ShiftRight<12>(together));
    ratio = hn::Add(ratio, hn::And(together, hn::Set(d16, kSupportOne - 1)));
    together = hn::Zero(d16);
  }

  hn::Vec<Words> together, count, ratio;
};

/// Adds the support of a vector of disparities from one row of their windows, if it is in the
/// image.
template <int kStep, int kLine>
HWY_INLINE void add_line(const SupportRows& rows, int x, const Largest& largest,
                         const std::int16_t* widest, SupportSums& sums) {
  if (!rows.inside[kLine]) return;
  const Words d16;
  const Signed di16;
  const std::uint16_t* disparities = rows.disparities[kLine] + x;
  const std::uint16_t* ratios = rows.ratios[kLine] + x;
  const auto distance_of = [](int i) {
    return i < kSupportRadius ? kSupportRadius - i : i - kSupportRadius;
  };
  for (int i = 0; i < kSupportSide; i += kStep) {
    const int away = std::max(distance_of(i), distance_of(kLine));
    // A pixel supports the middle if middle + tolerance - disparity is 0 .. 2 * tolerance.
    const auto distance =
        hn::Sub(largest.of[away], hn::BitCast(di16, hn::LoadU(d16, disparities + i)));
    const auto most = hn::Load(di16, widest + away * kSupportLanes);
    const auto exceeds = hn::RebindMask(d16, hn::Gt(distance, most));
    const auto ratio = hn::IfThenZeroElse(exceeds, hn::LoadU(d16, ratios + i));
    sums.together = hn::Add(sums.together, ratio);
  }
}

/// Sums up the support of a vector of disparities.
template <int kStep>
HWY_INLINE SupportSums sum_support(const SupportRows& rows, int x, const Largest& largest,
                                   const std::int16_t* widest) {
  constexpr int kLines = support_side(kStep);
  constexpr int kTogether = 15 / kLines;  // so many rows, each with kLines pixels
  SupportSums sums;
  [&]<int... kLine>(std::integer_sequence<int, kLine...>) HWY_ATTR {
    ((add_line<kStep, kLine * kStep>(rows, x, largest, widest, sums),
      (kLine + 1) % kTogether == 0 || kLine + 1 == kLines ? sums.split() : void()),
     ...);
  }
  (std::make_integer_sequence<int, kLines>());
  return sums;
}

/// Sums up the support of each pixel of a row. The count is 0 for pixels without a disparity and
/// where `asked` is 0.
template <int kStep>
void sum_row_by(const SupportMap& support, const std::uint8_t* asked, int y,
                SupportScratch& scratch) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  const Signed di16;
  const int width = support.disparity.width() - 2 * kSupportRadius;
  const SupportRows rows(support, y);
  const std::uint16_t* row = rows.disparities[kSupportRadius] + kSupportRadius;
  const std::int16_t* widest = scratch.widest.data();
  std::uint16_t* const counts = scratch.count.data();
  std::uint16_t* const ratios = scratch.ratio.data();
  const auto none = hn::Set(d16, kSupportNone);
  const auto lowest = hn::Set(d16, std::uint16_t{1} << 15);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto disparity = hn::LoadU(d16, row + x);
    const auto unasked = hn::Eq(hn::PromoteTo(d16, hn::LoadU(d8, asked + x)), hn::Zero(d16));
    const auto missing = hn::Or(unasked, hn::Eq(disparity, none));
    SupportSums sums;
    if (!hn::AllTrue(d16, missing)) {
      const Largest largest(hn::BitCast(di16, hn::Sub(disparity, lowest)));
      sums = sum_support<kStep>(rows, x, largest, widest);
    }
    hn::StoreU(hn::IfThenZeroElse(missing, sums.count), d16, counts + x);
    hn::StoreU(sums.ratio, d16, ratios + x);
  }
}

void sum_row(const SupportMap& support, const std::uint8_t* asked, int step, int y,
             SupportScratch& scratch) {
  const auto sum = step == 1 ? sum_row_by<1> : sum_row_by<kSupportStep>;
  sum(support, asked, y, scratch);
}

/// count * count * ratio / (255 * pixels^3) for windows of `pixels` pixels, in steps of
/// 1 / kSupportSteps, plus 1; 0 if the count is 0.
void find_steps(int pixels, int width, SupportScratch& scratch) {
  const hn::CappedTag<std::int32_t, kAlignment / 4> d32;
  const hn::Rebind<float, decltype(d32)> df32;
  const hn::Rebind<std::uint16_t, decltype(d32)> d16;
  const int all = 255 * pixels * pixels * pixels;
  const auto divisor = hn::Set(d32, all);
  const auto scale = hn::Set(df32, static_cast<float>(kSupportSteps / static_cast<double>(all)));
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto count = hn::PromoteTo(d32, hn::LoadU(d16, scratch.count.data() + x));
    const auto ratio = hn::PromoteTo(d32, hn::LoadU(d16, scratch.ratio.data() + x));
    const auto product = hn::Mul(hn::Mul(count, count), ratio);
    // Rounding errors make this at most 1 too low or too high. The remainder, for which the lower
    // 32 bits are sufficient, tells.
    const auto steps = hn::ConvertTo(d32, hn::Mul(hn::ConvertTo(df32, product), scale));
    const auto remainder = hn::Sub(hn::ShiftLeft<kSupportBits>(product), hn::Mul(steps, divisor));
    const auto above = hn::VecFromMask(d32, hn::Lt(remainder, hn::Zero(d32)));
    const auto exact = hn::VecFromMask(d32, hn::Lt(remainder, divisor));
    // The masks are -1: plus 1, or 0 for the exact ones, or minus 1. One more if there is support.
    const auto next = hn::Add(hn::Add(steps, hn::Set(d32, 1)), hn::Add(above, exact));
    const auto some = hn::Min(count, hn::Set(d32, 1));
    hn::StoreU(hn::DemoteTo(d16, hn::Add(next, some)), d16, scratch.steps.data() + x);
  }
}

using Map = hn::CappedTag<std::int32_t, kAlignment / 4>;
using MapConfidence = hn::Rebind<std::uint8_t, Map>;

/// Removes disparities with a confidence below `least`. Accesses the padding of the rows.
void remove_below(int least, int width, std::int32_t* map, std::uint8_t* confidence) {
  const Map d32;
  const MapConfidence d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto value = hn::PromoteTo(d32, hn::LoadU(d8, confidence + x));
    const auto doubtful = hn::Lt(value, hn::Set(d32, least));
    hn::StoreU(hn::IfThenZeroElse(doubtful, hn::LoadU(d32, map + x)), d32, map + x);
    hn::StoreU(hn::DemoteTo(d8, hn::IfThenZeroElse(doubtful, value)), d8, confidence + x);
  }
}

/// Multiplies by weight / 255, rounded; the result is at least 1 where the confidence was. Accesses
/// the padding of the rows.
void weigh_row(const std::uint8_t* weight, int width, std::uint8_t* confidence) {
  const Words d16;
  const hn::Rebind<std::uint8_t, Words> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto value = hn::PromoteTo(d16, hn::LoadU(d8, confidence + x));
    const auto factor = hn::PromoteTo(d16, hn::LoadU(d8, weight + x));
    const auto product = hn::Add(hn::Mul(value, factor), hn::Set(d16, 128));
    const auto quotient = hn::ShiftRight<8>(hn::Add(product, hn::ShiftRight<8>(product)));
    const auto some = hn::Min(value, hn::Set(d16, 1));
    hn::StoreU(hn::DemoteTo(d8, hn::BitCast(Signed(), hn::Max(quotient, some))), d8,
               confidence + x);
  }
}

/// Accesses the padding of the rows.
void clear_row(const std::int32_t* map, int width, std::uint8_t* confidence) {
  const Map d32;
  const MapConfidence d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d32))) {
    const auto unknown = hn::Eq(hn::LoadU(d32, map + x), hn::Zero(d32));
    const auto value = hn::PromoteTo(d32, hn::LoadU(d8, confidence + x));
    hn::StoreU(hn::DemoteTo(d8, hn::IfThenZeroElse(unknown, value)), d8, confidence + x);
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {

HWY_EXPORT(copy_row);
HWY_EXPORT(sum_row);
HWY_EXPORT(find_steps);
HWY_EXPORT(remove_below);
HWY_EXPORT(weigh_row);
HWY_EXPORT(clear_row);

namespace {

/// Entry i + 1: 255 times the cube root of i / kSupportSteps, rounded half up, at least 1. Entry 0:
/// 0. Computed in whole numbers, since 255 times the cube root of 1/8 is halfway between two whole
/// numbers, and the result of std::cbrt() differs between libraries.
constexpr std::array<std::uint8_t, kSupportSteps + 2> kCubeRoots = [] {
  std::array<std::uint8_t, kSupportSteps + 2> roots{};
  std::int64_t root = 0;
  for (std::int64_t i = 0; i <= kSupportSteps; ++i) {
    // Rounds up if root + 1/2 is not above the exact root.
    const std::int64_t cube = std::int64_t{255} * 255 * 255 * i;
    while ((2 * root + 1) * (2 * root + 1) * (2 * root + 1) * kSupportSteps <= 8 * cube) ++root;
    roots[i + 1] = static_cast<std::uint8_t>(std::max<std::int64_t>(root, 1));
  }
  return roots;
}();

/// Number of a window's support_side() rows or columns that are inside of the image.
int inside(int middle, int size, int step) {
  return std::min(middle, kSupportRadius) / step + 1 +
         std::min(size - 1 - middle, kSupportRadius) / step;
}

/// Corrects the steps of the columns whose windows the image's border cuts off.
void find_border_steps(int rows, int width, int step, SupportScratch& scratch) {
  for (int x = 0; x < width; ++x) {
    if (x == kSupportRadius) x = std::max(x, width - kSupportRadius);
    if (x == width) break;
    const std::uint64_t pixels = static_cast<std::uint64_t>(rows) * inside(x, width, step);
    const std::uint64_t count = scratch.count[x];
    if (count == 0) continue;
    const std::uint64_t product = count * count * scratch.ratio[x];
    scratch.steps[x] =
        static_cast<std::uint16_t>(product * kSupportSteps / (255 * pixels * pixels * pixels) + 1);
  }
}

}  // namespace

void SupportMap::resize(int width, int height, ReusedMemory* reused) {
  // The padding of the rows is wide enough for the vectors that begin inside.
  disparity.resize(width + 2 * kSupportRadius, height, reused);
  ratio.resize(width + 2 * kSupportRadius, height, reused);
}

void SupportScratch::resize(int width) {
  count.resize(width + kSupportLanes);
  ratio.resize(width + kSupportLanes);
  steps.resize(width + kSupportLanes);
  widest.resize((kSupportRadius + 1) * kSupportLanes);
  for (int away = 0; away <= kSupportRadius; ++away) {
    std::fill_n(widest.data() + away * kSupportLanes, kSupportLanes,
                static_cast<std::int16_t>(2 * support_tolerance(away) - (1 << 15)));
  }
}

void copy_support(const Image<std::int32_t>& map, const Image<std::uint8_t>& ratio, int y0, int y1,
                  SupportMap& support) {
  const int width = map.width();
  const std::ptrdiff_t padding = support.disparity.stride() - kSupportRadius - width;
  for (int y = y0; y < y1; ++y) {
    std::uint16_t* out = support.disparity.row(y);
    std::uint16_t* out_ratio = support.ratio.row(y);
    HWY_DYNAMIC_DISPATCH(copy_row)
    (map.row(y), ratio.row(y), width, out + kSupportRadius, out_ratio + kSupportRadius);
    std::fill_n(out, kSupportRadius, kSupportNone);
    std::fill_n(out_ratio, kSupportRadius, std::uint16_t{0});
    std::fill_n(out + kSupportRadius + width, padding, kSupportNone);
    std::fill_n(out_ratio + kSupportRadius + width, padding, std::uint16_t{0});
  }
}

void find_support_steps(int pixels, int width, SupportScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(find_steps)(pixels, width, scratch);
}

void rate_support(const SupportMap& support, const Image<std::uint8_t>& asked, int step, int y0,
                  int y1, SupportScratch& scratch, Image<std::uint8_t>& confidence) {
  const int width = confidence.width();
  for (int y = y0; y < y1; ++y) {
    const int rows = inside(y, confidence.height(), step);
    HWY_DYNAMIC_DISPATCH(sum_row)(support, asked.row(y), step, y, scratch);
    find_support_steps(rows * support_side(step), width, scratch);
    find_border_steps(rows, width, step, scratch);
    const std::uint16_t* steps = scratch.steps.data();
    std::uint8_t* row = confidence.row(y);
    for (int x = 0; x < width; ++x) row[x] = kCubeRoots[steps[x]];
  }
}

void weigh_confidence(const Image<std::uint8_t>& weight, int y0, int y1,
                      Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(weigh_row)(weight.row(y), confidence.width(), confidence.row(y));
  }
}

void clear_unknown(const Image<std::int32_t>& map, int y0, int y1,
                   Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(clear_row)(map.row(y), map.width(), confidence.row(y));
  }
}

void threshold_confidence(int least, int y0, int y1, Image<std::int32_t>& map,
                          Image<std::uint8_t>& confidence) {
  for (int y = y0; y < y1; ++y) {
    HWY_DYNAMIC_DISPATCH(remove_below)(least, map.width(), map.row(y), confidence.row(y));
  }
}

}  // namespace mtstereo
#endif  // HWY_ONCE

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/refine/holding.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#define HWY_TARGET_INCLUDE "stages/refine/holding.cpp"
#include "base/simd.hpp"
#include "base/simd_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace mtstereo::HWY_NAMESPACE {

using Floats = hn::CappedTag<float, 64>;
using Vec = hn::Vec<Floats>;
using Ints = hn::RebindToSigned<Floats>;

/// The nearest whole numbers from `least`, which is negative, to `most`.
HWY_INLINE hn::Vec<Ints> nearest(Vec values, int least, int most) {
  const Floats d;
  const Vec limited = hn::Min(values, hn::Set(d, static_cast<float>(most)));
  const Vec from_least = hn::Sub(limited, hn::Set(d, static_cast<float>(least)));
  const Vec rounded = hn::Add(hn::Max(from_least, hn::Zero(d)), hn::Set(d, 0.5F));
  return hn::Add(hn::ConvertTo(Ints(), rounded), hn::Set(Ints(), least));
}

/// Whether the values are 0 .. end - 1.
HWY_INLINE hn::Mask<Ints> is_below(hn::Vec<Ints> values, int end) {
  const Ints di;
  return hn::And(hn::Gt(values, hn::Set(di, -1)), hn::Lt(values, hn::Set(di, end)));
}

/// CameraMotion::moved() for a vector of points.
struct Points {
  Vec x, y, disparity;
};
HWY_INLINE Points last_places(const CameraMotion& motion, const Points& now) {
  const Floats d;
  const auto times = [&](float factor, Vec values) { return hn::Mul(hn::Set(d, factor), values); };
  const Vec far = hn::Sub(hn::Set(d, 1), times(motion.approach, now.disparity));
  const Vec depth = hn::Sub(hn::Sub(far, times(motion.turn_x, now.x)), times(motion.turn_y, now.y));
  const Vec growth = hn::Div(hn::Set(d, 1), hn::Max(depth, hn::Set(d, CameraMotion::kLeastDepth)));
  const Vec x =
      hn::Sub(hn::Add(hn::Add(now.x, hn::Set(d, motion.shift_x)), times(motion.roll, now.y)),
              times(motion.parallax_x, now.disparity));
  const Vec y =
      hn::Sub(hn::Sub(hn::Add(now.y, hn::Set(d, motion.shift_y)), times(motion.roll, now.x)),
              times(motion.parallax_y, now.disparity));
  return {hn::Mul(x, growth), hn::Mul(y, growth), hn::Mul(now.disparity, growth)};
}

/// A bit for each of `columns` columns, at most 64, whose confidence is from `least` to `most`.
HWY_INLINE std::uint64_t find_bits(const std::uint8_t* confidence, int columns, int least,
                                   int most) {
  const hn::CappedTag<std::uint8_t, 64> d8;
  const auto lowest = hn::Set(d8, static_cast<std::uint8_t>(least));
  const auto highest = hn::Set(d8, static_cast<std::uint8_t>(most));
  std::uint8_t bytes[8];
  for (int i = 0; i < 64; i += static_cast<int>(hn::Lanes(d8))) {
    const auto values = hn::LoadU(d8, confidence + i);
    hn::StoreMaskBits(d8, hn::Eq(values, hn::Clamp(values, lowest, highest)), bytes + i / 8);
  }
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits & first_bits(columns);
}

/// Chooses those of the columns first .. end - 1 of a row whose confidence is from `least` to
/// `most`.
void choose_columns(const std::int32_t* map, const std::uint8_t* confidence, int first, int end,
                    int least, int most, HeldPlaces& places) {
  int count = 0;
  for (int x = first; x < end; x += 64) {
    std::uint64_t left = find_bits(confidence + x, std::min(64, end - x), least, most);
    for (; left != 0; left &= left - 1) {
      const int column = x + std::countr_zero(left);
      places.column[count] = column;
      places.disparity[count++] = map[column];
    }
  }
  places.count = count;
}

/// Finds the places of the columns of the row y.
void find_places(const CameraMotion& motion, float offset, const Image<std::uint16_t>& last, int y,
                 HeldPlaces& places) {
  constexpr float kOne = 1.0F / kDisparityOne;
  constexpr int kNone = -2 * kHeldTolerance;  // equals no disparity
  const Floats d;
  const Ints di;
  const Vec center_x = hn::Set(d, static_cast<float>(last.width()) / 2);
  const Vec center_y = hn::Set(d, static_cast<float>(last.height()) / 2);
  const Vec zero = hn::Set(d, offset);
  const Vec row = hn::Sub(hn::Set(d, static_cast<float>(y)), center_y);
  for (int i = 0; i < places.count; i += static_cast<int>(hn::Lanes(d))) {
    const Vec column = hn::ConvertTo(d, hn::Load(di, &places.column[i]));
    const Vec disparity = hn::ConvertTo(d, hn::Load(di, &places.disparity[i]));
    const Points there = last_places(motion, {hn::Sub(column, center_x), row,
                                              hn::Add(hn::Mul(disparity, hn::Set(d, kOne)), zero)});
    const auto last_x = nearest(hn::Add(there.x, center_x), -1, last.width());
    const auto last_y = nearest(hn::Add(there.y, center_y), -1, last.height());
    const auto inside = hn::And(is_below(last_x, last.width()), is_below(last_y, last.height()));
    const auto line = hn::Mul(last_y, hn::Set(di, static_cast<std::int32_t>(last.stride())));
    hn::Store(hn::IfThenElse(inside, hn::Add(line, last_x), hn::Set(di, HeldPlaces::kOutside)), di,
              &places.index[i]);
    const Vec steps = hn::Mul(hn::Sub(there.disparity, zero), hn::Set(d, kHeldOne));
    hn::Store(nearest(steps, kNone, 65535), di, &places.expected[i]);
  }
}

/// In 1 / kHeldOne px. Unknown stays 0, and no known disparity becomes it. Compilers vectorize this
/// plain loop.
void copy_last_row(const std::int32_t* __restrict__ map, int width,
                   std::uint16_t* __restrict__ last) {
  constexpr int kSteps = kDisparityOne / kHeldOne;
  static_assert(kLargestMaxDisparity * kHeldOne <= 65535);
  for (int x = 0; x < width; ++x) {
    const int rounded = (map[x] + kSteps / 2) / kSteps;
    last[x] = static_cast<std::uint16_t>(std::max(rounded, std::min(map[x], 1)));
  }
}

}  // namespace mtstereo::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mtstereo {
HWY_EXPORT(choose_columns);
HWY_EXPORT(copy_last_row);
HWY_EXPORT(find_places);
namespace {

/// Stands for a disparity that no pixel has.
constexpr int kDecidesNothing = 1 << 20;

bool beside_nearer(const Image<std::int32_t>& map, int x, int y) {
  const std::int32_t* row = map.row(y);
  const std::int32_t nearer = row[x] + kHeldJump;
  return row[std::max(x - kHeldJumpReach, 0)] > nearer ||
         row[std::min(x + kHeldJumpReach, map.width() - 1)] > nearer ||
         map.row(std::max(y - kHeldJumpReach, 0))[x] > nearer ||
         map.row(std::min(y + kHeldJumpReach, map.height() - 1))[x] > nearer;
}

}  // namespace

void doubt_by_last(const LeastConfidence& least, const CameraMotion& motion, float offset,
                   const Image<std::uint16_t>& last, const Image<std::int32_t>& map, int y0, int y1,
                   Image<std::uint8_t>& confidence) {
  const auto [lowest, highest] = std::minmax({least.usual, least.known, least.fresh});
  HeldPlaces places = {};
  const std::uint16_t* known = last.row(0);
  for (int y = y0; y < y1; ++y) {
    std::uint8_t* rating = confidence.row(y);
    for (int x = 0; x < map.width(); x += HeldPlaces::kMost) {
      // Only these depend on the last map.
      HWY_DYNAMIC_DISPATCH(choose_columns)
      (map.row(y), rating, x, std::min(x + HeldPlaces::kMost, map.width()), lowest, highest - 1,
       places);
      HWY_DYNAMIC_DISPATCH(find_places)(motion, offset, last, y, places);
      for (int i = 0; i < places.count; ++i) {
        const int column = places.column[i];
        const bool outside = places.index[i] == HeldPlaces::kOutside;
        const int before = outside ? kDecidesNothing : known[places.index[i]];
        int needed = least.usual;
        if (before == 0) {
          if (!beside_nearer(map, column, y)) needed = least.fresh;
        } else if (std::abs(before - places.expected[i]) <= kHeldTolerance) {
          needed = least.known;
        }
        if (rating[column] < needed) rating[column] = 0;
      }
    }
  }
}

void copy_last(const Image<std::int32_t>& map, int y0, int y1, Image<std::uint16_t>& last) {
  for (int y = y0; y < y1; ++y)
    HWY_DYNAMIC_DISPATCH(copy_last_row)(map.row(y), map.width(), last.row(y));
}

}  // namespace mtstereo
#endif  // HWY_ONCE
